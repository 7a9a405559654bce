#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "area_model/price.hpp"
#include "rtl_gen/component/library.hpp"
#include "thesis/printed.hpp"
#include "thesis/proposals.hpp"
#include "thesis/tables.hpp"

namespace hitpipe::thesis {

ResultTable component_library(std::string_view number, const ExperimentOptions& options) {
  const rtl::Library& library = rtl::Library::thesis();
  ResultTable table;
  table.number = number;
  table.title = "Circuits: area, delay of the slowest stage, stages";
  table.labels = {"circuit"};
  table.columns = {{"area_mm2", 6}, {"delay_ns", 3}, {"stages", 0}};
  double equal = 0;
  for (const PrintedRow& thesis : printed_table(number).rows()) {
    const int bits = static_cast<int>(*thesis.number("bits"));
    const rtl::Cell cell = library.cell(rtl::component_called(thesis.text("component")), bits);
    ResultRow row{
        .labels = {fmt::format("{}_{}", thesis.text("component"), bits)},
        .ours = {cell.area_um2 / 1e6, cell.delay_ps / 1e3, cell.stages},
        .printed = {thesis.number("area_mm2"), thesis.number("delay_ns"), thesis.number("pipeline_stages")}};
    equal += row.ours == row.printed ? 1 : 0;
    table.rows.push_back(std::move(row));
  }
  table.findings = {{"the library has the circuits of the table",
                     {{"rows that are equal", static_cast<double>(table.rows.size()), equal}}}};
  table.notes = {fmt::format("ours: the library {}", library.name())};
  options.progress(1.0);
  return table;
}

namespace {

/// The figures of a unit in Table 7.2: a column of the printed data and ours in the same unit.
struct Figure {
  const char* name;
  int decimals;
  double (*of)(const area::Price& price);
};

constexpr std::array figures{
    Figure{"total_area_mm2", 4, [](const area::Price& p) { return static_cast<double>(p.area_um2) / 1e6; }},
    Figure{"pipe_stages", 0, [](const area::Price& p) { return static_cast<double>(p.stages); }},
    Figure{"stage_delay_ns", 3, [](const area::Price& p) { return p.stage_delay_ps / 1e3; }},
    Figure{"clock_mhz", 0, [](const area::Price& p) { return 1e6 / p.stage_delay_ps; }},
    Figure{"latency_ns", 3, [](const area::Price& p) { return static_cast<double>(p.latency_ps()) / 1e3; }},
    Figure{"adp_mm2_ns", 3,
           [](const area::Price& p) { return static_cast<double>(p.area_delay_per_box()) / 1e9; }}};

/// The place of a unit in Table 7.2.
enum Row : std::size_t { float_slabs, float_plucker, slabs_24, slabs_20, plucker_24, plucker_20 };

/// A figure of one unit as a share of another unit's figure, in percent, in both sources.
class Shares {
 public:
  Shares(const PrintedTable& printed, const std::vector<area::Price>& ours)
      : printed_(printed), ours_(ours) {}

  /// By how much one figure is more than the other, in percent.
  [[nodiscard]] Comparison more(const std::string& what, std::size_t figure, Row unit) const {
    Comparison share = of("more " + what, figure, unit);
    share.printed -= 100;
    share.ours -= 100;
    return share;
  }

  [[nodiscard]] Comparison of(const std::string& what, std::size_t figure, Row unit,
                              Row whole = float_slabs) const {
    return {what + ", %", 100 * printed(figure, unit) / printed(figure, whole),
            100 * figures.at(figure).of(ours_[unit]) / figures.at(figure).of(ours_[whole]), 0.5};
  }

 private:
  [[nodiscard]] double printed(std::size_t figure, Row unit) const {
    return *printed_.rows()[unit].number(figures.at(figure).name);
  }
  const PrintedTable& printed_;
  const std::vector<area::Price>& ours_;
};

std::vector<Finding> chapter_7_findings(const Shares& share) {
  constexpr std::size_t area = 0;
  constexpr std::size_t stages = 1;
  constexpr std::size_t latency = 4;
  constexpr std::size_t adp = 5;
  return {
      {"float Pluecker takes 90 % more area and area-delay than float slabs, and 54 % more stages",
       {share.more("area", area, float_plucker), share.more("area x delay", adp, float_plucker),
        share.more("stages", stages, float_plucker)}},
      {"integer slabs take 52 and 37 % of the area of float slabs",
       {share.of("area at 24/24", area, slabs_24), share.of("area at 20/24", area, slabs_20)}},
      {"and 38 and 31 % of the stages, 42 and 34 % of the latency",
       {share.of("stages at 24/24", stages, slabs_24), share.of("stages at 20/24", stages, slabs_20),
        share.of("latency at 24/24", latency, slabs_24), share.of("latency at 20/24", latency, slabs_20)}},
      {"and 58 and 41 % of the area-delay: a factor of two",
       {share.of("area x delay at 24/24", adp, slabs_24), share.of("area x delay at 20/24", adp, slabs_20)}},
      {"integer Pluecker takes nearly twice the area of integer slabs",
       {share.of("area at 24/24 of slabs 24/24", area, plucker_24, slabs_24),
        share.of("area at 20/24 of slabs 20/24", area, plucker_20, slabs_20)}},
      {"integer Pluecker 24/24 is as large as float slabs, with more area-delay",
       {share.of("area", area, plucker_24), share.of("area x delay", adp, plucker_24)}}};
}

}  // namespace

ResultTable unit_prices(std::string_view number, const ExperimentOptions& options) {
  const PrintedTable& printed = printed_table("7.2_summary");
  ResultTable table;
  table.number = number;
  table.title = "Six units: area, stages, delay, clock, latency, area-delay product";
  table.labels = {"unit"};
  for (const Figure& figure : figures) {
    double unit = 0.5;
    for (int i = 0; i < figure.decimals; ++i) unit /= 10;
    table.columns.push_back({figure.name, figure.decimals, unit});
  }
  std::vector<area::Price> built;
  for (std::size_t i = 0; i < area::table_7_2().size(); ++i) {
    const area::Entry& entry = area::table_7_2()[i];
    const rtl::Design& design = rtl::find_design(entry.design);
    const area::Price as_printed =
        area::price(design, entry.format, rtl::Library::thesis(), area::Account::printed);
    built.push_back(area::price(design, entry.format, rtl::Library::thesis(), area::Account::built));
    ResultRow row{
        .labels = {fmt::format("{} {}", entry.design, to_string(entry.format))}, .ours = {}, .printed = {}};
    for (const Figure& figure : figures) {
      row.ours.emplace_back(figure.of(as_printed));
      row.printed.push_back(printed.rows()[i].number(figure.name));
    }
    table.rows.push_back(std::move(row));
  }
  table.findings = chapter_7_findings({printed, built});
  table.notes = {"rows: ours is counted as the thesis counts (hitpipe area --account printed)",
                 "statements: ours is all that is emitted (--account built), see docs/reproduction.md"};
  options.progress(1.0);
  return table;
}

}  // namespace hitpipe::thesis
