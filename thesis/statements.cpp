// Table 4.2, and statements of chapters 4 to 6 that the thesis makes without a table.
#include <array>
#include <string>

#include <fmt/format.h>

#include "rays/trace/child_order.hpp"
#include "sw_ref/render/recording.hpp"
#include "thesis/printed.hpp"
#include "thesis/tables.hpp"
#include "thesis/test_scene.hpp"

namespace hitpipe::thesis {
namespace {

/// By how many percent a hierarchy or encoding makes more box tests than the plain one.
double more_box_tests(const std::vector<RecordedBatch>& rays, const Tracer& tracer, const Tracer& plain) {
  const auto tests = [&](const Tracer& of) {
    return static_cast<double>(measure(of, rays, 1).counts.total().box_tests);
  };
  return 100.0 * (tests(tracer) / tests(plain) - 1.0);
}

TracerOptions thesis_tracing(Encoding encoding = Encoding::plain,
                             Arithmetic arithmetic = Arithmetic::binary32) {
  TracerOptions options;
  options.algorithm = Algorithm::plu_dsa;
  options.arithmetic = arithmetic;
  options.encoding = encoding;
  return options;
}

Finding padding_costs_nothing(const Scene& scene, const Bvh& plain, const std::vector<RecordedBatch>& rays) {
  BuildOptions thinner;
  thinner.padding = 6e-8F;
  const Bvh thin = build_bvh(scene.mesh, thinner);
  const double fewer = more_box_tests(rays, *make_tracer(scene.mesh, thin, thesis_tracing()),
                                      *make_tracer(scene.mesh, plain, thesis_tracing()));
  return {"4.3: boxes padded by 5e-7 are as good as boxes padded by 6e-8",
          {{"more box tests with 6e-8, %", 0, fewer, half_percent}}};
}

Finding more_bits_change_nothing(const Scene& scene, const Bvh& plain,
                                 const std::vector<RecordedBatch>& rays) {
  Finding finding{"5.4: relative nodes of 12 and 16 bits cost no more tests", {}, {}};
  const auto add = [&](const char* bits, Encoding encoding) {
    const double more = more_box_tests(rays, *make_tracer(scene.mesh, plain, thesis_tracing(encoding)),
                                       *make_tracer(scene.mesh, plain, thesis_tracing()));
    finding.figures.push_back({fmt::format("more box tests at {} bits, %", bits), 0, more, half_percent});
  };
  add("12", Encoding::hierarchical_12);
  add("16", Encoding::hierarchical_16);
  return finding;
}

Finding savings_against_binary64(const Scene& scene, const Bvh& plain) {
  const auto bytes = [&](const TracerOptions& options) {
    return static_cast<double>(make_tracer(scene.mesh, plain, options)->bytes_per_node());
  };
  TracerOptions doubles = thesis_tracing(Encoding::plain, Arithmetic::binary64);
  doubles.triangle_test = TriangleTest::binary64;
  const double whole = bytes(doubles);
  const auto saved = [&](Encoding encoding) { return 100 * (1 - bytes(thesis_tracing(encoding)) / whole); };
  return {"5.7: against binary64 nodes 8 bits save 79 %, 4 bits 86 % of the memory",
          {{"saved at 8 bits, %", 79, saved(Encoding::hierarchical_8), half_percent},
           {"saved at 4 bits, %", 86, saved(Encoding::hierarchical_4), half_percent}}};
}

Finding twelve_bits_halve_the_plant(const Scene& scene) {
  const auto nodes = [&](int grid_bits) {
    BuildOptions options;
    options.grid_bits = grid_bits;
    return static_cast<double>(build_bvh(scene.mesh, options).nodes.size());
  };
  return {
      "6.2.3: a grid of 12 bits halves the nodes of the power plant",
      {{"fewer nodes, %", 50, 100 * (1 - nodes(12) / nodes(0)), half_percent}},
      "the stand-in has far fewer triangles than the 12.7 million of the thesis's, so fewer of its boxes are "
      "smaller than the grid's unit"};
}

}  // namespace

ResultTable child_orders(std::string_view number, const ExperimentOptions& options) {
  ResultTable table;
  table.number = number;
  table.title = "The child that a ray visits first, by its direction";
  table.labels = {"ray", "split"};
  table.columns = {{"first_child", 0}};
  double equal = 0;
  for (const PrintedRow& thesis : printed_table(number).rows()) {
    const std::string& ray = thesis.text("ray_class");
    const auto component = [&](std::size_t axis) { return ray[axis] == 'M' ? -1.0F : 1.0F; };
    const int axis = thesis.text("split_axis").front() - 'x';
    const double ours = near_child(direction_class({component(0), component(1), component(2)}), axis);
    const double printed = thesis.text("first_child") == "child1" ? 1 : 0;
    equal += ours == printed ? 1 : 0;
    table.rows.push_back({.labels = {ray, thesis.text("split_axis")}, .ours = {ours}, .printed = {printed}});
  }
  table.findings = {{"a ray visits first the child on the side that it comes from",
                     {{"orders that are equal", static_cast<double>(table.rows.size()), equal}}}};
  table.notes = {
      "P: the direction's component is positive; M: negative. 0 is the child on the negative side"};
  options.progress(1.0);
  return table;
}

ResultTable statements(std::string_view number, const ExperimentOptions& options) {
  ResultTable table;
  table.number = number;
  table.title = "Statements of chapters 4 to 6 without a table";
  const auto measured = [&](const std::string& name) {
    const std::optional<Scene> scene = test_scene(name, options);
    table.notes.push_back(scene_note(name, scene));
    return scene;
  };
  if (const std::optional<Scene> scene = measured("Spheres")) {
    const Bvh plain = build_bvh(scene->mesh);
    const std::vector<RecordedBatch> rays = record_rays(*scene, plain, options.width, options.height, 1);
    table.findings.push_back(padding_costs_nothing(*scene, plain, rays));
    table.findings.push_back(more_bits_change_nothing(*scene, plain, rays));
    table.findings.push_back(savings_against_binary64(*scene, plain));
  }
  options.progress(0.5);
  if (const std::optional<Scene> scene = measured("Powerplant-Front"))
    table.findings.push_back(twelve_bits_halve_the_plant(*scene));
  options.progress(1.0);
  return table;
}

}  // namespace hitpipe::thesis
