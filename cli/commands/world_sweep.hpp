// `sweep` of a triangle unit: what the bits of the integer world cost and change.
#pragma once

#include <string>
#include <vector>

#include "cli/options/scene_options.hpp"
#include "cli/text/table.hpp"
#include "rays/scene/scene.hpp"
#include "rays/tree/load_bvh.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "sw_ref/render/whitted.hpp"

namespace hitpipe::cli {

struct WorldSweep {
  const rtl::Design* design;
  std::vector<Format> formats;
  std::vector<int> mantissas;  ///< p of the boxes; one row for each
  SceneChoice scene;
  ref::HierarchyOptions hierarchy;
  ref::WhittedOptions light;
  const rtl::Library* library;
  int interval;
};

struct WorldFindings {
  std::string head;  ///< one line: scene, size, triangles, hierarchy
  std::vector<Row> rows;
  Row notes;  ///< what stands beside the rows
};

/// n = 16, 18, 20, 22 and 24 with a finer bit, and as many bits of a slope.
[[nodiscard]] std::vector<Format> usual_world_formats();

/// Reads the scene and measures. The camera is added to the notes.
[[nodiscard]] WorldFindings sweep_world(const WorldSweep& command, Row notes);

[[nodiscard]] Row to_row(const WorldFindings& findings);
/// Throws nlohmann's exceptions for another form.
[[nodiscard]] WorldFindings parse_world_findings(const Row& row);

/// Writes the rows to the .csv file and the notes beside it, prints the rows and returns the exit code.
int report_world(const WorldFindings& findings, const std::string& out, OutputFormat format);

}  // namespace hitpipe::cli
