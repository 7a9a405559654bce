#include "sim/unit/drive.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

#include "hls/num/bits.hpp"
#include "rtl_gen/prune/draw.hpp"

namespace hitpipe::sim {

namespace {

class Driver {
 public:
  Driver(Model& model, const TestBatch& tests, const DriveOptions& options)
      : model_(model),
        tests_(tests),
        options_(options),
        random_(options.seed),
        results_(model.design().results().size()) {}

  DriveReport operator()() {
    const Traffic& traffic = options_.traffic;
    // A test that is lost would be waited for without end.
    const auto most_cycles =
        static_cast<std::uint64_t>(16.0 * model_.design().unit().pipeline->interval() *
                                   static_cast<double>(tests_.size()) / (traffic.offered * traffic.taken)) +
        1000;
    // So that everything in a pipeline comes out.
    int draining = 2 * model_.design().latency() + 4;
    for (std::uint64_t cycle = 0; draining > 0 && cycle < most_cycles; ++cycle) {
      if (all_sent() && nothing_asked()) --draining;
      run_cycle();
    }
    report_.lost = tests_.size() - report_.received;
    std::uint64_t noted = 0;
    if (report_.lost > 0) fail(noted, "no answer");
    return report_;
  }

 private:
  [[nodiscard]] bool all_sent() const { return report_.sent == tests_.size(); }
  [[nodiscard]] bool nothing_asked() const { return report_.received == report_.sent; }
  [[nodiscard]] std::uint16_t tag(std::uint64_t test) const {
    return static_cast<std::uint16_t>((options_.first + test) * options_.tag_step);
  }
  bool chance(double share) {
    if (share >= 1 || share <= 0) return share >= 1;
    return static_cast<double>(random_() >> 11U) < share * static_cast<double>(std::uint64_t{1} << 53U);
  }

  /// Follows the phase of the unit from the first cycle in which it takes tests.
  void check_ready(const Pins& pins) {
    const bool moves = pins.out_ready || !pins.out_valid;
    const int interval = model_.design().unit().pipeline->interval();
    if (!phase_ && (pins.in_ready || interval == 1)) phase_ = 0;
    if (pins.in_ready != (moves && phase_ == 0)) fail(report_.wrong_ready, "wrong in_ready: ", pins.out_tag);
    if (pins.rst) {
      phase_ = 0;
    } else if (moves && phase_) {
      phase_ = (*phase_ + 1) % interval;
    }
  }

  void run_cycle() {
    const Traffic& traffic = options_.traffic;
    Pins pins{.rst = chance(traffic.reset),
              .in_valid = !all_sent() && chance(traffic.offered),
              .out_ready = chance(traffic.taken),
              .in_tag = tag(report_.sent),
              .results = results_.data()};
    model_.cycle(all_sent() ? nullptr : tests_.operands(report_.sent).data(), pins);

    check_ready(pins);
    if (before_.out_valid && !before_.out_ready &&
        !(pins.out_valid && results_ == results_before_ && pins.out_tag == before_.out_tag))
      fail(report_.not_held, "not held: ", pins.out_tag);
    if (pins.out_valid && !pins.out_ready) ++report_.stalls;
    if (pins.out_valid && pins.out_ready) receive(pins);
    before_ = pins;
    if (pins.rst) {
      // Tests in flight are gone. The test that is offered is not taken.
      ++report_.resets;
      report_.dropped += report_.sent - report_.received;
      report_.sent = report_.received;
      before_ = Pins{};
    } else if (pins.in_valid && pins.in_ready) {
      ++report_.sent;
    }
    results_before_ = results_;
  }

  void receive(const Pins& pins) {
    if (nothing_asked()) {
      fail(report_.surplus, "answer to no test: ", pins.out_tag);
      return;
    }
    // A library call would take longer than the few results.
    bool same = true;
    const std::span<const std::int64_t> expected = tests_.results(report_.received);
    for (std::size_t i = 0; i < results_.size(); ++i) same = same && results_[i] == expected[i];
    const bool own_tag = pins.out_tag == tag(report_.received);
    report_.wrong_results += same ? 0 : 1;
    report_.wrong_tags += own_tag ? 0 : 1;
    if (!same || !own_tag) fail(report_.wrong, "", pins.out_tag);
    report_.hits += pins.hit ? 1 : 0;
    ++report_.received;
  }

  /// "hit 1 tag 7".
  [[nodiscard]] std::string answer_text(std::span<const std::int64_t> results, std::uint16_t tag) const {
    std::string text;
    for (std::size_t i = 0; i < results.size(); ++i)
      text += fmt::format("{} {} ", model_.design().results()[i].name, results[i]);
    return text + fmt::format("tag {}", tag);
  }

  /// Without a tag there is no answer. A wrong answer tells more than how it came, so its text is kept.
  void fail(std::uint64_t& count, const char* what, std::optional<std::uint16_t> tag_of_answer = {}) {
    ++count;
    const bool of_answer = &count != &report_.not_held && &count != &report_.wrong_ready;
    std::string& text = report_.first_failure;
    if (!text.empty() && (told_answer_ || !of_answer)) return;
    told_answer_ = of_answer;
    text = what;
    if (tag_of_answer) text += answer_text(results_, *tag_of_answer);
    if (!nothing_asked()) {
      const std::uint64_t test = report_.received;
      text +=
          fmt::format(", expected {} of vector {} of seed {}:", answer_text(tests_.results(test), tag(test)),
                      options_.first + test, options_.vector_seed);
      const std::vector<rtl::Port> ports = model_.design().unit().ports();
      for (std::size_t i = 0; i < ports.size(); ++i) {
        const auto bits = static_cast<std::uint64_t>(tests_.operands(test)[i]);
        text += fmt::format(" {}={:#x}", ports[i].name, bits & hls::low_mask(ports[i].width));
      }
    }
    if (const char* const name = options_.traffic.name; *name != '\0')
      text += fmt::format("; {} traffic of seed {}", name, options_.seed);
  }

  Model& model_;
  const TestBatch& tests_;
  const DriveOptions& options_;
  std::mt19937_64 random_;
  std::vector<std::int64_t> results_, results_before_;
  Pins before_;               ///< of the last cycle
  std::optional<int> phase_;  ///< cycles since the last in which it took tests; nothing: not yet seen
  bool told_answer_ = false;  ///< the first failure is a wrong answer
  DriveReport report_;
};

}  // namespace

TestBatch::TestBatch(const std::vector<std::vector<std::int64_t>>& operands, const rtl::Evaluate& evaluate) {
  std::array<std::int64_t, rtl::Evaluate::most_results> results{};
  for (const std::vector<std::int64_t>& each : operands) {
    evaluate(each.data(), results.data());
    add(each, {results.data(), evaluate.result_count()});
  }
}

void TestBatch::add(std::span<const std::int64_t> operands, std::span<const std::int64_t> results) {
  operands_.insert(operands_.end(), operands.begin(), operands.end());
  results_.insert(results_.end(), results.begin(), results.end());
  ++size_;
}

std::span<const std::int64_t> TestBatch::operands(std::size_t test) const {
  const std::size_t each = operands_.size() / size_;
  return {operands_.data() + test * each, each};
}

std::span<const std::int64_t> TestBatch::results(std::size_t test) const {
  const std::size_t each = results_.size() / size_;
  return {results_.data() + test * each, each};
}

DriveReport& DriveReport::operator+=(const DriveReport& other) {
  sent += other.sent;
  received += other.received;
  hits += other.hits;
  wrong += other.wrong;
  wrong_results += other.wrong_results;
  wrong_tags += other.wrong_tags;
  surplus += other.surplus;
  lost += other.lost;
  not_held += other.not_held;
  wrong_ready += other.wrong_ready;
  resets += other.resets;
  dropped += other.dropped;
  stalls += other.stalls;
  if (first_failure.empty()) first_failure = other.first_failure;
  return *this;
}

DriveReport drive(Model& model, const TestBatch& tests, const DriveOptions& options) {
  if (tests.size() == 0) return {};
  if (tests.operands(0).size() != model.design().operand_count() ||
      tests.results(0).size() != model.design().results().size())
    throw std::invalid_argument("the tests do not have the operands and results of the Verilog");
  return Driver(model, tests, options)();
}

VectorResult check_vectors(const VectorCheck& check) {
  constexpr std::uint64_t most_of_a_batch = 65'536;
  const rtl::Unit& unit = check.verilated->unit();
  const rtl::Evaluate evaluate = unit.design->evaluate(unit.format);
  rtl::DrawVectors draw(unit.ports(), unit.demands, evaluate, check.seed);
  Model model(*check.verilated);
  VectorResult result;
  while (result.vectors < check.vectors) {
    TestBatch batch;
    while (batch.size() < std::min(most_of_a_batch, check.vectors - result.vectors)) {
      const rtl::Vector vector = draw();
      result.hits += evaluate.yes(vector.results.data()) ? 1 : 0;
      batch.add(vector.operands, vector.results);
    }
    const DriveReport report = drive(model, batch,
                                     {.traffic = {.offered = 0.875, .taken = 0.875},
                                      .seed = check.seed + result.vectors,
                                      .first = result.vectors,
                                      .vector_seed = check.seed});
    result.vectors += batch.size();
    result.mismatches += report.faults();
    if (result.first_mismatch.empty()) result.first_mismatch = report.first_failure;
    // A unit that loses tests has more to answer for than can be told apart.
    if (report.lost > 0) break;
    check.progress(static_cast<double>(result.vectors) / static_cast<double>(check.vectors));
  }
  return result;
}

}  // namespace hitpipe::sim
