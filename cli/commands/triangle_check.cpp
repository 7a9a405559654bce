#include "cli/commands/triangle_check.hpp"

#include <chrono>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "cli/commands/categories.hpp"
#include "cli/text/kept.hpp"
#include "cli/text/progress.hpp"
#include "rtl_gen/emit/unit.hpp"

namespace hitpipe::cli {

template <>
struct Kept<sim::TriangleCategoryResult> {
  static void each(auto& result, const auto& member) {
    member("category", result.category);
    member("tests", result.tests);
    member("hits", result.hits);
    member("ties", result.ties);
    member("counted", result.counted);
    member("wrong", result.wrong);
    member("rtl_mismatches", result.rtl_mismatches);
  }
};

namespace {

Row row_of(const sim::TriangleCategoryResult& result, bool rtl, bool crossings) {
  Row row{{"category", result.category}, {"tests", result.tests}, {"hits", result.hits}};
  if (crossings) {
    row["ties"] = result.ties;
    row["counted"] = result.counted;
  }
  row["wrong"] = result.wrong;
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

TriangleFindings& TriangleFindings::operator+=(const TriangleFindings& later) {
  for (std::size_t i = 0; i < categories.size(); ++i) categories[i] += later.categories.at(i);
  if (first_wrong.empty()) first_wrong = later.first_wrong;
  seconds += later.seconds;
  return *this;
}

std::vector<ref::IntCategory> triangle_categories(const DesignChoice& choice,
                                                  const std::vector<std::string>& names) {
  const auto all = ref::int_categories(sim::make_triangle_test(choice.design(), choice.format())->world());
  return chosen_of(std::vector(all.begin(), all.end()), names);
}

TriangleFindings check_triangle_unit(const TriangleCheck& command) {
  const rtl::Design& design = command.choice.design();
  const Format format = command.choice.format();
  sim::TriangleCheckOptions options;
  options.categories = triangle_categories(command.choice, command.categories);
  options.tests = command.tests;
  options.seed = command.seed;
  options.piece = command.piece;
  options.threads = command.threads;
  std::optional<Progress> progress;
  std::optional<sim::VerilatedDesign> verilated;
  if (command.rtl) {
    progress.emplace("compiling the Verilog");
    verilated.emplace(rtl::make_unit(design, format, rtl::Library::thesis(), {.interval = command.interval}));
    options.rtl = &*verilated;
  }
  progress.emplace("judging");
  options.progress = [&](double share) { progress->show(share); };
  const auto start = std::chrono::steady_clock::now();
  TriangleFindings found{{std::string(design.name), format, command.seed, command.rtl}};
  found.categories = sim::check_triangles([&] { return sim::make_triangle_test(design, format); }, options);
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (const sim::TriangleCategoryResult& result : found.categories)
    if (found.first_wrong.empty() && result.first_wrong) found.first_wrong = text_of(*result.first_wrong);
  return found;
}

void to_json(Row& row, const TriangleFindings& findings) {
  to_json(row, static_cast<const CheckedUnit&>(findings));
  row.update({{"categories", findings.categories},
              {"first_wrong", findings.first_wrong},
              {"seconds", findings.seconds}});
}

void from_json(const Row& row, TriangleFindings& findings) {
  from_json(row, static_cast<CheckedUnit&>(findings));
  row.at("categories").get_to(findings.categories);
  row.at("first_wrong").get_to(findings.first_wrong);
  row.at("seconds").get_to(findings.seconds);
}

int report_findings(const TriangleFindings& findings, OutputFormat format) {
  std::vector<Row> rows;
  sim::TriangleCategoryResult sum;
  const bool crossings =
      findings.format.is<hls::WorldBits>() && findings.format.as<hls::WorldBits>().crossings != 0;
  for (const sim::TriangleCategoryResult& result : findings.categories) {
    rows.push_back(row_of(result, findings.rtl, crossings));
    sum += result;
  }
  sum.category = "all";
  rows.push_back(row_of(sum, findings.rtl, crossings));
  if (format == OutputFormat::text) fmt::print("{}", head_of(findings));
  fmt::print("{}", table_text(rows, format));
  if (format == OutputFormat::text) fmt::print("{:.1f} s\n", findings.seconds);
  if (sum.wrong > 0)
    fmt::print(stderr, "hitpipe: {} wrong answers; the first: {}\n", sum.wrong, findings.first_wrong);
  if (sum.rtl_mismatches > 0)
    fmt::print(stderr, "hitpipe: {} answers of the Verilog differ from the C++\n", sum.rtl_mismatches);
  return sum.wrong > 0 || sum.rtl_mismatches > 0 ? 1 : 0;
}

}  // namespace hitpipe::cli
