// In place of a chip: the core as Verilator compiles it, a bus, two FIFOs, and a memory with a fixed latency.
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <deque>
#include <fstream>
#include <iterator>
#include <vector>

#include "Vcore_axi.h"
#include "driver.h"

namespace {

class System {
 public:
  std::vector<std::uint8_t> memory;

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
  bool send(std::uint32_t tag, const std::uint8_t* bytes) {
    tick();
    if (rays_.size() == places) return false;
    std::memcpy(rays_.emplace_back(tag).bytes.data(), bytes, CORE_RAY_BYTES);
    return true;
  }
  bool take(std::uint32_t* tag, std::uint8_t* bytes) {
    tick();
    if (hits_.empty()) return false;
    *tag = hits_.front().tag;
    std::memcpy(bytes, hits_.front().bytes.data(), CORE_HIT_BYTES);
    hits_.pop_front();
    return true;
  }

 private:
  static constexpr std::size_t places = 16;  // of a FIFO
  static constexpr std::uint64_t latency = 40;
  template <std::size_t count>
  struct Beat {
    std::uint32_t tag;
    std::array<std::uint8_t, count> bytes{};
  };
  struct Read {
    std::uint64_t due, address;
    std::uint32_t id;
  };
  // Verilator keeps a port in words of the computer, the lowest first, so its bytes can be copied.
  static_assert(std::endian::native == std::endian::little);
  static_assert(sizeof(Vcore_axi::m_axi_rdata) == CORE_BLOCK_BYTES);  // a block is a beat

  // One clock cycle. Before its edge: what each side offers. At the edge both see what the other has taken.
  void tick() {
    top_.m_axi_arready = 1;
    top_.m_axi_rvalid = !reads_.empty() && reads_.front().due <= cycle_;
    if (top_.m_axi_rvalid) {
      top_.m_axi_rid = reads_.front().id, top_.m_axi_rlast = 1;
      std::memcpy(&top_.m_axi_rdata, &memory.at(reads_.front().address), CORE_BLOCK_BYTES);
    }
    top_.s_axis_ray_tvalid = !rays_.empty();
    if (top_.s_axis_ray_tvalid) {
      top_.s_axis_ray_tid = rays_.front().tag;
      std::memcpy(&top_.s_axis_ray_tdata, rays_.front().bytes.data(), CORE_RAY_BYTES);
    }
    top_.m_axis_hit_tready = hits_.size() < places;
    top_.aclk = 0, top_.eval();
    if (top_.aresetn) {
      if (top_.m_axi_rvalid) reads_.pop_front();  // rready is always 1
      if (top_.m_axi_arvalid) reads_.push_back({cycle_ + latency, top_.m_axi_araddr, top_.m_axi_arid});
      if (top_.s_axis_ray_tvalid && top_.s_axis_ray_tready) rays_.pop_front();
      if (top_.m_axis_hit_tvalid && top_.m_axis_hit_tready)
        std::memcpy(hits_.emplace_back(top_.m_axis_hit_tid).bytes.data(), &top_.m_axis_hit_tdata,
                    CORE_HIT_BYTES);
    }
    top_.aclk = 1, top_.eval();
    ++cycle_;
  }

  Vcore_axi top_;
  std::deque<Beat<CORE_RAY_BYTES>> rays_;
  std::deque<Beat<CORE_HIT_BYTES>> hits_;
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

bool fifo_send(uint32_t tag, const uint8_t* bytes) {
  return chip.send(tag, bytes);
}

bool fifo_take(uint32_t* tag, uint8_t* bytes) {
  return chip.take(tag, bytes);
}

// An image may be anywhere in memory, at a multiple of 64.
uint32_t place_image(const char* file_name) {
  constexpr uint32_t address = 0x1000;
  std::ifstream file(file_name, std::ios::binary);
  chip.memory.resize(address);
  chip.memory.insert(chip.memory.end(), std::istreambuf_iterator<char>(file), {});
  return address;
}
