#include "tests/sim/testbench.hpp"

#include <deque>
#include <random>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/prune/draw.hpp"

namespace hitpipe::sim {
namespace {

/// Longer than any pipeline here, so that everything in a pipeline comes out.
constexpr int drain_cycles = 64;

struct Asked {
  std::size_t vector;
  std::uint16_t tag;
  std::vector<std::int64_t> results;
};

std::string hexadecimal(const std::vector<rtl::Port>& ports, const std::vector<std::int64_t>& operands) {
  std::string text;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const auto bits = static_cast<std::uint64_t>(operands[i]) & (~std::uint64_t{0} >> (64 - ports[i].width));
    text += fmt::format("{}={:#x} ", ports[i].name, bits);
  }
  return text;
}

}  // namespace

TestbenchReport& TestbenchReport::operator+=(const TestbenchReport& other) {
  sent += other.sent;
  received += other.received;
  hits += other.hits;
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

TestbenchReport drive(Model& model, const std::vector<rtl::Port>& ports, rtl::Evaluate evaluate,
                      const std::vector<std::vector<std::int64_t>>& vectors, const Traffic& traffic,
                      std::uint64_t seed, std::uint64_t vector_seed) {
  std::mt19937_64 random(seed);
  const auto chance = [&](double share) {
    return static_cast<double>(random() >> 11U) < share * static_cast<double>(std::uint64_t{1} << 53U);
  };
  TestbenchReport report;
  std::deque<Asked> asked;
  Pins before;  // of the last cycle
  std::vector<std::int64_t> results(evaluate.result_count());
  std::vector<std::int64_t> results_before;
  const auto fail = [&](std::uint64_t& count, const char* what, const Pins& pins) {
    ++count;
    if (!report.first_failure.empty()) return;
    report.first_failure =
        fmt::format("{}: results {} tag {:#x}", what, fmt::join(results, " "), pins.out_tag);
    if (!asked.empty()) {
      const Asked& a = asked.front();
      report.first_failure += fmt::format("; expected results {} tag {:#x} for vector {} of seed {}: {}",
                                          fmt::join(a.results, " "), a.tag, a.vector, vector_seed,
                                          hexadecimal(ports, vectors[a.vector]));
    }
    report.first_failure += fmt::format("; {} traffic of seed {}", traffic.name, seed);
  };
  auto tag = static_cast<std::uint16_t>(random());
  // A test that is lost would be waited for without end.
  const auto most_cycles = static_cast<std::uint64_t>(16.0 * static_cast<double>(vectors.size()) /
                                                      (traffic.offered * traffic.taken)) +
                           1000;
  std::uint64_t cycles = 0;
  for (int draining = 0; draining < drain_cycles && cycles < most_cycles; ++cycles) {
    const bool all_sent = report.sent == vectors.size();
    if (all_sent && asked.empty()) ++draining;
    Pins pins{.results = results.data()};
    pins.in_valid = !all_sent && chance(traffic.offered);
    pins.in_tag = tag;
    pins.out_ready = chance(traffic.taken);
    pins.rst = traffic.reset > 0 && chance(traffic.reset);
    model.cycle(all_sent ? nullptr : vectors[report.sent].data(), pins);

    if (pins.in_ready != (pins.out_ready || !pins.out_valid)) fail(report.wrong_ready, "in_ready", pins);
    if (before.out_valid && !before.out_ready) {
      const bool held = pins.out_valid && results == results_before && pins.out_tag == before.out_tag;
      if (!held) fail(report.not_held, "answer not held", pins);
    }
    if (pins.out_valid && !pins.out_ready) ++report.stalls;
    if (pins.out_valid && pins.out_ready) {
      if (asked.empty()) {
        fail(report.surplus, "answer to no test", pins);
      } else {
        if (results != asked.front().results) fail(report.wrong_results, "wrong result", pins);
        if (pins.out_tag != asked.front().tag) fail(report.wrong_tags, "wrong tag", pins);
        report.hits += pins.hit ? 1 : 0;
        ++report.received;
        asked.pop_front();
      }
    }
    if (pins.rst) {
      // Tests in flight are gone. The test that is offered is not taken.
      ++report.resets;
      report.dropped += asked.size();
      report.sent -= asked.size();
      asked.clear();
      before = Pins{};
      continue;
    }
    if (pins.in_valid && pins.in_ready) {
      asked.push_back({report.sent, tag, rtl::with_results(vectors[report.sent], evaluate).results});
      ++report.sent;
      tag = static_cast<std::uint16_t>(random());
    }
    before = pins;
    results_before = results;
  }
  report.lost = vectors.size() - report.received;
  std::uint64_t noted = 0;
  if (report.lost > 0) fail(noted, "no answer", before);
  return report;
}

}  // namespace hitpipe::sim
