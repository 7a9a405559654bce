#include "cli/options/world_options.hpp"

#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "host/format.hpp"

namespace hitpipe::cli {

std::optional<hls::MajorBits> BoxFormatChoice::format(const hls::WorldBits& world) const {
  if (!bits) return std::nullopt;
  const auto boxes = parse_bits<hls::MajorBits>(*bits);
  if (boxes.coord != world.coord || boxes.finer != world.finer || boxes.slope != world.slope ||
      boxes.fraction > world.finer + world.fraction)
    throw std::runtime_error(fmt::format(
        "--boxes {}: for triangles of {} allowed is {}+{}/pfFs{} with F at most {}", *bits,
        to_string(Format(world)), world.coord, world.finer, world.slope, world.finer + world.fraction));
  return boxes;
}

hls::MajorBits usual_box_format(const hls::WorldBits& world) {
  return {world.coord, world.finer, 11, 0, world.slope};
}

hls::RayBits usual_ray_format(const hls::WorldBits& world) {
  const hls::MajorBits boxes = usual_box_format(world);
  return {world.coord, world.finer, boxes.mantissa, boxes.fraction, world.slope, world.fraction};
}

void add_box_format_option(CLI::App& command, BoxFormatChoice& choice, const std::string& otherwise) {
  command
      .add_option(
          "--boxes", choice.bits,
          "Number format of the boxes in the integer world, for example 20+1/11s20. Default: " + otherwise)
      ->type_name("n+g/psS");
}

}  // namespace hitpipe::cli
