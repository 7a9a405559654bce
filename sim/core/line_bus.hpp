// Lines that memory gives to a core with a cache, in beats of its bus, cycle by cycle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rays/image/core_image.hpp"
#include "rtl_gen/core/core.hpp"
#include "sim/core/memory_model.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::sim {

struct BusBeat {
  std::uint32_t id = 0;                  ///< of the request
  bool error = false;                    ///< it could not be read
  std::array<std::uint64_t, 8> words{};  ///< the first words of them, 64 bits each, are the bus
};

class LineBus {
 public:
  /// `blocks` must outlive it, and so must the core. If `mingles`, beats have gaps, and where requests have
  /// identifiers, beats of several lines mingle.
  LineBus(std::span<const ref::CoreBlock> blocks, const rtl::CoreBus& bus, bool mingles, std::uint64_t seed);

  /// A line that memory gives in this cycle.
  void take(const MemoryAnswer& line);
  /// What is shown in this cycle. It stays until it is taken.
  [[nodiscard]] std::optional<BusBeat> beat() const;
  /// The clock edge.
  void step(bool taken);

 private:
  struct Line {
    MemoryAnswer answer;
    int beats = 0;  ///< that were taken
    int bad = 0;    ///< of a line with an error: the beat that has it
  };
  void choose();

  std::span<const ref::CoreBlock> blocks_;
  const rtl::CoreBus& bus_;
  bool mingles_;
  ref::adversary::Random random_;
  std::vector<Line> lines_;  ///< the oldest first
  std::optional<std::size_t> shown_;
};

}  // namespace hitpipe::sim
