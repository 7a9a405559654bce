// What a user chooses of a core: numbers that every core has, and of each feature its own (rtl_gen/core/features).
#pragma once

#include <optional>
#include <string>

#include "hls/machines/walk_format.hpp"
#include "hls/world/core_format.hpp"
#include "hls/world/ray_format.hpp"
#include "rtl_gen/core/cache_options.hpp"

namespace hitpipe::rtl {

struct CoreOptions {
  static constexpr int most_rays = 256;
  static constexpr int most_levels = 60;
  static constexpr int most_block_rams = 1000;
  static constexpr int least_triangle_interval = 3;  ///< triangle_feed begins no more tests
  static constexpr int most_triangle_interval = 64;
  static constexpr int block_bits = 256;  ///< of a record or a triangle

  hls::RayBits bits{};       ///< rays, boxes and triangles
  int rays = 32;             ///< in flight, 1..256
  int stack_bits = 3;        ///< a ray's stack has 2^stack_bits places, 1..6
  int levels = most_levels;  ///< of records on a path, 2..60
  int address_bits = 24;     ///< of a block's number, 4..32
  int byte_bits = 32;        ///< of an address, at least address_bits + 5, at most 64
  int tag_bits = 16;         ///< of a ray's tag, 1..64
  // A core that is fitted to scenes may have fewer bits than an image has room for (hls/machines/channels.hpp).
  int number_bits = hls::triangle_number_bits;  ///< of a triangle's number, 4..32
  int leaf_bits = hls::child_count_bits;        ///< of the number of triangles in a leaf, 2..8
  int step_bits = hls::step_count_bits;         ///< of the number of records that a walk may test, 4..20
  int triangle_interval = 4;                    ///< cycles from one triangle's test to the next, 3..64
  int data_bits = 256;                          ///< of the AXI bus to memory: 64, 128, 256, 512
  bool in_order = false;                        ///< all requests on this bus have one identifier
  std::optional<int> clock_ps{};                ///< of the units; else that of the slowest machine
  int block_rams = 0;  ///< the Verilog marks memories for so many block RAMs of 16 bits

  // Of features. None has any of these.
  bool serial_triangle = false;
  bool float_door = false;
  CacheOptions cache{};
  bool rings = false;
  bool weights = false;
  bool questions = false;
  bool read_meter = false;

  /// Bits of a ray's number.
  [[nodiscard]] int ray_bits() const;
  /// A bus of another width than a block's is one with one identifier.
  [[nodiscard]] bool has_one_id() const { return in_order || data_bits != block_bits; }
  /// The name of its Verilog module unless the user gives another: "hitpipe_core" at the default format,
  /// "hitpipe_core_16p1_9s16" at another.
  [[nodiscard]] std::string module() const;
};

/// Throws std::runtime_error, one line, for options outside their limits or that do not go together.
void check_core_options(const CoreOptions& options);
/// Whether check_core_options() lets them pass.
[[nodiscard]] bool is_core(const CoreOptions& options);

}  // namespace hitpipe::rtl
