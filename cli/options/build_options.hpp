// The options by which every command that needs a hierarchy says how it is built.
#pragma once

#include <string>

#include "sw_ref/bvh/bvh.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// --builder, --max-triangles, --max-depth, --padding, --grid-bits. What `options` holds are the defaults.
void add_build_options(CLI::App& command, ref::BuildOptions& options);

/// As --builder takes it.
[[nodiscard]] std::string builder_name(ref::Builder builder);

}  // namespace hitpipe::cli
