// The options that say how a hierarchy is built. Every command that needs one takes them.
#pragma once

#include <string>

#include "sw_ref/bvh/bvh.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// --builder, --max-triangles, --max-depth, --padding, --grid-bits. The values in `options` are the defaults.
void add_build_options(CLI::App& command, ref::BuildOptions& options);

/// The builder's name for --builder.
[[nodiscard]] std::string builder_name(ref::Builder builder);

}  // namespace hitpipe::cli
