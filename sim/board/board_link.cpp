#include "sim/board/board_link.hpp"

#include <string_view>
#include <unordered_map>
#include <utility>

#include "rtl_gen/board/top.hpp"
#include "sim/board/frame.hpp"

namespace hitpipe::sim {

namespace {

// A quarter of the tags, so that a late answer is never taken for the answer of another test.
constexpr std::size_t most_tests_waiting = 64;
constexpr char test_kind = 'T';

}  // namespace

BoardLink::BoardLink(host::SerialPort& port, const rtl::Design& design, const Format& format,
                     const Patience& patience)
    : link_(port, patience),
      design_(design),
      format_(format),
      operands_(design.ports(format)),
      results_(rtl::result_ports(design.results(format))),
      verdict_(rtl::verdict_of(design.results(format))) {}

void BoardLink::require_same_unit() {
  link_.require(rtl::board_identity(design_, format_), "tests");
}

BoardCounts BoardLink::run(const std::function<std::optional<NumberedTest>()>& next) {
  // Answers come in order, so a test is lost when a later one is answered.
  const FrameLink::Kind kind{.letter = test_kind,
                             .noun = "test",
                             .answer_bytes = static_cast<std::size_t>(rtl::packed_bytes(results_)),
                             .most_waiting = most_tests_waiting};
  std::unordered_map<std::uint64_t, rtl::Vector> waiting;
  BoardCounts counts;
  const auto ask = [&]() -> std::optional<FrameLink::Question> {
    std::optional<NumberedTest> numbered = next();
    if (!numbered) return std::nullopt;
    FrameLink::Question question{numbered->number, pack(operands_, numbered->test.operands)};
    waiting.emplace(numbered->number, std::move(numbered->test));
    return question;
  };
  const auto compare = [&](std::uint64_t number, std::string_view bytes) {
    rtl::Vector test = std::move(waiting.extract(number).mapped());
    const std::vector<std::int64_t> results = unpack(results_, bytes);
    counts.hits += verdict_(results.data()) ? 1 : 0;
    if (bytes == pack(results_, test.results)) return;
    ++counts.mismatches;
    if (!counts.first_wrong) counts.first_wrong = {number, std::move(test), results};
  };
  const FrameLink::Counts traffic = link_.run(kind, ask, compare);
  counts.tests = traffic.answered;
  counts.resent = traffic.resent;
  counts.bytes_sent = traffic.bytes_sent;
  counts.bytes_received = traffic.bytes_received;
  counts.seconds = traffic.seconds;
  return counts;
}

}  // namespace hitpipe::sim
