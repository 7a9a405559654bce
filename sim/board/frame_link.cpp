#include "sim/board/frame_link.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "sim/cosim/counts.hpp"

namespace hitpipe::sim {

namespace {

using LinkClock = std::chrono::steady_clock;

constexpr int most_sendings = 10;
constexpr std::chrono::milliseconds most_wait{50};
constexpr char who_kind = 'I';

}  // namespace

std::vector<std::string> FrameLink::exchange(std::chrono::milliseconds wait) {
  const std::size_t before = out_.size();
  const std::string in = port_.exchange(out_, wait);
  counts_.bytes_sent += before - out_.size();
  counts_.bytes_received += in.size();
  std::vector<std::string> payloads;
  for (const char byte : in)
    if (std::optional<std::string> payload = reader_.take(byte)) payloads.push_back(*std::move(payload));
  return payloads;
}

std::string FrameLink::identity() {
  const std::string question = to_frame(std::string{who_kind, '?'});
  counts_ = {};
  for (int tries = 0; tries < patience_.tries; ++tries) {
    out_ = question;
    const LinkClock::time_point end = patience_.now() + patience_.silence;
    while (patience_.now() < end) {
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

void FrameLink::require(const std::string& here, std::string_view what) {
  const std::string there = identity();
  if (here == there) return;
  throw std::runtime_error(
      fmt::format("{}: the board has \"{}\", and the {} are for \"{}\"", port_.name(), there, what, here));
}

void FrameLink::fill(const Kind& kind, const Next& next) {
  while (more_ && waiting_.size() < kind.most_waiting) {
    std::optional<Question> question = next();
    if (!question) {
      more_ = false;
      return;
    }
    // Tags go round, so that a late answer is not taken for that of another question.
    const auto taken = [&](char tag) {
      return std::any_of(waiting_.begin(), waiting_.end(), [&](const Waiting& w) { return w.tag == tag; });
    };
    while (taken(static_cast<char>(next_tag_))) ++next_tag_;
    const char tag = static_cast<char>(next_tag_++);
    std::string frame = to_frame(std::string{kind.letter, tag} + question->body);
    out_ += frame;
    waiting_.push_back({*std::move(question), std::move(frame), tag});
  }
}

bool FrameLink::receive(const Kind& kind, const std::string& payload, const Answered& answered) {
  if (payload.size() != 2 + kind.answer_bytes || payload[0] != kind.letter) return false;
  const auto found =
      std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& w) { return w.tag == payload[1]; });
  if (found == waiting_.end()) return false;
  const auto place = static_cast<std::size_t>(found - waiting_.begin());
  const std::uint64_t number = found->question.number;
  waiting_.erase(found);
  for (std::size_t i = 0; i < place; ++i) ++waiting_[i].overtaken;
  // Those that are sent again go to the end, behind the ones that are looked at.
  for (std::size_t i = 0, seen = 0; seen < place; ++seen)
    if (waiting_[i].overtaken > kind.overtaken)
      send_again(kind, i);
    else
      ++i;
  ++counts_.answered;
  answered(number, std::string_view(payload).substr(2));
  return true;
}

void FrameLink::send_again(const Kind& kind, std::size_t place) {
  Waiting lost = std::move(waiting_[place]);
  waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(place));
  if (++lost.sendings > most_sendings)
    throw WrongHardware(fmt::format("{}: {} {} was sent {} times and never answered", port_.name(), kind.noun,
                                    lost.question.number, most_sendings));
  ++counts_.resent;
  lost.overtaken = 0;
  out_ += lost.frame;
  waiting_.push_back(std::move(lost));
}

FrameLink::Counts FrameLink::run(const Kind& kind, const Next& next, const Answered& answered) {
  counts_ = {};
  more_ = true;
  waiting_.clear();
  const LinkClock::time_point start = patience_.now();
  LinkClock::time_point last = start;
  int silences = 0;
  while (true) {
    fill(kind, next);
    if (waiting_.empty()) break;
    const std::size_t unsent = out_.size();
    bool progress = false;
    for (const std::string& payload : exchange(most_wait))
      progress = receive(kind, payload, answered) || progress;
    if (progress) silences = 0;
    if (progress || out_.size() < unsent) last = patience_.now();
    if (patience_.now() - last < patience_.silence) continue;
    if (++silences == patience_.tries)
      throw WrongHardware(fmt::format("{}: the board does not answer any more; {} {}s were answered",
                                      port_.name(), counts_.answered, kind.noun));
    out_.clear();
    for (std::size_t i = waiting_.size(); i > 0; --i) send_again(kind, 0);
    last = patience_.now();
  }
  counts_.seconds = std::chrono::duration<double>(patience_.now() - start).count();
  return counts_;
}

}  // namespace hitpipe::sim
