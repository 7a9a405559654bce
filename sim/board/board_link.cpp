#include "sim/board/board_link.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "rtl_gen/board/top.hpp"
#include "sim/board/frame.hpp"
#include "sim/cosim/counts.hpp"

namespace hitpipe::sim {

namespace {

using Clock = std::chrono::steady_clock;

// A quarter of the tags, so that a late answer is never taken for the answer of another test.
constexpr std::size_t most_waiting = 64;
constexpr int most_sendings = 10;
constexpr std::chrono::milliseconds most_wait{50};
constexpr char test_kind = 'T';
constexpr char who_kind = 'I';

}  // namespace

BoardLink::BoardLink(host::SerialPort& port, const rtl::Design& design, const rtl::Format& format,
                     const Patience& patience)
    : port_(port),
      design_(design),
      format_(format),
      patience_(patience),
      operands_(design.ports(format)),
      results_(rtl::result_ports(design.results(format))),
      verdict_(rtl::verdict_of(design.results(format))) {}

std::vector<std::string> BoardLink::exchange(std::chrono::milliseconds wait) {
  const std::size_t before = out_.size();
  const std::string in = port_.exchange(out_, wait);
  counts_.bytes_sent += before - out_.size();
  counts_.bytes_received += in.size();
  std::vector<std::string> payloads;
  for (const char byte : in)
    if (std::optional<std::string> payload = reader_.take(byte)) payloads.push_back(*std::move(payload));
  return payloads;
}

std::string BoardLink::identity() {
  const std::string question = to_frame(std::string{who_kind, '?'});
  counts_ = {};
  for (int tries = 0; tries < patience_.tries; ++tries) {
    out_ = question;
    const Clock::time_point end = Clock::now() + patience_.silence;
    while (Clock::now() < end) {
      for (const std::string& payload : exchange(most_wait))
        if (payload.starts_with(std::string{who_kind, '?'})) return payload.substr(2);
    }
  }
  if (counts_.bytes_received == 0)
    throw std::runtime_error(
        fmt::format("{}: no answer; is this the board's port, and has it been programmed?", port_.name()));
  throw std::runtime_error(
      fmt::format("{}: {} bytes came and no sound frame; has the bitstream this baud rate?", port_.name(),
                  counts_.bytes_received));
}

void BoardLink::require_same_unit() {
  const std::string here = rtl::board_identity(design_, format_);
  const std::string there = identity();
  if (here == there) return;
  throw std::runtime_error(
      fmt::format("{}: the board has \"{}\", and the tests are for \"{}\"", port_.name(), there, here));
}

void BoardLink::send(const Waiting& test) {
  out_ += test.frame;
}

void BoardLink::fill(const std::function<std::optional<NumberedTest>()>& next) {
  while (more_ && waiting_.size() < most_waiting) {
    std::optional<NumberedTest> numbered = next();
    if (!numbered) {
      more_ = false;
      return;
    }
    const auto taken = [&](char tag) {
      return std::any_of(waiting_.begin(), waiting_.end(), [&](const Waiting& w) { return w.tag == tag; });
    };
    while (taken(static_cast<char>(next_tag_))) ++next_tag_;
    const char tag = static_cast<char>(next_tag_++);
    std::string frame = to_frame(std::string{test_kind, tag} + pack(operands_, numbered->test.operands));
    waiting_.push_back({*std::move(numbered), std::move(frame), tag});
    send(waiting_.back());
  }
}

bool BoardLink::receive(const std::string& payload) {
  const std::size_t length = 2 + static_cast<std::size_t>(rtl::packed_bytes(results_));
  if (payload.size() != length || payload[0] != test_kind) return false;
  const auto found =
      std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& w) { return w.tag == payload[1]; });
  if (found == waiting_.end()) return false;
  // Answers come in order, so those before it are lost.
  send_again(static_cast<std::size_t>(found - waiting_.begin()));
  Waiting test = std::move(waiting_.front());
  waiting_.erase(waiting_.begin());
  const std::string_view bytes = std::string_view(payload).substr(2);
  const std::vector<std::int64_t> results = unpack(results_, bytes);
  ++counts_.tests;
  counts_.hits += verdict_(results.data()) ? 1 : 0;
  if (bytes == pack(results_, test.numbered.test.results)) return true;
  ++counts_.mismatches;
  if (!counts_.first_wrong)
    counts_.first_wrong = {test.numbered.number, std::move(test.numbered.test), results};
  return true;
}

void BoardLink::send_again(std::size_t first_ones) {
  for (std::size_t i = 0; i < first_ones; ++i) {
    Waiting lost = std::move(waiting_.front());
    waiting_.erase(waiting_.begin());
    if (++lost.sendings > most_sendings)
      throw WrongHardware(fmt::format("{}: test {} was sent {} times and never answered", port_.name(),
                                      lost.numbered.number, most_sendings));
    ++counts_.resent;
    send(lost);
    waiting_.push_back(std::move(lost));
  }
}

BoardCounts BoardLink::run(const std::function<std::optional<NumberedTest>()>& next) {
  counts_ = {};
  more_ = true;
  const Clock::time_point start = Clock::now();
  Clock::time_point last = start;
  int silences = 0;
  while (true) {
    fill(next);
    if (waiting_.empty()) break;
    const std::size_t unsent = out_.size();
    bool progress = false;
    for (const std::string& payload : exchange(most_wait)) progress = receive(payload) || progress;
    if (progress) silences = 0;
    if (progress || out_.size() < unsent) last = Clock::now();
    if (Clock::now() - last < patience_.silence) continue;
    if (++silences == patience_.tries)
      throw WrongHardware(fmt::format("{}: the board does not answer any more; {} tests were answered",
                                      port_.name(), counts_.tests));
    out_.clear();
    send_again(waiting_.size());
    last = Clock::now();
  }
  counts_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return counts_;
}

}  // namespace hitpipe::sim
