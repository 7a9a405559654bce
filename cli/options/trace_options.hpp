// The options by which a command chooses how it traces in software and how far it follows rays.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hls/world/world_format.hpp"
#include "rays/trace/tracer.hpp"
#include "sw_ref/render/whitted.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// Adds --bounces, --diffuse, --occlusion, --light-seed.
void add_light_options(CLI::App& command, ref::WhittedOptions& options);

struct RayListChoice {
  std::string file;     ///< of the rays; empty: those of a picture
  std::string answers;  ///< a file for them, text/answers_file.hpp; empty: none

  [[nodiscard]] bool given() const { return !file.empty(); }
};

/// Adds --rays, a file in place of the picture's rays, and --answers. The options of the picture and its light
/// are excluded.
void add_ray_list_options(CLI::App& command, RayListChoice& choice);
/// Of a command that has them and can be cut into pieces.
void exclude_answers_of_pieces(CLI::App& command);

enum class World : std::uint8_t { floats, integers };

struct TraceChoice {
  World world = World::floats;
  ref::TracerOptions tracer;
  std::optional<std::string> bits;  ///< as the user wrote it

  /// Throws std::runtime_error, one line, when the bits are not a format, or when nothing uses them.
  /// ref::make_tracer() refuses combinations that do not exist.
  [[nodiscard]] ref::TracerOptions options() const;
  /// The format of the integer world. Throws std::runtime_error, one line, when the bits are not one.
  [[nodiscard]] hls::WorldBits world_bits() const;
};

/// Adds --world, --traversal, --arithmetic, --bits, --encoding, --lut, --bundle, --triangle-test.
void add_trace_options(CLI::App& command, TraceChoice& choice);

/// The options that choose this algorithm, arithmetic and format, for example "--traversal slabs-dsa
/// --arithmetic integer --bits 20/24".
[[nodiscard]] std::string trace_options_text(const ref::TracerOptions& options);

}  // namespace hitpipe::cli
