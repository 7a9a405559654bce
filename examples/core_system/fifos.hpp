// How rays come to a core and answers leave: two FIFOs.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <vector>

#include "Vcore_axi.h"
#include "driver.h"

class RayPort {
 public:
  bool send(std::uint32_t tag, const std::uint8_t* bytes) {
    if (rays_.size() == places) return false;
    std::memcpy(rays_.emplace_back(tag).bytes.data(), bytes, CORE_RAY_BYTES);
    return true;
  }
  bool take(std::uint32_t* tag, std::uint8_t* bytes) {
    if (hits_.empty()) return false;
    *tag = hits_.front().tag;
    std::memcpy(bytes, hits_.front().bytes.data(), CORE_HIT_BYTES);
    hits_.pop_front();
    return true;
  }
  void show(Vcore_axi& top, const std::vector<std::uint8_t>& /*memory*/, std::uint64_t /*cycle*/) {
    top.s_axis_ray_tvalid = !rays_.empty();
    if (top.s_axis_ray_tvalid) {
      top.s_axis_ray_tid = rays_.front().tag;
      std::memcpy(&top.s_axis_ray_tdata, rays_.front().bytes.data(), CORE_RAY_BYTES);
    }
    top.m_axis_hit_tready = hits_.size() < places;
  }
  void step(const Vcore_axi& top, std::vector<std::uint8_t>& /*memory*/, std::uint64_t /*cycle*/) {
    if (top.s_axis_ray_tvalid && top.s_axis_ray_tready) rays_.pop_front();
    if (top.m_axis_hit_tvalid && top.m_axis_hit_tready)
      std::memcpy(hits_.emplace_back(top.m_axis_hit_tid).bytes.data(), &top.m_axis_hit_tdata, CORE_HIT_BYTES);
  }

 private:
  static constexpr std::size_t places = 16;  // of a FIFO
  template <std::size_t count>
  struct Beat {
    std::uint32_t tag;
    std::array<std::uint8_t, count> bytes{};
  };
  std::deque<Beat<CORE_RAY_BYTES>> rays_;
  std::deque<Beat<CORE_HIT_BYTES>> hits_;
};
