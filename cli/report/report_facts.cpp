#include "cli/report/report_facts.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>

#include "cli/report/occupancy_plot.hpp"
#include "cli/report/plot.hpp"
#include "cli/report/sweep_plot.hpp"
#include "host/machine.hpp"
#include "host/process.hpp"
#include "rtl_gen/emit/files.hpp"
#include "sim/check/check.hpp"
#include "sim/software.hpp"
#include "sim/sweep/sweep.hpp"
#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::cli {

namespace {

/// The first line that a program prints to either stream when it is called with `option`.
std::string version_of(std::vector<std::string> program, const char* option = "--version") {
  program.emplace_back(option);
  const host::Outcome said = host::run(program, {.time_limit = host::answering_time});
  const std::string text = said.out + said.err;
  const std::string line = text.substr(0, text.find('\n'));
  return !said.succeeded() || line.empty() ? "not found" : line;
}

}  // namespace

std::vector<area::Price> report_prices(std::span<const ReportUnit> units, std::span<const sim::SweepRow> rows,
                                       const rtl::Library& library) {
  std::vector<area::Price> prices;
  const auto add = [&](const rtl::Design& design, const rtl::Format& format, int interval) {
    const bool there = std::any_of(prices.begin(), prices.end(), [&](const area::Price& p) {
      return p.design == design.name && p.format == format && p.interval == interval;
    });
    if (there || !sim::why_not_priced(design, format, library).empty()) return;
    prices.push_back(
        area::price(design, format, library, area::Account::built, rtl::FlowControl::stall, interval));
  };
  for (const ReportUnit& unit : units) add(*unit.design, unit.format, 1);
  for (const NamedRow& best : best_rows(rows)) {
    const sim::SweepRow& row = rows[best.row];
    const rtl::Design& design = rtl::find_design(row.design);
    add(design, design.parse_format(row.bits), row.interval);
  }
  return prices;
}

std::vector<std::string> price_commands(std::span<const area::Price> prices,
                                        const std::string& library_option) {
  const auto& six = area::table_7_2();
  std::vector<std::string> commands;
  const std::string of_the_six = fmt::format("hitpipe area{} --format csv", library_option);
  for (const area::Price& p : prices) {
    const bool is_of_six = std::any_of(six.begin(), six.end(), [&](const area::Entry& entry) {
      return entry.design == p.design && entry.format == p.format && p.interval == 1;
    });
    if (is_of_six) {
      if (commands.empty() || commands.front() != of_the_six) commands.insert(commands.begin(), of_the_six);
      continue;
    }
    commands.push_back(fmt::format("hitpipe area {}{}{}{} --format csv", p.design,
                                   rtl::find_design(p.design).bits_option(p.format), library_option,
                                   p.interval == 1 ? "" : fmt::format(" --ii {}", p.interval)));
  }
  return commands;
}

std::vector<Stability> measure_stability(std::span<const ReportUnit> units, const StabilityOptions& options) {
  const auto categories = ref::adversary::categories();
  std::vector<Stability> measured;
  for (const ReportUnit& unit : units) {
    const rtl::Design& design = *unit.design;
    const std::string bits = rtl::to_string(unit.format);
    Stability sum{
        .design = std::string(design.name), .bits = bits, .command = {}, .categories = {}, .all = {}};
    for (const sim::CategoryResult& r : sim::check([&] { return sim::make_box_test(design, unit.format); },
                                                   {.categories = {categories.begin(), categories.end()},
                                                   .tests = options.tests,
                                                   .seed = options.seed,
                                                   .threads = options.threads})) {
      sum.categories.push_back(r);
      sum.all += r;
    }
    sum.command = fmt::format("hitpipe check {}{} --tests {} --seed {}", design.name,
                              design.bits_option(unit.format), options.tests, options.seed);
    measured.push_back(std::move(sum));
  }
  return measured;
}

std::vector<MeasuredDesign> measure_stiffness(std::span<const rtl::Design* const> designs,
                                              const StabilityOptions& options) {
  std::vector<MeasuredDesign> measured;
  for (const rtl::Design* const design : designs) {
    if (!design->conservative) continue;
    MeasuredDesign made{design, {}};
    for (const rtl::Format& format : sim::stiffness_formats(*design)) {
      std::vector<sim::StiffBoxes> boxes =
          sim::stiff_boxes([&] { return sim::make_box_test(*design, format); },
                           {.tests = options.tests, .seed = options.seed, .threads = options.threads});
      std::vector<sim::StiffBoxes> all = sim::over_all_kinds(boxes);
      made.formats.push_back({format, std::move(boxes), std::move(all), {}});
    }
    measured.push_back(std::move(made));
  }
  return measured;
}

std::vector<Diagrammed> draw_diagrams(std::span<const sim::SweepRow> rows, const PictureForm& form) {
  const std::string& scene = rows.front().scene;
  const int rays = usual_rays_in_flight(rows);
  std::vector<sim::SweepRow> usual;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(usual),
               [&](const sim::SweepRow& row) { return row.rays_in_flight == rays; });
  std::vector<sim::SweepRow> soonest;  // an error does not depend on the interval
  const int interval = std::ranges::min_element(usual, {}, &sim::SweepRow::interval)->interval;
  std::copy_if(usual.begin(), usual.end(), std::back_inserter(soonest),
               [&](const sim::SweepRow& row) { return row.interval == interval; });
  std::vector<Diagrammed> drawn;
  for (const Diagram& diagram : diagrams(rows.front().on_chip())) {
    // A design without a tracer of its own has no measured time.
    std::vector<sim::SweepRow> known;
    std::ranges::copy_if(soonest, std::back_inserter(known), [&](const sim::SweepRow& row) {
      return !sim::sweep_column(diagram.cost).cell(row).empty();
    });
    if (known.empty()) continue;
    drawn.push_back({draw_picture("report", diagram_picture(scene, known, diagram, form), form),
                     fmt::format("{} rays in flight. Columns {} and {} of rows.csv.", rays, diagram.cost,
                                 diagram.error)});
  }
  if (const std::optional<Picture> picture = rate_picture(scene, usual, form))
    drawn.push_back(
        {draw_picture("report", *picture, form),
         "A number at a mark is the interval between two tests in cycles. Columns box_time_ns and "
         "area_mm2 of rows.csv, on a chip luts."});
  if (const std::optional<Picture> picture = occupancy_picture(scene, rows, form))
    drawn.push_back({draw_picture("report", *picture, form),
                     "Column occupancy_pct of rows.csv: the share of cycles in which a test begins. A "
                     "pipeline is full when as many rays are "
                     "in flight as it has stages, and some more to bridge the ends of rays."});
  return drawn;
}

Diagrammed draw_world(std::span<const Row> rows, const PictureForm& form) {
  struct Line {
    std::string title;
    std::vector<double> percent;
  };
  std::array<Line, 2> lines{{{"rays with another triangle", {}}, {"pixels that differ", {}}}};
  std::vector<double> all;
  for (const Row& row : rows) {
    lines[0].percent.push_back(row.at("different_rays_pct").get<double>());
    lines[1].percent.push_back(row.at("different_pixels_pct").get<double>());
    for (const Line& line : lines) all.push_back(line.percent.back());
  }
  const LogAxis y(all);
  std::string names, data;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    names +=
        fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_string(rows[i].at("bits").get<std::string>()), i);
    data += fmt::format("{} {} {}\n", i, y.shown(lines[0].percent[i]), y.shown(lines[1].percent[i]));
  }
  const PlotFrame frame =
      plot_frame(form, "bits of the world", "%", std::vector{lines[0].title, lines[1].title});
  std::string plots;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const DesignStyle style = design_style(i);
    plots += fmt::format("{} $rows using 1:{} with linespoints lc rgb '{}' pt {} ps {:g} lw 1.5 title {}",
                         i == 0 ? "plot" : ",", i + 2, style.colour, style.shape, style.size,
                         gnuplot_string(lines[i].title));
  }
  return {draw_picture(
              "report",
              {"integer_world",
               "Rays with another triangle and pixels that differ, by the bits of the integer world",
               frame.picture_height,
               frame.settings +
                   fmt::format("set logscale y\nset yrange [{}:{}]\nset ytics ({})\nset xrange [-0.3:{}]\n"
                               "set xtics ({})\n",
                               y.least(), y.most(), y.tics_upward(frame.size.y),
                               static_cast<double>(rows.size()) - 0.7, names) +
                   data_block("rows", data),
               plots + "\n"},
              form),
          "Above the pictures of the float world. A pixel differs if a channel does by more than 1/256."};
}

std::vector<Schematic> draw_schematics(std::span<const rtl::Design* const> designs) {
  std::vector<Schematic> schematics;
  const rtl::Library& library = rtl::Library::thesis();
  for (const rtl::Design* const each : designs) {
    const rtl::Design& design = *each;
    const rtl::Format format = design.default_format;
    const rtl::Unit unit = rtl::make_unit(design, format, library);
    std::optional<std::vector<rtl::File>> drawings = rtl::draw(rtl::emit(unit).schematics);
    if (!drawings) return {};
    Schematic schematic{
        fmt::format("{} {}: {} stages", design.name, rtl::to_string(format), unit.pipeline->schedule.stages),
        {}};
    for (rtl::File& file : *drawings) {
      std::string words = file.name.substr(0, file.name.rfind('.'));
      std::replace(words.begin(), words.end(), '_', ' ');
      schematic.drawings.push_back({std::move(file.contents), "Schematic of " + words, words});
    }
    schematics.push_back(std::move(schematic));
  }
  return schematics;
}

std::vector<std::pair<std::string, std::string>> versions() {
  return {{"Measured on", fmt::format("{}, {}", host::processor(), host::today())},
          {"Built by", host::compiler()},
          {"Verilator", version_of(host::program_of("VERILATOR", "verilator"))},
          {"Models compiled by", version_of(host::program_of("CXX", "c++"))},
          {"gnuplot", version_of({"gnuplot"})},
          {"Graphviz", version_of({"dot"}, "-V")}};
}

}  // namespace hitpipe::cli
