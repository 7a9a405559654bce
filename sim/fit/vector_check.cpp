#include "sim/fit/vector_check.hpp"

#include <deque>
#include <random>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/prune/draw.hpp"
#include "rtl_gen/prune/facts.hpp"

namespace hitpipe::sim {

namespace {

struct Asked {
  std::uint64_t number;
  rtl::Vector vector;

  [[nodiscard]] std::uint16_t tag() const { return static_cast<std::uint16_t>(number); }
};

/// Sends all vectors through the unit and notes what is wrong.
class Run {
 public:
  explicit Run(const VectorCheck& check)
      : check_(check),
        model_(*check.verilated),
        draw_(*check.ports, *check.demands, check.evaluate, check.seed),
        random_(check.seed),
        results_(check.verilated->results().size()) {}

  VectorResult operator()() {
    Asked next{0, draw_()};
    // A unit that loses tests would be waited for without end.
    const std::uint64_t most_cycles = 4 * check_.vectors + 1000;
    for (std::uint64_t cycle = 0; cycle < most_cycles && received_ < check_.vectors; ++cycle) {
      Pins pins{.in_valid = next.number < check_.vectors && mostly(),
                .out_ready = mostly(),
                .in_tag = next.tag(),
                .results = results_.data()};
      model_.cycle(next.vector.operands.data(), pins);
      if (pins.out_valid && pins.out_ready) receive(pins);
      if (!pins.in_valid || !pins.in_ready) continue;
      result_.hits += check_.evaluate.hit(next.vector.results.data()) ? 1 : 0;
      ++result_.vectors;
      asked_.push_back(std::move(next));
      next = {result_.vectors, draw_()};
    }
    if (received_ < check_.vectors) wrong("no answer", check_.vectors - received_);
    return result_;
  }

 private:
  bool mostly() { return random_() % 8 != 0; }

  void receive(const Pins& pins) {
    if (++received_ % 65'536 == 0)
      check_.progress(static_cast<double>(received_) / static_cast<double>(check_.vectors));
    const bool right =
        !asked_.empty() && results_ == asked_.front().vector.results && pins.out_tag == asked_.front().tag();
    if (!right) wrong(answer(results_, pins.out_tag), 1);
    if (!asked_.empty()) asked_.pop_front();
  }

  /// "hit 1 tag 7".
  [[nodiscard]] std::string answer(const std::vector<std::int64_t>& results, std::uint16_t tag) const {
    std::string text;
    for (std::size_t i = 0; i < results.size(); ++i)
      text += fmt::format("{} {} ", check_.verilated->results()[i].name, results[i]);
    return text + fmt::format("tag {}", tag);
  }

  void wrong(const std::string& what, std::uint64_t answers) {
    result_.mismatches += answers;
    if (!result_.first_mismatch.empty()) return;
    result_.first_mismatch = what;
    if (asked_.empty()) return;
    const Asked& asked = asked_.front();
    result_.first_mismatch +=
        fmt::format(", expected {} of vector {} of seed {}:", answer(asked.vector.results, asked.tag()),
                    asked.number, check_.seed);
    for (std::size_t i = 0; i < check_.ports->size(); ++i) {
      const rtl::Port& port = (*check_.ports)[i];
      result_.first_mismatch +=
          fmt::format(" {}={:#x}", port.name,
                      static_cast<std::uint64_t>(asked.vector.operands[i]) & hls::low_mask(port.width));
    }
  }

  const VectorCheck& check_;
  Model model_;
  rtl::DrawVectors draw_;
  std::mt19937_64 random_;             // of gaps and stalls
  std::vector<std::int64_t> results_;  // of the Verilog
  std::deque<Asked> asked_;
  std::uint64_t received_ = 0;
  VectorResult result_;
};

}  // namespace

VectorResult check_vectors(const VectorCheck& check) {
  return check.vectors == 0 ? VectorResult{} : Run(check)();
}

}  // namespace hitpipe::sim
