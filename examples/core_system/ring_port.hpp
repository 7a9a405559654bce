// How rays come to a core with --rings and answers leave: by a port to memory, which takes one write at a time.
#pragma once

#include <cstdint>
#include <cstring>
#include <deque>
#include <vector>

#include "Vcore_axi.h"
#include "driver.h"

class RayPort {
 public:
  void show(Vcore_axi& top, const std::vector<std::uint8_t>& memory, std::uint64_t cycle) {
    top.m_axi_ring_arready = top.m_axi_ring_awready = top.m_axi_ring_wready = 1;
    top.m_axi_ring_rvalid = !reads_.empty() && reads_.front().due <= cycle;
    if (top.m_axi_ring_rvalid)
      std::memcpy(&top.m_axi_ring_rdata, &memory.at(reads_.front().address), CORE_RING_BEAT_BYTES);
    top.m_axi_ring_bvalid = written_;
#if !CORE_HAS_ONE_ID
    if (top.m_axi_ring_rvalid) top.m_axi_ring_rid = reads_.front().id;
    top.m_axi_ring_bid = write_id_;
#endif
  }
  void step(const Vcore_axi& top, std::vector<std::uint8_t>& memory, std::uint64_t cycle) {
    if (top.m_axi_ring_rvalid) {
      reads_.front().address += CORE_RING_BEAT_BYTES;
      if (--reads_.front().beats == 0) reads_.pop_front();
    }
    if (top.m_axi_ring_arvalid)
      reads_.push_back({cycle + latency, top.m_axi_ring_araddr, top.m_axi_ring_arlen + 1U});
    if (top.m_axi_ring_awvalid) address_ = top.m_axi_ring_awaddr;
#if !CORE_HAS_ONE_ID
    if (top.m_axi_ring_arvalid) reads_.back().id = top.m_axi_ring_arid;
    if (top.m_axi_ring_awvalid) write_id_ = top.m_axi_ring_awid;
#endif
    written_ = top.m_axi_ring_wvalid && top.m_axi_ring_wlast;
    if (!top.m_axi_ring_wvalid) return;
    std::memcpy(&memory.at(address_), &top.m_axi_ring_wdata, CORE_RING_BEAT_BYTES);
    address_ += CORE_RING_BEAT_BYTES;
  }

 private:
  static constexpr std::uint64_t latency = 40;
  struct Read {
    std::uint64_t due, address;
    std::uint32_t beats;  // that are to come
    std::uint8_t id = 0;
  };
  std::deque<Read> reads_;
  std::uint8_t write_id_ = 0;
  std::uint64_t address_ = 0;  // of the next beat that is written
  bool written_ = false;
};
