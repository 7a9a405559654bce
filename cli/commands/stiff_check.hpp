// `hitpipe check --stiff`: false hits as the components of a ray's direction grow apart.
#pragma once

#include <cstdint>
#include <string>

#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/report/picture.hpp"
#include "cli/text/table.hpp"

namespace hitpipe::cli {

struct StiffCheck {
  DesignsChoice units;  ///< without names: the designs that never miss
  std::string scene;    ///< empty: only drawn boxes
  ref::HierarchyOptions hierarchy;
  std::uint64_t tests = 60'000;
  std::uint64_t rays = 2'000;
  std::uint64_t seed = 1;
  int threads = 1;
  std::string out;
  PictureForm pictures = page_form;
  OutputFormat format = OutputFormat::text;
};

/// Prints the table and returns the exit code. The notes go into the folder, beside the rows.
[[nodiscard]] int check_stiff_rays(const StiffCheck& command, const Row& notes);

}  // namespace hitpipe::cli
