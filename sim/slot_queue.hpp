// The slots whose rays can send a test, in the order in which they became ready.
#pragma once

#include <cstddef>
#include <vector>

namespace hitpipe::sim {

/// First in, first out. Each slot is in it once at most.
class SlotQueue {
 public:
  explicit SlotQueue(std::size_t slots) : ring_(slots) {}

  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::size_t front() const { return ring_[front_]; }
  void push(std::size_t slot) {
    const std::size_t end = front_ + count_++;
    ring_[end < ring_.size() ? end : end - ring_.size()] = slot;
  }
  void pop() {
    --count_;
    if (++front_ == ring_.size()) front_ = 0;
  }

 private:
  std::vector<std::size_t> ring_;
  std::size_t front_ = 0;
  std::size_t count_ = 0;
};

}  // namespace hitpipe::sim
