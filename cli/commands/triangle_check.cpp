#include "cli/commands/triangle_check.hpp"

#include <chrono>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "cli/commands/categories.hpp"
#include "cli/text/progress.hpp"
#include "sim/check/triangle_check.hpp"
#include "sim/unit/unit.hpp"

namespace hitpipe::cli {

namespace {

Row row_of(const sim::TriangleCategoryResult& result, bool rtl) {
  Row row{
      {"category", result.category}, {"tests", result.tests}, {"hits", result.hits}, {"wrong", result.wrong}};
  if (rtl) row["rtl_mismatches"] = result.rtl_mismatches;
  return row;
}

std::string text_of(const ref::IntCase& c) {
  const auto of = [](const auto& numbers) {
    return fmt::format("({}, {}, {})", numbers[0], numbers[1], numbers[2]);
  };
  const auto& corners = c.triangle.corners;
  return fmt::format("origin {} direction {} length {} corners {} {} {}", of(c.ray.origin),
                     of(c.ray.direction), c.ray.length, of(corners[0]), of(corners[1]), of(corners[2]));
}

}  // namespace

int check_triangle_unit(const TriangleCheck& command) {
  const rtl::Design& design = command.choice.design();
  const rtl::Format format = command.choice.format();
  const auto all = ref::int_categories();
  sim::TriangleCheckOptions options;
  options.categories = chosen_of(std::vector(all.begin(), all.end()), command.categories);
  options.tests = command.tests;
  options.seed = command.seed;
  options.threads = command.threads;
  std::optional<Progress> progress;
  std::optional<sim::VerilatedDesign> verilated;
  if (command.rtl) {
    progress.emplace("compiling the Verilog");
    verilated.emplace(
        sim::make_unit(design, format, rtl::Library::thesis(), rtl::FlowControl::stall, command.interval));
    options.rtl = &*verilated;
  }
  progress.emplace("judging");
  options.progress = [&](double share) { progress->show(share); };
  const auto start = std::chrono::steady_clock::now();
  const std::vector<sim::TriangleCategoryResult> results =
      sim::check_triangles([&] { return sim::make_triangle_test(design, format); }, options);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  progress.reset();

  std::vector<Row> rows;
  sim::TriangleCategoryResult sum;
  for (const sim::TriangleCategoryResult& result : results) {
    rows.push_back(row_of(result, command.rtl));
    sum += result;
  }
  sum.category = "all";
  rows.push_back(row_of(sum, command.rtl));
  if (command.format == OutputFormat::text)
    fmt::print("{} {}, seed {}\n", design.name, rtl::to_string(format), command.seed);
  fmt::print("{}", table_text(rows, command.format));
  if (command.format == OutputFormat::text) fmt::print("{:.1f} s\n", seconds.count());
  if (sum.first_wrong)
    fmt::print(stderr, "hitpipe: {} wrong answers; the first: {}\n", sum.wrong, text_of(*sum.first_wrong));
  if (sum.rtl_mismatches > 0)
    fmt::print(stderr, "hitpipe: {} answers of the Verilog differ from the C++\n", sum.rtl_mismatches);
  return sum.wrong > 0 || sum.rtl_mismatches > 0 ? 1 : 0;
}

}  // namespace hitpipe::cli
