// The experiments run, have the rows of the printed tables, and print the counted figures.
#include "thesis/experiment.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sw_ref/render/recording.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/message_of.hpp"
#include "thesis/printed.hpp"

namespace hitpipe::thesis::experiment_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Optional;

/// Spheres for every scene of the thesis, small images, one run.
ExperimentOptions quick() {
  ExperimentOptions options;
  for (const PrintedRow& scene : printed_table("scenes").rows())
    options.scenes[scene.text("scene")] = "spheres";
  options.width = 24;
  options.height = 16;
  options.repeats = 1;
  return options;
}

const ResultRow& row_of(const ResultTable& table, const std::vector<std::string>& labels) {
  for (const ResultRow& row : table.rows)
    if (row.labels == labels) return row;
  throw std::out_of_range("no row " + labels.back());
}

TEST(PrintedTables, HoldTheThesisFigures) {
  EXPECT_EQ(printed_table("5.1").find({"Spheres", "ray_node_tests_primary"})->number("fp32"), 38.338);
  EXPECT_EQ(printed_table("3.1").find({"slabs8-mul"})->number("time_hit0M_miss50M_s"), 3.0);
  EXPECT_EQ(printed_table("B.5").find({"1"})->number("bvh_nodes"), std::nullopt) << "out of memory";
  EXPECT_EQ(printed_table("4.1").find({"Teapot"}), nullptr);
  EXPECT_THROW((void)printed_table("4.5"), std::out_of_range);
  EXPECT_THROW((void)printed_table("4.1").rows().front().text("colour"), std::out_of_range);
}

TEST(Experiments, HaveAPrintedTableEach) {
  for (const Experiment& experiment : experiments()) {
    if (experiment.number == "text") continue;
    // Table 7.2 is printed in parts.
    const std::string table = experiment.number == "7.2" ? "7.2_summary" : std::string(experiment.number);
    EXPECT_FALSE(printed_table(table).rows().empty()) << table;
  }
  EXPECT_EQ(experiments().size(), 32U + 1U);
  EXPECT_EQ(experiments_and_proposals().size(), 32U + 1U + 3U);
}

TEST(Experiments, TimesHaveIntervalsFromSixRunsOn) {
  ExperimentOptions options = quick();
  options.only = {"Spheres"};
  for (const int repeats : {5, 6}) {
    options.repeats = repeats;
    const ResultTable table = find_experiment("4.1").run("4.1", options);
    const ResultRow& times = row_of(table, {"Spheres", "time"});
    EXPECT_EQ(times.intervals.size(), repeats == 5 ? 0 : table.columns.size());
    if (times.intervals.empty()) continue;
    EXPECT_FALSE(times.intervals[0]) << "it is 1 by definition";
    ASSERT_TRUE(times.intervals[1]);
    EXPECT_LE(times.intervals[1]->low, *times.ours[1]);
    EXPECT_GE(times.intervals[1]->high, *times.ours[1]);
  }
}

TEST(Experiments, UnknownNumberOrSceneRejected) {
  const auto message = [](auto run) { return message_of<std::runtime_error>(run); };
  EXPECT_THAT(message([] { (void)find_experiment("4.5"); }),
              AllOf(HasSubstr("4.5: no experiment"), HasSubstr("3.1, 3.2, 4.1, 4.2, 4.3")));
  EXPECT_EQ(message([] {
              ExperimentOptions options = quick();
              options.only = {"Teapot"};
              (void)find_experiment("5.3").run("5.3", options);
            }),
            "table 5.3 has no scene \"Teapot\"; it has: Spheres, Bunny");
}

class EveryExperiment : public testing::TestWithParam<std::string> {};

TEST_P(EveryExperiment, HasThePrintedRowsAndFiguresOfItsOwn) {
  ExperimentOptions options = quick();
  double share = 0;
  options.progress = [&](double now) {
    EXPECT_GE(now, share);
    share = now;
  };
  const ResultTable table = find_experiment(GetParam()).run(GetParam(), options);
  EXPECT_EQ(table.number, GetParam());
  EXPECT_DOUBLE_EQ(share, 1.0);
  EXPECT_GE(table.rows.size(), printed_table(GetParam()).rows().size());
  EXPECT_FALSE(table.findings.empty());
  EXPECT_FALSE(table.notes.empty());
  std::size_t measured = 0;
  for (const ResultRow& row : table.rows) {
    ASSERT_EQ(row.labels.size(), table.labels.size());
    ASSERT_EQ(row.ours.size(), table.columns.size());
    ASSERT_EQ(row.printed.size(), table.columns.size());
    measured += row.ours.front().has_value() ? 1 : 0;
  }
  EXPECT_GT(measured, table.rows.size() / 2);
}

INSTANTIATE_TEST_SUITE_P(Tables, EveryExperiment, testing::Values("4.2", "4.4", "5.2", "5.9", "6.1", "B.2"),
                         [](const auto& test) { return test.param[0] + std::string("_") + test.param[2]; });

TEST(HierarchicalExperiment, MemoryRowsAreExactAndTestsGrow) {
  ExperimentOptions options = quick();
  options.only = {"Spheres"};
  const ResultTable table = find_experiment("5.3").run("5.3", options);
  const ResultTable single = find_experiment("5.1").run("5.1", options);
  const ResultRow& memory = row_of(single, {"Spheres", "bvh_memory"});
  const double nodes = *memory.ours[0] / 32;
  EXPECT_EQ(memory.ours[1], nodes * 8);
  EXPECT_EQ(memory.ours[2], nodes * 12);
  for (const char* const metric : {"ray_node_tests_primary", "ray_tri_tests_primary"}) {
    const ResultRow& tests = row_of(table, {"Spheres", metric});
    EXPECT_GT(*tests.ours[1], *tests.ours[2]) << metric;
    EXPECT_GE(*tests.ours[2], 0.0) << metric;
    // For closest hits a bundle makes the same tests as its rays alone.
    EXPECT_EQ(tests.ours, row_of(single, {"Spheres", metric}).ours) << metric;
  }
  EXPECT_LT(*row_of(table, {"Spheres", "nodes_loaded_primary"}).ours[0],
            *row_of(table, {"Spheres", "ray_node_tests_primary"}).ours[0] / 4);
}

TEST(IntegerExperiment, FewerBitsNeverSaveWorkAndNoAnswerDiffers) {
  for (const char* const number : {"6.2", "6.5"}) {
    ExperimentOptions options = quick();
    options.only = {"Spheres"};
    const ResultTable table = find_experiment(number).run(number, options);
    EXPECT_EQ(table.findings.front().verdict(), Verdict::agrees) << "extra work fell as bits were taken away";
    EXPECT_EQ(table.findings.back().verdict(), Verdict::agrees) << "answers differ";
    const ResultRow& boxes = row_of(table, {"Spheres", "node", "pri"});
    EXPECT_GE(*boxes.ours.back(), *boxes.ours[1]) << number;
    options.threads = 2;
    const ResultTable threaded = find_experiment(number).run(number, options);
    for (std::size_t i = 0; i < table.rows.size(); ++i) EXPECT_EQ(table.rows[i].ours, threaded.rows[i].ours);
  }
}

TEST(IntegerExperiment, FindingHasTheFiguresOfTheRowsThatWereMeasured) {
  ExperimentOptions options = quick();
  options.only = {"Spheres"};
  options.width = 96;  // six tiles, of which more than one have rays of each kind
  options.height = 64;
  const ResultTable table = find_experiment("6.2").run("6.2", options);
  const auto spheres = std::find_if(table.findings.begin(), table.findings.end(), [](const Finding& finding) {
    return finding.claim == "16/16 bits are enough for Spheres";
  });
  ASSERT_NE(spheres, table.findings.end());
  ASSERT_EQ(spheres->figures.size(), 2U);
  EXPECT_EQ(spheres->figures[0].printed, 5) << "triangle tests";
  EXPECT_EQ(spheres->figures[1].printed, 1) << "box tests";
  for (const Comparison& figure : spheres->figures) {
    ASSERT_TRUE(figure.interval.has_value());
    EXPECT_LE(figure.interval->low, figure.ours);
    EXPECT_GE(figure.interval->high, figure.ours);
  }
}

TEST(ChildOrder, IsThatOfTable42InAllTwentyFourRows) {
  const ResultTable table = find_experiment("4.2").run("4.2", {});
  ASSERT_EQ(table.rows.size(), 24U);
  for (const ResultRow& row : table.rows) EXPECT_EQ(row.ours, row.printed) << row.labels[0] << row.labels[1];
  EXPECT_EQ(table.findings.front().figures.front().ours, 24);
}

TEST(Statements, WithoutATableAreMeasured) {
  ExperimentOptions options = quick();
  const ResultTable table = find_experiment("text").run("text", options);
  ASSERT_EQ(table.findings.size(), 4U);
  EXPECT_EQ(table.findings[1].verdict(), Verdict::agrees) << "12 and 16 bits";
  EXPECT_EQ(table.findings[2].verdict(), Verdict::agrees) << "79 and 86 %";
}

TEST(IntegerSizes, NodesHaveTheBytesOfTable61) {
  const ResultTable table = find_experiment("6.1").run("6.1", quick());
  for (const ResultRow& row : table.rows) {
    EXPECT_THAT(row.ours[0], Optional(*row.printed[0])) << row.labels.front();
    EXPECT_EQ(*row.ours[0] * *row.ours[1], *row.ours[2]) << row.labels.front();
  }
}

TEST(SceneWithoutMesh, IsNamedAndLeftEmpty) {
  ExperimentOptions options = quick();
  options.scenes.erase("Bunny");
  options.only = {"Bunny"};
  const ResultTable table = find_experiment("4.1").run("4.1", options);
  EXPECT_THAT(table.notes.front(), HasSubstr("Bunny: not measured; give a mesh with --scene Bunny=FILE"));
  EXPECT_EQ(table.rows.front().ours.front(), std::nullopt);
}

TEST(Measurement, CountsWhatTheRendererCounts) {
  const Scene scene = load_scene("spheres");
  const Bvh bvh = build_bvh(scene.mesh);
  const auto batches = record_rays(scene, bvh, 20, 12, 64);
  TracerOptions tracing;
  tracing.bundle = 64;
  const auto tracer = make_tracer(scene.mesh, bvh, tracing);
  RenderOptions options;
  options.width = 20;
  options.height = 12;
  options.tile_side = tile_side_for(64);
  const Measurement measurement = measure(*tracer, batches, 2);
  EXPECT_EQ(measurement.counts, render(scene, *tracer, options).counts);
  EXPECT_EQ(measurement.different, 0U);
  EXPECT_GT(measurement.counts.shadow.rays, 0U);
}

}  // namespace
}  // namespace hitpipe::thesis::experiment_test
