#include "sim/cosim/ray_writer.hpp"

#include <algorithm>

namespace hitpipe::sim {

RayWriter::RayWriter(const rtl::RaySlots& slots, std::size_t operand_count, std::size_t rays)
    : operand_count_(operand_count), line_(slots.line_places), end_(slots.end_places), rays_(rays) {}

bool RayWriter::holds(std::size_t slot, const std::int64_t* operands) {
  std::vector<std::int64_t>& ray = rays_[slot];
  const auto same = [&](std::size_t place) { return ray[place] == operands[place]; };
  const bool same_line = !ray.empty() && std::all_of(line_.begin(), line_.end(), same);
  if (same_line && std::all_of(end_.begin(), end_.end(), same)) return true;
  ray.assign(operands, operands + operand_count_);
  waiting_.push_back({slot, same_line});
  return false;
}

void RayWriter::drive(Pins& pins) {
  pins_ = {.in_slot = pins.in_tag};
  if (!waiting_.empty()) {
    const Write& write = waiting_.front();
    pins_.valid = true;
    pins_.end_only = write.end_only;
    pins_.slot = static_cast<std::uint16_t>(write.slot);
    pins_.operands = rays_[write.slot].data();
  }
  pins.rays = &pins_;
}

std::optional<std::size_t> RayWriter::written() {
  if (!pins_.valid || !pins_.ready) return std::nullopt;
  const Write write = waiting_.front();
  waiting_.pop_front();
  (write.end_only ? ends_written_ : rays_written_) += 1;
  return write.slot;
}

}  // namespace hitpipe::sim
