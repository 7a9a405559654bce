// In place of a core: what a core's C header, its core.hpp and Verilator give the harness, of a core with all options.
// The harness compiles with it, and linters read that. It does not run.
#pragma once

#include <array>
#include <cstdint>

#include "rtl_gen/core/harness/register_word.hpp"

#define CORE_REG_IDENTITY 0x00
#define CORE_REG_VERSION 0x04
#define CORE_REG_STATUS 0x08
#define CORE_REG_CONTROL 0x0c
#define CORE_REG_BASE_LOW 0x10
#define CORE_REG_BASE_HIGH 0x14
#define CORE_REG_LAST_BLOCK 0x18
#define CORE_REG_MOST_STEPS 0x1c
#define CORE_REG_MOST_RAYS 0x20
#define CORE_REG_CLEAR_COUNTERS 0x24
#define CORE_REG_FORMAT 0x28
#define CORE_REG_SHAPE 0x2c
#define CORE_REG_PORTS 0x30
#define CORE_REG_LIMITS 0x38
#define CORE_REG_MOST_LINES 0x34
#define CORE_REG_RAYS_LOW 0x98
#define CORE_REG_RAYS_HIGH 0x9c
#define CORE_REG_ANSWERS_LOW 0xa0
#define CORE_REG_ANSWERS_HIGH 0xa4
#define CORE_REG_RING_LAST 0xa8
#define CORE_REG_OFFERED 0xac
#define CORE_REG_INTERRUPT 0xb0
#define CORE_REG_ANSWERED 0xb4
#define CORE_COUNT_CYCLES 0x40
#define CORE_COUNT_RAYS 0x48
#define CORE_COUNT_ANSWERS 0x50
#define CORE_COUNT_HITS 0x58
#define CORE_COUNT_RECORDS 0x60
#define CORE_COUNT_TRIANGLES 0x68
#define CORE_COUNT_IDLE 0x70
#define CORE_COUNT_REFUSED 0x78
#define CORE_COUNT_CACHE_HITS 0x80
#define CORE_COUNT_CACHE_JOINS 0x88
#define CORE_COUNT_CACHE_LINES 0x90
#define CORE_IDENTITY 0x48697470u
#define CORE_VERSION 3u
#define CORE_FORMAT 0x04080008u
#define CORE_SHAPE 0x063c0020u
#define CORE_PORTS 0x99880b18u
#define CORE_LIMITS 0x1089d220u
#define CORE_IDLE 0x1u
#define CORE_RESETTING 0x2u
#define CORE_FAILED(why) (0x100u << (why))
#define CORE_BUS_ERROR 0x4000u
#define CORE_BASE_ERROR 0x8000u
#define CORE_SOFT_RESET 1u
#define CORE_EMPTY_CACHE 2u
#define CORE_RING_ERROR 0x10000u
#define CORE_UNWRITTEN 0x20000u
#define CORE_OVERFULL 0x40000u
#define CORE_RING_BEAT_BYTES 8
#define CORE_RING_LINE_BYTES 128
#define CORE_RAYS 32
#define CORE_TAG_BITS 24
#define CORE_ADDRESS_BITS 11
#define CORE_BLOCK_BITS 6
#define CORE_BLOCK_BYTES 32
#define CORE_LINE_BYTES 64
#define CORE_BEAT_BYTES 8
#define CORE_HAS_ONE_ID 0
#define CORE_BURST_BYTES 64
#define CORE_NO_HIT 0xffffffffu
#define CORE_RAY_BYTES 32
#define CORE_HIT_BYTES 16
#define CORE_LEVELS 60
#define CORE_STEP_BITS 20

constexpr RegisterWord register_words[] = {
    {CORE_REG_IDENTITY, 0, CORE_IDENTITY, Fit::largest, SoftReset::keeps, false, false},
    {CORE_REG_MOST_LINES, 0x3f, 8, Fit::from_one, SoftReset::keeps, true, false},
    {CORE_REG_OFFERED, 0xffff, 0, Fit::largest, SoftReset::clears, false, false}};
constexpr uint32_t register_bytes = 256;

struct core_ray {
  uint64_t any, once;
  float ox, dx, dy, dz;
};
struct core_hit {
  uint64_t failed, number, t;
  int64_t det_high, u_high, v_high;
  uint64_t det_low, u_low, v_low;
};
void core_pack_ray(uint8_t* bytes, const core_ray* ray);
void core_unpack_hit(core_hit* hit, const uint8_t* bytes);
void core_put_tag(uint8_t* bytes, uint32_t tag);
uint32_t core_get_tag(const uint8_t* bytes);

struct Verilated {
  static Verilated* threadContextp();
  static void commandArgs(int count, char** arguments);
  void randSeed(int seed);
  int randSeed() const;
  void randReset(int how);
};

struct Top {
  uint8_t aclk, aresetn, irq;
  uint8_t s_axi_awvalid, s_axi_awready, s_axi_awaddr, s_axi_wvalid, s_axi_wready, s_axi_wstrb;
  uint8_t s_axi_bvalid, s_axi_bready, s_axi_bresp;
  uint8_t s_axi_arvalid, s_axi_arready, s_axi_araddr, s_axi_rvalid, s_axi_rready, s_axi_rresp;
  uint32_t s_axi_wdata, s_axi_rdata;
  uint8_t m_axi_arvalid, m_axi_arready, m_axi_arid, m_axi_arlen, m_axi_arsize, m_axi_arburst, m_axi_arcache,
      m_axi_arprot;
  uint8_t m_axi_rvalid, m_axi_rready, m_axi_rid, m_axi_rresp, m_axi_rlast;
  uint32_t m_axi_araddr;
  std::array<uint32_t, CORE_BEAT_BYTES / 4> m_axi_rdata;
  uint8_t m_axi_ring_arvalid, m_axi_ring_arready, m_axi_ring_arid, m_axi_ring_arlen, m_axi_ring_arsize;
  uint8_t m_axi_ring_arburst, m_axi_ring_arcache, m_axi_ring_arprot;
  uint8_t m_axi_ring_rvalid, m_axi_ring_rready, m_axi_ring_rid, m_axi_ring_rresp, m_axi_ring_rlast;
  uint8_t m_axi_ring_awvalid, m_axi_ring_awready, m_axi_ring_awid, m_axi_ring_awlen, m_axi_ring_awsize;
  uint8_t m_axi_ring_awburst, m_axi_ring_awcache, m_axi_ring_awprot;
  uint8_t m_axi_ring_wvalid, m_axi_ring_wready, m_axi_ring_wlast, m_axi_ring_wstrb;
  uint8_t m_axi_ring_bvalid, m_axi_ring_bready, m_axi_ring_bid, m_axi_ring_bresp;
  uint32_t m_axi_ring_araddr, m_axi_ring_awaddr;
  uint64_t m_axi_ring_rdata, m_axi_ring_wdata;

  void eval();
};

constexpr char scene_file[] = "core_scene.txt";
constexpr int det_low_bits = 1, edge_low_bits = 1;

template <class Visit>
void each_field(core_ray& ray, const Visit& visit) {
  visit(ray.any);
  visit(ray.ox);
}
