// A traversal core (docs/core.md) as parts and wires: machines, which are control, and units, which are
// datapaths. The top module, and the software that runs cycle by cycle, are made from this value.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hls/machines/walk_format.hpp"
#include "hls/world/core_format.hpp"
#include "hls/world/ray_format.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/part/part.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// What a core is given: rays as the unit int_ray makes them, or binary32, which this unit in it makes
/// integers.
enum class Door { integer, binary32 };
/// In the order of the enumeration.
inline constexpr std::array<std::string_view, 2> door_names{"integer", "float"};
[[nodiscard]] constexpr std::string_view door_name(Door door) {
  return door_names[static_cast<std::size_t>(door)];
}

struct CoreOptions {
  static constexpr int most_rays = 256;
  static constexpr int most_levels = 60;
  static constexpr int most_block_rams = 1000;
  static constexpr int least_triangle_interval = 3;  ///< triangle_feed begins no more tests
  static constexpr int block_bits = 256;             ///< of a record or a triangle
  static constexpr int most_cache_kib = 64;
  static constexpr int door_interval = 8;  ///< cycles from ray to ray of an int_ray in a core

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
  /// Cycles from one triangle's test to the next, 3..64; or 0: a machine with one multiplier tests triangles,
  /// in some hundred cycles each.
  int triangle_interval = 4;
  Door door = Door::integer;
  /// Rays come from a ring in memory, and answers go to another; with floats at the door, and without weights.
  bool rings = false;
  bool weights = false;           ///< answers say where in its triangle a ray hits; with a triangle unit only
  bool questions = false;         ///< rays may want crossings: count and next; with a triangle unit only
  int data_bits = 256;            ///< of the AXI bus to memory: 64, 128, 256, 512
  bool in_order = false;          ///< all requests on this bus have one identifier
  std::optional<int> clock_ps{};  ///< of the units; else that of the slowest machine
  int cache_kib = 0;              ///< of a cache in front of memory: 0 for none, or a power of two, 2..64
  int cache_line = 64;            ///< bytes: 32, 64
  int cache_ways = 8;             ///< 4, 8
  int block_rams = 0;  ///< the Verilog marks memories for so many block RAMs of 16 bits (block_rams.hpp)

  static constexpr int most_ring_bits = 128;  ///< of the bus to the rings
  [[nodiscard]] int ring_bits() const { return data_bits < most_ring_bits ? data_bits : most_ring_bits; }
  [[nodiscard]] bool serial() const { return triangle_interval == 0; }
  [[nodiscard]] bool has_cache() const { return cache_kib != 0; }
  /// What a request reads.
  [[nodiscard]] int burst_bits() const { return has_cache() ? 8 * cache_line : block_bits; }

  /// A bus of another width than a block's is one with one identifier.
  [[nodiscard]] bool has_one_id() const { return in_order || data_bits != block_bits; }
  /// Beats in which this bus carries what a request reads; the widest has room for two blocks.
  [[nodiscard]] int beats() const { return data_bits < burst_bits() ? burst_bits() / data_bits : 1; }

  /// Bits of a ray's number.
  [[nodiscard]] int ray_bits() const;
  /// The name of its Verilog module unless the user gives another: "hitpipe_core" at the default format,
  /// "hitpipe_core_16p1_9s16" at another.
  [[nodiscard]] std::string module() const;
};

/// Places of parts, and of pins in their interfaces.
struct CoreWire {
  std::size_t from, output;
  std::size_t to, input;
};
/// A pin of the core and what it is joined to: an input all inputs, an output one output.
struct CorePort {
  Pin pin;
  struct End {
    std::size_t part, pin;
  };
  std::vector<End> ends;
};

struct Core {
  CoreOptions options;
  std::string module;
  int clock_ps;  ///< the slowest part's
  /// Machines and units. A unit's tags are numbers of rays. Those of `ray` are a tag and what the ray wants,
  /// in_tag and in_any, which are one port of the module.
  std::vector<Part> parts;
  std::vector<CoreWire> wires;
  std::vector<CorePort> ports;

  [[nodiscard]] const Part& part(std::string_view name) const;
  /// The port of a field of hls/machines/channels.hpp. The core must have it.
  template <class Field>
  [[nodiscard]] const Pin& pin(Field) const {
    return port_called(Field::name())->pin;
  }
  /// Its place among the inputs, or among the outputs; nothing if the core does not have it.
  template <class Field>
  [[nodiscard]] std::optional<std::size_t> place_of(Field) const {
    return place_called(Field::name());
  }
  /// clk, rst, and the ports.
  [[nodiscard]] ModuleInterface interface() const;

 private:
  [[nodiscard]] const CorePort* port_called(std::string_view name) const;
  [[nodiscard]] std::optional<std::size_t> place_called(std::string_view name) const;
};

/// Units are scheduled for the clock that is given or that of the slowest machine, or for their own slowest
/// component if that is slower. An empty `module` stands for that of the options. Throws std::runtime_error,
/// one line, for options outside their limits, and std::logic_error when a wire is missing or does not fit.
[[nodiscard]] Core make_core(const CoreOptions& options, const Library& library,
                             const std::string& module = "");
/// The same for each of the options, in their order; what they have in common is scheduled once.
[[nodiscard]] std::vector<Core> make_cores(std::span<const CoreOptions> options, const Library& library,
                                           const std::string& module = "");

/// The top module, then one for each part. The same core gives the same bytes.
[[nodiscard]] std::string to_verilog(const Core& core, const Library& library);

}  // namespace hitpipe::rtl
