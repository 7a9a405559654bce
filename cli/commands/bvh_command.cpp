#include <algorithm>
#include <bit>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "cli/commands.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/closed_text.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "host/text.hpp"
#include "rays/files/mesh_file.hpp"
#include "rays/scene/normalise.hpp"
#include "rays/tree/bvh_file.hpp"
#include "sim/software/software.hpp"
#include "sw_ref/hierarchy/statistics.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace hitpipe::cli {

namespace {

struct BvhCommand {
  SceneChoice scene;
  ref::HierarchyOptions hierarchy;
  std::string out;
  std::string records;
  DesignChoice unit;  ///< that reads the records
  bool sweep = false;
  OutputFormat format = OutputFormat::text;
};

/// "3:120": 120 leaves have 3 triangles. Beyond 16 triangles, ranges double in size: "17-32:5".
Row leaf_sizes(const std::vector<std::size_t>& leaves_of) {
  constexpr std::size_t last_alone = 16;
  Row sizes = Row::array();
  for (std::size_t first = 1; first < leaves_of.size();) {
    const std::size_t last = first <= last_alone ? first : std::bit_ceil(first);
    std::size_t leaves = 0;
    for (std::size_t n = first; n <= std::min(last, leaves_of.size() - 1); ++n) leaves += leaves_of[n];
    const std::string range = first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last);
    if (leaves > 0) sizes.push_back(fmt::format("{}:{}", range, leaves));
    first = last + 1;
  }
  return sizes;
}

/// A number has six digits, and all in JSON.
Row number_cell(double number, OutputFormat format) {
  return format == OutputFormat::json ? Row(number) : Row(fmt::format("{:.6g}", number));
}

/// A binary32 of a file has as many digits as it needs.
std::string coordinate_text(double x) {
  const auto binary32 = static_cast<float>(x);
  return static_cast<double>(binary32) == x ? fmt::format("{}", binary32) : fmt::format("{:.9g}", x);
}

/// In JSON an array.
Row point_cell(const glm::dvec3& p, OutputFormat format) {
  return format == OutputFormat::json
             ? Row{p.x, p.y, p.z}
             : Row(fmt::format("{} {} {}", coordinate_text(p.x), coordinate_text(p.y), coordinate_text(p.z)));
}

/// What was read: the area of all triangles and their bounds, in the scene's own units.
Row extent_of(const ref::Scene& scene, std::span<const glm::dvec3> vertices, OutputFormat format) {
  double area = 0;
  ref::Bounds box{vertices[scene.mesh.triangles[0].x], vertices[scene.mesh.triangles[0].x]};
  for (const glm::uvec3& t : scene.mesh.triangles) {
    const glm::dvec3& a = vertices[t.x];
    area += glm::length(glm::cross(vertices[t.y] - a, vertices[t.z] - a)) / 2;
    for (int k = 0; k < 3; ++k) box.grow(vertices[t[k]]);
  }
  return {{"area", number_cell(area, format)},
          {"min", point_cell(box.min, format)},
          {"max", point_cell(box.max, format)}};
}

/// Of a file whose instances have more triangles than its meshes: what it stores, and what flattening makes of it.
/// Bytes are those of corners, triangles and instances in own units.
Row instances_of(const std::string& file, std::size_t flattened_vertices) {
  if (!ref::may_have_instances(file)) return Row::object();
  const ref::OwnInstances own = ref::load_instances(file);
  std::size_t vertices = 0;
  std::size_t stored = 0;
  for (const ref::SourceMesh& mesh : own.meshes) {
    vertices += mesh.vertices.size();
    stored += mesh.triangles.size();
  }
  std::size_t flattened = 0;
  for (const ref::OwnInstance& instance : own.instances)
    flattened += own.meshes[instance.mesh].triangles.size();
  if (stored >= flattened) return Row::object();
  const auto bytes = [](std::size_t corners, std::size_t triangles) {
    return corners * sizeof(glm::dvec3) + triangles * sizeof(glm::uvec3);
  };
  return {{"meshes", own.meshes.size()},
          {"instances", own.instances.size()},
          {"triangles_stored", stored},
          {"triangles_flattened", flattened},
          {"bytes_stored", bytes(vertices, stored) + own.instances.size() * sizeof(ref::OwnInstance)},
          {"bytes_flattened", bytes(flattened_vertices, flattened)}};
}

Row record(const BvhCommand& command, const ref::Scene& scene, std::span<const glm::dvec3> vertices,
           const ref::LoadedBvh& hierarchy, double seconds) {
  const ref::BvhStatistics s = ref::statistics(hierarchy.bvh);
  Row row{{"scene", scene.name}};
  row.update(scene_row(scene));
  row.update(extent_of(scene, vertices, command.format));
  row.update(instances_of(command.scene.name, vertices.size()));
  row.update(closed_row(scene, vertices, command.format));
  if (command.hierarchy.file.empty()) {
    row["builder"] = ref::builder_name(command.hierarchy.build.builder);
    row["max_triangles"] = command.hierarchy.build.max_triangles;
  } else {
    row["bvh"] = command.hierarchy.file.string();
    row["bvh_boxes_grown"] = hierarchy.boxes_grown;
  }
  row.update({{"bvh_nodes", s.nodes},
              {"leaves", s.leaves},
              {"depth", s.depth},
              {"triangles_per_leaf", s.mean_in_leaf()},
              {"triangles_in_largest_leaf", s.most_in_leaf()},
              {"leaves_by_triangles", leaf_sizes(s.leaves_of)},
              {"sah_cost", s.sah_cost},
              {"child_overlap_pct", 100.0 * s.child_overlap},
              {"node_bytes", s.node_bytes},
              {"order_bytes", s.order_bytes},
              {command.hierarchy.file.empty() ? "build_seconds" : "read_seconds", seconds}});
  return row;
}

/// Where the user names none, the first design that has records.
DesignChoice unit_of_records(const BvhCommand& command) {
  if (!command.unit.name.empty()) {
    const rtl::Design& design = command.unit.design();
    if (sim::software_of(design).records == nullptr)
      throw std::runtime_error(sim::missing(design, "record of a node that its unit reads"));
    return command.unit;
  }
  for (const rtl::Design& design : rtl::designs())
    if (sim::software_of(design).records != nullptr) return {std::string(design.name), command.unit.bits};
  throw std::runtime_error("--records: no design has records of its own");
}

/// A record a line, its last byte first. Bit i of the record is then bit i of the number.
std::string hex_lines(const sim::NodeRecords& records) {
  std::string text;
  for (std::size_t record = 0; record < records.bytes.size(); record += records.bytes_per_record) {
    for (std::size_t i = records.bytes_per_record; i-- > 0;)
      fmt::format_to(std::back_inserter(text), "{:02x}", std::to_integer<int>(records.bytes[record + i]));
    text += '\n';
  }
  return text;
}

/// Throws before the hierarchy is built.
bool is_binary(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension != ".hex" && extension != ".bin")
    throw std::runtime_error(fmt::format("--records {}: unknown extension \"{}\"; allowed are .hex and .bin",
                                         file, host::shortened(extension)));
  return extension == ".bin";
}

Row write_records(const BvhCommand& command, const ref::Bvh& bvh) {
  const DesignChoice unit = unit_of_records(command);
  const std::string name = fmt::format("{} {}", unit.name, to_string(unit.format()));
  const sim::NodeRecords records = sim::software_of(unit.design()).records(unit.format(), bvh);
  const std::size_t count = records.bytes.size() / records.bytes_per_record;
  const std::string text =
      is_binary(command.records)
          ? std::string(reinterpret_cast<const char*>(records.bytes.data()), records.bytes.size())
          : fmt::format("// {}: {} records of {} bytes. docs/scenes.md says what their bits are.\n{}", name,
                        count, records.bytes_per_record, hex_lines(records));
  host::write_file(command.records, text);
  return {{"records", command.records},
          {"records_of", name},
          {"record_count", count},
          {"record_bytes", records.bytes_per_record}};
}

/// `vertices` are those of the scene in its own units.
void print_one(const BvhCommand& command, const ref::Scene& scene, std::span<const glm::dvec3> vertices) {
  std::optional<Progress> progress(command.hierarchy.file.empty() ? "building the hierarchy"
                                                                  : "reading the hierarchy");
  const auto start = std::chrono::steady_clock::now();
  const ref::LoadedBvh hierarchy = ref::make_hierarchy(scene, command.hierarchy);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  Row row = record(command, scene, vertices, hierarchy, seconds.count());
  if (!command.out.empty()) {
    host::write_file(command.out, ref::bvh_text(hierarchy.bvh, scene.mesh));
    row["file"] = command.out;
  }
  if (!command.records.empty()) row.update(write_records(command, hierarchy.bvh));
  progress.reset();
  fmt::print("{}", record_text(row, command.format));
}

void print_sweep(const BvhCommand& command, const ref::Scene& scene) {
  std::optional<Progress> progress("building hierarchies");
  std::vector<Row> rows;
  ref::sweep_max_triangles(scene.mesh, command.hierarchy.build, [&](const ref::SweepStep& step) {
    const ref::BvhStatistics s = ref::statistics(step.bvh);
    rows.push_back({{"max_triangles", step.max_triangles},
                    {"bvh_nodes", s.nodes},
                    {"depth", s.depth},
                    {"sah_cost", s.sah_cost},
                    {"node_bytes", s.node_bytes},
                    {"build_seconds", step.build_seconds}});
    progress->show(static_cast<double>(rows.size()) / static_cast<double>(ref::appendix_b_sizes.size()));
  });
  progress.reset();
  if (command.format == OutputFormat::text) {
    fmt::print("{}: {}, {}\n", scene.name, summary_of(scene_row(scene)),
               ref::builder_name(command.hierarchy.build.builder));
  }
  if (command.format == OutputFormat::json)
    for (Row& row : rows) row.update(scene_row(scene));
  fmt::print("{}", table_text(rows, command.format));
}

void report(BvhCommand command) {
  command.hierarchy.build.threads = command.scene.threads;
  if (!command.records.empty()) {
    static_cast<void>(is_binary(command.records));
    static_cast<void>(unit_of_records(command).format());
  }
  std::optional<Progress> progress("reading the scene");
  ref::SceneDescription description = ref::describe_scene(command.scene.name, command.scene.placing);
  const std::vector<glm::dvec3> vertices =
      command.sweep ? std::vector<glm::dvec3>() : description.mesh.vertices;
  const ref::Scene scene = command.scene.placed(std::move(description));
  progress.reset();
  if (command.sweep) {
    print_sweep(command, scene);
  } else {
    print_one(command, scene, vertices);
  }
}

}  // namespace

CLI::App* add_bvh_command(CLI::App& program, int& /*exit_code*/) {
  CLI::App* const command =
      program.add_subcommand("bvh", "Build a scene's hierarchy: figures, file, records for a unit");
  const auto options = std::make_shared<BvhCommand>();
  add_scene_options(*command, options->scene);
  for (const char* const of_an_image : {"--width", "--height"}) {
    command->remove_option(command->get_option(of_an_image));
  }
  add_hierarchy_options(*command, options->hierarchy);
  as_output(
      command->add_option("--out", options->out, "Write the hierarchy to this file, which --bvh reads"));
  const CLI::Option* const records = as_output(command->add_option(
      "--records", options->records,
      "Write the hierarchy as the design's unit reads it: .hex for $readmemh, a record a line; .bin as in "
      "memory"));
  add_design_options(*command, options->unit);
  command->get_option("design")->required(false)->description(
      "The design of --records. Default: the first that has records of its own");
  CLI::Option* const sweep = command->add_flag("--sweep", options->sweep,
                                               "A row for each leaf size of Appendix B, 1 to 512 triangles");
  for (const char* const other : {"--max-triangles", "--bvh", "--out", "--records"})
    exclude(sweep, command->get_option(other), "it builds a hierarchy for each leaf size");
  add_format_option(*command, options->format);
  add_examples(*command,
               {"hitpipe bvh --scene statue", "hitpipe bvh --scene spheres --builder sah --out spheres.bvh"});
  command->callback([options, records] {
    if (records->count() == 0 && (!options->unit.name.empty() || options->unit.bits))
      throw std::runtime_error("bvh: a design and --bits belong to --records; give --records FILE");
    report(*options);
  });
  return command;
}

}  // namespace hitpipe::cli
