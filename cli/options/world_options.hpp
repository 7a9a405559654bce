// The formats of the integer world, for commands that trace in it.
#pragma once

#include <optional>
#include <string>

#include "cli/text/table.hpp"
#include "hls/box/major_format.hpp"
#include "hls/world/ray_format.hpp"
#include "hls/world/world_format.hpp"
#include "rays/world/int_scene.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// What the option --boxes says: a format of the boxes. Nothing: `otherwise` is used.
struct BoxFormatChoice {
  std::optional<std::string> bits;

  /// Throws std::runtime_error, one line, for what is no format, or none of this world.
  [[nodiscard]] std::optional<hls::MajorBits> format(const hls::WorldBits& world) const;
};

/// The box format of a world unless the user names one: p is 11, and box distances have no fraction bits.
[[nodiscard]] hls::MajorBits usual_box_format(const hls::WorldBits& world);
/// The rays of a world with such boxes.
[[nodiscard]] hls::RayBits usual_ray_format(const hls::WorldBits& world);

/// Adds --boxes. `otherwise` tells the help what is used without it.
void add_box_format_option(CLI::App& command, BoxFormatChoice& choice, const std::string& otherwise);

}  // namespace hitpipe::cli
