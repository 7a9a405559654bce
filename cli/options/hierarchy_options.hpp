// The options that say how a hierarchy is built, or which file it comes from.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "rays/tree/bvh.hpp"
#include "rays/tree/load_bvh.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// Adds --builder, --max-triangles, --max-depth, --grid-bits, --padding if boxes are floats, and --bvh, which
/// takes the place of the others but the padding. The values in `options` are the defaults.
enum class Boxes : std::uint8_t { floats, integers };
void add_hierarchy_options(CLI::App& command, ref::HierarchyOptions& options, Boxes boxes = Boxes::floats);

/// The names of these options.
[[nodiscard]] std::span<const std::string_view> hierarchy_option_names();

/// The options that make this hierarchy, whatever a command's defaults are: "--builder sah --max-triangles
/// 2", or "--bvh FILE".
[[nodiscard]] std::string hierarchy_arguments(const ref::HierarchyOptions& options);

}  // namespace hitpipe::cli
