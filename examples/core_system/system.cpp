// In place of a chip: the core as Verilator compiles it, a bus, and a memory with a fixed latency.
#include <bit>
#include <cstdint>
#include <cstring>
#include <deque>
#include <fstream>
#include <iterator>
#include <vector>

#include "Vcore_axi.h"
#include "driver.h"
#if CORE_HAS_RINGS
#include "ring_port.hpp"
#else
#include "fifos.hpp"
#endif

namespace {

class System {
 public:
  std::vector<std::uint8_t> memory;
  RayPort rays;

  System() {
    top_.aresetn = 0;
    tick();
    top_.aresetn = 1;
    top_.s_axi_wstrb = 15, top_.s_axi_bready = 1, top_.s_axi_rready = 1;
  }
  // Nothing else uses this bus, so the core takes a write or a read at once. Its answer needs some cycles.
  void write(std::uint32_t reg, std::uint32_t value) {
    top_.s_axi_awvalid = top_.s_axi_wvalid = 1;
    top_.s_axi_awaddr = reg, top_.s_axi_wdata = value;
    tick();
    top_.s_axi_awvalid = top_.s_axi_wvalid = 0;
    while (!top_.s_axi_bvalid) tick();
    tick();
  }
  std::uint32_t read(std::uint32_t reg) {
    top_.s_axi_arvalid = 1, top_.s_axi_araddr = reg;
    tick();
    top_.s_axi_arvalid = 0;
    while (!top_.s_axi_rvalid) tick();
    const std::uint32_t value = top_.s_axi_rdata;
    tick();
    return value;
  }
  // One clock cycle. Before its edge: what each side offers. At the edge both see what the other has taken.
  void tick() {
    top_.m_axi_arready = 1;
    top_.m_axi_rvalid = !reads_.empty() && reads_.front().due <= cycle_;
    if (top_.m_axi_rvalid) {
      const Read& read = reads_.front();
      top_.m_axi_rid = read.id, top_.m_axi_rlast = read.beats == 1;
      std::memcpy(&top_.m_axi_rdata, &memory.at(read.address), CORE_BEAT_BYTES);
    }
    rays.show(top_, memory, cycle_);
    top_.aclk = 0, top_.eval();
    if (top_.aresetn) {
      if (top_.m_axi_rvalid && top_.m_axi_rready) {
        reads_.front().address += CORE_BEAT_BYTES;
        if (--reads_.front().beats == 0) reads_.pop_front();
      }
      if (top_.m_axi_arvalid)
        reads_.push_back({cycle_ + latency, top_.m_axi_araddr, top_.m_axi_arid, top_.m_axi_arlen + 1U});
      rays.step(top_, memory, cycle_);
    }
    top_.aclk = 1, top_.eval();
    ++cycle_;
  }

 private:
  static constexpr std::uint64_t latency = 40;
  struct Read {
    std::uint64_t due, address;
    std::uint32_t id, beats;  // that are to come
  };
  // Verilator keeps a port in words of the computer, the lowest first, so its bytes can be copied.
  static_assert(std::endian::native == std::endian::little);
  static_assert(sizeof(Vcore_axi::m_axi_rdata) == CORE_BEAT_BYTES);
  static_assert(CORE_BEAT_BYTES <= CORE_BURST_BYTES);

  Vcore_axi top_;
  std::deque<Read> reads_;
  std::uint64_t cycle_ = 0;
};

System chip;

}  // namespace

void bus_write(uint32_t address, uint32_t value) {
  chip.write(address - CORE_REGISTERS, value);
}

uint32_t bus_read(uint32_t address) {
  return chip.read(address - CORE_REGISTERS);
}

#if CORE_HAS_RINGS
void memory_write(uint64_t address, const uint8_t* bytes, uint32_t count) {
  std::memcpy(&chip.memory.at(address), bytes, count);
}

void memory_read(uint64_t address, uint8_t* bytes, uint32_t count) {
  std::memcpy(bytes, &chip.memory.at(address), count);
}

uint32_t place_rings(uint32_t bytes) {
  const auto place = (static_cast<uint32_t>(chip.memory.size()) + 127) / 128 * 128;
  chip.memory.resize(place + bytes);
  return place;
}
#else
bool fifo_send(uint32_t tag, const uint8_t* bytes) {
  chip.tick();
  return chip.rays.send(tag, bytes);
}

bool fifo_take(uint32_t* tag, uint8_t* bytes) {
  chip.tick();
  return chip.rays.take(tag, bytes);
}
#endif

// An image may be anywhere in memory, at a multiple of 64.
uint32_t place_image(const char* file_name) {
  constexpr uint32_t address = 0x1000;
  std::ifstream file(file_name, std::ios::binary);
  chip.memory.resize(address);
  chip.memory.insert(chip.memory.end(), std::istreambuf_iterator<char>(file), {});
  return address;
}
