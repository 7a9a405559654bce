// The options that say how a hierarchy is built, or which file it comes from.
#pragma once

#include <string>

#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/hierarchy/load_bvh.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// --builder, --max-triangles, --max-depth, --padding, --grid-bits. The values in `options` are the defaults.
void add_build_options(CLI::App& command, ref::BuildOptions& options);

/// --bvh, which takes the place of the options that say how a hierarchy is built. They must be there already.
void add_bvh_file_option(CLI::App& command, std::string& file);

/// The hierarchy of the file, padded as `build` says; built if there is no file.
[[nodiscard]] ref::LoadedBvh make_hierarchy(const std::string& file, const ref::Scene& scene,
                                            const ref::BuildOptions& build = {});

/// The builder's name for --builder.
[[nodiscard]] std::string builder_name(ref::Builder builder);

}  // namespace hitpipe::cli
