#include "cli/text/remaining_time.hpp"

namespace hitpipe::cli {

void RemainingTime::add(Duration elapsed, double share) {
  samples_.push_back({elapsed, share});
  while (samples_.size() > 2 && samples_[1].elapsed <= elapsed * (2.0 / 3.0)) samples_.pop_front();
}

std::optional<RemainingTime::Duration> RemainingTime::left() const {
  const Sample &before = samples_.front(), &now = samples_.back();
  if (now.share >= 1) return Duration{0};
  const double grown = now.share - before.share;
  if (grown <= 0) return std::nullopt;
  return (now.elapsed - before.elapsed) * ((1 - now.share) / grown);
}

}  // namespace hitpipe::cli
