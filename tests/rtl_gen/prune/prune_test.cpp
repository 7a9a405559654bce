// Whole designs pruned by demands: the unfitted C++'s answers, nothing more and nothing less left, and
// without demands the design as it was.
#include "rtl_gen/prune/prune.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/prune/all_ports.hpp"
#include "tests/rtl_gen/prune/demand_sets.hpp"

namespace hitpipe::rtl::prune_test {
namespace {

using hls::Role;

std::string verilog_of(const Graph& graph) {
  return to_verilog(make_pipeline(graph, Library::thesis()), Library::thesis());
}

class PrunedDesign : public testing::TestWithParam<DesignFormat> {
 protected:
  const Design& design = GetParam().found();
  const Format format = GetParam().parsed();
  const Graph traced = design.trace(format);
};

/// Against the unfitted design's C++. tests/formal proves it of all operands.
TEST_P(PrunedDesign, AnswersAsTheUnfittedOne) {
  Seeded random(311);
  const int vectors = !design.conservative ? 100 : 500;
  const std::vector<Port> ports = design.ports(format);
  const Evaluate native = design.evaluate(format);
  const std::vector<hls::Result> stated = design.results(format);
  std::vector<std::int64_t> results(stated.size());
  int compared = 0;
  int hits = 0;
  for (const DemandSet& set : demand_sets(design, format)) {
    const Graph fitted = prune(traced, set.demands, {.shares = false}).graph;
    const Draw draw(ports, set.demands);
    for (const Graph& graph : {fitted, with_all_ports(fitted, input_ports(traced))}) {
      for (int i = 0; i < vectors; ++i, ++compared) {
        const std::vector<std::int64_t> operands = draw(random);
        native(operands.data(), results.data());
        ASSERT_EQ(patterns_of(evaluate(graph, operands_left(graph, ports, operands)), stated),
                  patterns_of(results, stated))
            << set.name << ": " << testing::PrintToString(operands);
        hits += native.yes(results.data()) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(hits, compared / 200);
}

TEST_P(PrunedDesign, WithoutDemandsIsAsItWas) {
  const Pruned pruned = prune(traced, {});
  EXPECT_EQ(to_text(pruned.graph), to_text(traced));
  EXPECT_EQ(verilog_of(pruned.graph), verilog_of(traced));
  EXPECT_TRUE(pruned.report.cuts.empty());
  EXPECT_EQ(pruned.report.before, pruned.report.after);
}

TEST_P(PrunedDesign, ByWhatItsPortsPromiseAnywayIsAsItWas) {
  const Demands promised = set_up_demands(design.ports(format));
  EXPECT_EQ(verilog_of(prune(traced, promised, {.set_up = promised}).graph), verilog_of(traced));
  Demands whole;
  for (const Port& port : input_ports(traced)) whole.ports.push_back({port.name, {all_numbers(port)}});
  EXPECT_EQ(verilog_of(prune(traced, whole).graph), verilog_of(traced)) << "all that the widths can hold";
}

TEST_P(PrunedDesign, IsAFixedPoint) {
  for (const DemandSet& set : demand_sets(design, format)) {
    const auto pruned = [&](const Graph& graph) {
      return with_all_ports(prune(graph, set.demands, {.shares = false}).graph, input_ports(traced));
    };
    const Graph once = pruned(traced);
    const Graph twice = pruned(once);
    EXPECT_EQ(to_text(once), to_text(twice)) << set.name;
  }
}

TEST_P(PrunedDesign, InfiniteRaysHaveNoLength) {
  const Scene scene(design, format);
  if (!scene.has(Role::endless)) GTEST_SKIP() << "its rays have no end";
  const Pruned pruned = prune(traced, {{{scene.with({Role::endless})[0].name, {{1, 1}}}}});
  std::vector<std::string> ends;
  for (const Port& port : scene.with({Role::endless, Role::length, Role::endpoint}))
    ends.push_back(port.name);
  EXPECT_THAT(pruned.report.dropped_ports(), testing::UnorderedElementsAreArray(ends));
  EXPECT_LT(pruned.report.after.bits, pruned.report.before.bits);
}

TEST_P(PrunedDesign, OneDirectionClassHasNoMultiplexersOfTheClass) {
  const Scene scene(design, format);
  if (scene.with(Scene::directions).empty() || scene.has(Role::backward) || !design.kind.of_boxes)
    GTEST_SKIP() << "its directions have no sign, or choose no planes";
  const PruneReport report = prune(traced, Scene(scene).one_direction().demands(), {.shares = false}).report;
  const auto muxes = [](const Size& size) {
    int count = 0;
    for (const auto& [name, n] : size.components) count += name.starts_with("mux2") ? n : 0;
    return count;
  };
  if (scene.has(Role::direction)) {
    EXPECT_EQ(muxes(report.after), 0);
  } else {
    EXPECT_EQ(muxes(report.before) - muxes(report.after), 6)
        << "two on each axis choose by the reciprocal's sign";
  }
}

INSTANTIATE_TEST_SUITE_P(Designs, PrunedDesign, testing::ValuesIn(every_design({"24/24", "20/24", "6/11"})),
                         design_suffix);

TEST(Prune, IllegalDemandsAreRejected) {
  const Graph traced = find_design("int_slabs").trace(hls::IntBits{6, 6});
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              return prune(traced, {{{"rinf", {{2, 2}}}}, {}});
            }),
            "demand on rinf: 2 is outside its 1 bits, [0, 1]");
}

TEST(Prune, ANarrowAxisHasNarrowDifferences) {
  const Design& design = find_design("int_slabs");
  const Pruned pruned =
      prune(design.trace(hls::IntBits{24, 24}),
            {{{"iry", {{-100, 100}}}, {"iymin", {{-100, 100}}}, {"iymax", {{-100, 100}}}}, {}});
  EXPECT_EQ(pruned.report.after.components.at("int_subtract_9"), 2);
  EXPECT_EQ(pruned.report.after.components.at("mux2_9"), 2);
  std::vector<std::string> narrowed;
  for (const PortChange& change : pruned.report.ports)
    narrowed.push_back(fmt::format("{} {} -> {}", change.port, change.bits_before, change.bits_after));
  EXPECT_THAT(narrowed, testing::ElementsAre("iry 24 -> 8", "iymin 24 -> 8", "iymax 24 -> 8"));
}

/// Low three bits of y's origin and planes: neither read nor latched, in ports as wide as they were.
TEST(Prune, ACoarseAxisHasNoLowBits) {
  for (const char* const name : {"int_slabs", "int_plucker"}) {
    const Design& design = find_design(name);
    const Format format = hls::IntBits{24, 24};
    const Graph traced = design.trace(format);
    const Demands coarse = Scene(design, format).coarse_axis().demands();
    const Pruned pruned = prune(traced, coarse, {.shares = false});
    EXPECT_EQ(pruned.report.after.components.at("int_subtract_21"), 2) << name;
    for (const PortChange& change : pruned.report.ports) {
      const bool box = change.port == "iymin" || change.port == "iymax";
      EXPECT_FALSE(box) << change.port << " has " << change.bits_after << " bits";
    }
    std::vector<std::string> cuts;
    for (const Cut& cut : pruned.report.cuts) cuts.push_back(fmt::format("{} {}", cut.name, cut.bits_after));
    EXPECT_THAT(cuts, testing::IsSupersetOf({"iry 20", "iymin 21", "iymax 21"})) << name;
    int narrow_products = 0;
    for (NodeId id = 0; id < pruned.graph.size(); ++id)
      if (pruned.graph[id].op == Op::mul) narrow_products += pruned.graph[id].width == 45 ? 1 : 0;
    EXPECT_EQ(narrow_products, design.name == "int_slabs" ? 2 : 4) << name << ": 21 x 24";
    const std::string verilog = verilog_of(pruned.graph);
    for (const char* const latched :
         {"iry_s0 <= iry[22:3];", "iymin_s0 <= iymin[23:3];", "iymax_s0 <= iymax[23:3];"})
      EXPECT_NE(verilog.find(latched), std::string::npos) << name << ": " << latched;
  }
}

TEST(PruneReport, SaysWhatWentAndForWhichDemand) {
  const Design& design = find_design("int_slabs");
  const Demands demands{{{"rinf", {{1, 1}}}, {"iri_floor", {{0, 100}}}}, {}};
  const PruneReport report = prune(design.trace(hls::IntBits{24, 24}), demands).report;
  std::vector<std::string> cuts;
  for (const Cut& cut : report.cuts) cuts.push_back(cut_text(cut));
  EXPECT_THAT(cuts, testing::IsSupersetOf({"rinf: port gone (fold_constants; rinf = 1)",
                                           "irlen: port gone (fold_constants; rinf = 1)",
                                           "beyond: int_compare gone (fold_constants; rinf = 1)",
                                           "d_near_x: mux2 gone (simplify_muxes; iri_floor in [0, 100])",
                                           "iri_floor: port 24 -> 7 bits (narrow; iri_floor in [0, 100])"}))
      << testing::PrintToString(cuts);
  ASSERT_EQ(report.shares.size(), 2U);
  EXPECT_EQ(report.shares[0].demand, "rinf = 1");
  EXPECT_EQ(report.shares[0].nodes, 3) << "one comparator, OR, AND";
  EXPECT_GT(report.shares[1].bits, 24);
}

TEST(PruneReport, DemandsThatDoOneThingTogetherShareNothing) {
  Graph graph("either");
  const NodeId p = graph.input("p", 1, false);
  const NodeId q = graph.input("q", 1, false);
  const NodeId r = graph.input("r", 1, false);
  graph.output("o", graph.binary(Op::bit_and, graph.binary(Op::bit_or, p, q), r));
  graph.annotate(graph.outputs().front().node, "both", {});
  const PruneReport report = prune(graph, {{{"p", {{1, 1}}}, {"q", {{1, 1}}}}, {}}).report;
  EXPECT_EQ(report.after.nodes, 0);
  ASSERT_FALSE(report.cuts.empty());
  for (const Cut& cut : report.cuts) {
    if (cut.name == "both") {
      EXPECT_TRUE(cut.demands.empty()) << cut_text(cut);
    }
  }
}

TEST(DemandFields, AreInTheManifestAndComeBack) {
  const Design& design = find_design("int_slabs");
  const Demands demands{{{"rinf", {{1, 1}}}, {"iry", {{-9, -1}, {1, 9}}}, {"izmin", {{-64, 64}}, 4}},
                        {{"ixmin", "ixmax"}}};
  const Pruned pruned = prune(design.trace(hls::IntBits{20, 24}), demands);
  const Library& library = Library::thesis();
  Json json = manifest(make_unit(design, hls::IntBits{20, 24}, library, make_pipeline(pruned.graph, library)),
                       library);
  const Json plain = json;
  add_demands(json, {}, {});
  EXPECT_EQ(json, plain);
  EXPECT_EQ(demands_of_manifest(plain.dump()), Demands{});
  add_demands(json, demands, pruned.report);
  EXPECT_EQ(demands_of_manifest(json.dump()), demands);
  EXPECT_EQ(json.at("dropped_ports"), Json({"irlen", "rinf"}));
  EXPECT_NE(json.dump().find(R"({"name":"iry","from":20,"to":5})"), std::string::npos) << json;
}

TEST(DemandFields, ABrokenOneIsRejected) {
  EXPECT_EQ(message_of([] { return demands_of_manifest(R"({"demands": [{"port": 3}]})"); }),
            "manifest: \"demands\" is not a list of demands");
}

TEST(DemandFields, NameLowZerosOnlyWhereThereAreAny) {
  const std::string plain = R"({"demands": [{"port": "a", "within": [[0, 8]]}]})";
  EXPECT_EQ(demands_of_manifest(plain), (Demands{{{"a", {{0, 8}}}}, {}}));
  Json json;
  add_demands(json, {{{"a", {{0, 8}}}, {"b", {{0, 8}}, 2}}, {}}, {});
  const std::string fitted = json.dump();
  EXPECT_EQ(fitted.find("low_zeros"), fitted.rfind("low_zeros")) << fitted;
  EXPECT_EQ(demands_of_manifest(fitted), (Demands{{{"a", {{0, 8}}}, {"b", {{0, 8}}, 2}}, {}}));
}

}  // namespace
}  // namespace hitpipe::rtl::prune_test
