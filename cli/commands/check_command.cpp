#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/commands/categories.hpp"
#include "cli/commands/stiff_check.hpp"
#include "cli/commands/triangle_check.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "hls/num/bits.hpp"
#include "host/text.hpp"
#include "sim/check/check.hpp"
#include "sim/software.hpp"
#include "sim/unit/drive.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/box_referee.hpp"

namespace hitpipe::cli {

namespace {

using ref::adversary::Case;
using ref::adversary::Category;

constexpr std::uint64_t most_stiff = 1'000'000'000;

struct CheckCommand {
  DesignChoice choice;
  std::vector<std::string> categories;
  std::uint64_t tests = 1'000'000;
  std::uint64_t seed = 1;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool rtl = false;
  int interval = 1;
  bool stiff = false;
  std::optional<std::string> replay;
  OutputFormat format = OutputFormat::text;
};

/// The adversary's categories and those made for the design.
std::vector<Category> chosen_categories(const rtl::Design& design, const std::vector<std::string>& names) {
  const auto general = ref::adversary::categories();
  std::vector<Category> all(general.begin(), general.end());
  const std::vector<Category>& own = sim::software_of(design).categories;
  all.insert(all.end(), own.begin(), own.end());
  return chosen_of(all, names);
}

/// In percent, with its 95 % interval, as columns of CSV and JSON.
void add_share(Row& row, const std::string& name, const ref::GroupedRatio& share) {
  const ref::Interval interval = share.share_interval();
  row[name] = 100 * share.ratio();
  row[name + "_low"] = 100 * interval.low;
  row[name + "_high"] = 100 * interval.high;
}

Row row_of(const CheckCommand& command, const sim::CategoryResult& r, const sim::CategoryResult* comparison) {
  Row row;
  if (command.format != OutputFormat::text)
    row.update({{"design", command.choice.name},
                {"bits", rtl::to_string(command.choice.format())},
                {"seed", command.seed}});
  row.update({{"category", r.category},
              {"tests", r.tests},
              {"exact_hits", r.hits},
              {"false_misses", r.false_misses},
              {"false_hits", r.false_hits}});
  if (command.format != OutputFormat::text) {
    add_share(row, "false_miss_pct", r.false_miss_share);
    add_share(row, "false_hit_pct", r.false_hit_share);
  }
  if (comparison != nullptr) row["ize_misses"] = comparison->false_misses;
  if (comparison != nullptr && command.format != OutputFormat::text) {
    add_share(row, "ize_false_miss_pct", comparison->false_miss_share);
    row["ize_false_hits"] = comparison->false_hits;
  }
  if (command.rtl) row["rtl_mismatches"] = r.rtl_mismatches;
  return row;
}

/// One line: a share of all tests, in percent.
std::string share_text(const std::string& what, const std::string& of, const ref::GroupedRatio& share) {
  const ref::Interval interval = share.share_interval();
  return fmt::format("{}: {:.4g} % of the boxes {}; 95 %: {:.4g} to {:.4g}; {} rays\n", what,
                     100 * share.ratio(), of, 100 * interval.low, 100 * interval.high, share.groups());
}

std::string replay_command(const CheckCommand& command, const Case& c) {
  const std::string bits = command.choice.design().bits_option(command.choice.format());
  return fmt::format("hitpipe check {}{} --replay \"{}\"", command.choice.name, bits,
                     ref::adversary::to_text(c));
}

/// The exit code for these counts.
int verdict(const rtl::Design& design, std::uint64_t false_misses, std::uint64_t rtl_mismatches) {
  return (false_misses > 0 && design.conservative) || rtl_mismatches > 0 ? 1 : 0;
}

int judge(const CheckCommand& command) {
  const rtl::Design& design = command.choice.design();
  const rtl::Format format = command.choice.format();
  const std::vector<Category> categories = chosen_categories(design, command.categories);
  std::optional<Progress> progress;
  std::optional<sim::VerilatedDesign> verilated;
  if (command.rtl) {
    progress.emplace("compiling the Verilog");
    verilated.emplace(
        sim::make_unit(design, format, rtl::Library::thesis(), rtl::FlowControl::stall, command.interval));
  }
  progress.emplace("judging");
  const sim::MakeBoxTest make = [&] { return sim::make_box_test(design, format); };
  const sim::MakeBoxTest& make_comparison = sim::software_of(design).comparison_test;
  const double runs = make_comparison ? 2.0 : 1.0;
  double finished = 0;
  sim::CheckOptions options{.categories = categories,
                            .tests = command.tests,
                            .seed = command.seed,
                            .threads = command.threads,
                            .rtl = verilated ? &*verilated : nullptr,
                            .progress = [&](double share) { progress->show((finished + share) / runs); }};
  const std::vector<sim::CategoryResult> results = sim::check(make, options);
  std::vector<sim::CategoryResult> comparison;
  if (make_comparison) {
    finished = 1;
    options.rtl = nullptr;
    comparison = sim::check(make_comparison, options);
  }
  progress.reset();

  std::vector<Row> rows;
  sim::CategoryResult sum;
  sim::CategoryResult comparison_sum;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const sim::CategoryResult* const other = comparison.empty() ? nullptr : &comparison[i];
    rows.push_back(row_of(command, results[i], other));
    sum += results[i];
    if (other != nullptr) comparison_sum += *other;
  }
  sum.category = "all";
  // A table of categories has no row of another kind: whoever adds them up would count it twice.
  if (command.format != OutputFormat::csv)
    rows.push_back(row_of(command, sum, comparison.empty() ? nullptr : &comparison_sum));
  if (command.format == OutputFormat::text) {
    fmt::print("{} {}, seed {}\n", design.name, rtl::to_string(format), command.seed);
  }
  fmt::print("{}", table_text(rows, command.format));
  if (command.format == OutputFormat::text) {
    fmt::print("{}{}", share_text("false misses", "met", sum.false_miss_share),
               share_text("false hits", "missed", sum.false_hit_share));
  }
  if (sum.false_miss) {
    const std::unique_ptr<sim::BoxTest> test = make();
    const Case simple =
        ref::adversary::shrink(*sum.false_miss, [&](const Case& c) { return sim::is_false_miss(*test, c); });
    fmt::print(stderr, "hitpipe: {} false misses; the first, simplified: {}\n", sum.false_misses,
               replay_command(command, simple));
  }
  if (sum.rtl_mismatches > 0) {
    fmt::print(stderr, "hitpipe: {} answers of the Verilog differ from the C++\n", sum.rtl_mismatches);
  }
  return verdict(design, sum.false_misses, sum.rtl_mismatches);
}

int replay(const CheckCommand& command) {
  const rtl::Design& design = command.choice.design();
  const rtl::Format format = command.choice.format();
  const Case c = ref::adversary::parse_case(*command.replay);
  const auto test = sim::make_box_test(design, format);
  test->start(c.ray);
  const bool hit = test->hit(c.box);
  const bool meets = test->meets(c.ray, c.box);
  const auto word = [](bool is_hit) { return is_hit ? "HIT" : "MISS"; };
  Row row{
      {"design", design.name}, {"bits", rtl::to_string(format)}, {"exact", word(meets)}, {"unit", word(hit)}};
  bool rtl_differs = false;
  if (command.rtl) {
    const sim::VerilatedDesign verilated(
        sim::make_unit(design, format, rtl::Library::thesis(), rtl::FlowControl::stall, command.interval));
    sim::Model model(verilated);
    sim::TestBatch one;
    one.add(test->operands(), test->results());
    const sim::DriveReport report = sim::drive(model, one);
    row["rtl"] = report.received > 0 ? word(report.hits > 0) : "no answer";
    rtl_differs = report.faults() > 0;
  }
  const std::vector<rtl::Port> ports = design.ports(format);
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const auto bits = static_cast<std::uint64_t>(test->operands()[i]) & hls::low_mask(ports[i].width);
    row[ports[i].name] = fmt::format("0x{:0{}x}", bits, (ports[i].width + 3) / 4);
  }
  fmt::print("{}", record_text(row, command.format));
  return verdict(design, meets && !hit ? 1 : 0, rtl_differs ? 1 : 0);
}

}  // namespace

CLI::App* add_check_command(CLI::App& program, int& exit_code) {
  CLI::App* const command =
      program.add_subcommand("check", "Judge a design exactly, on rays and boxes made to break it");
  const auto options = std::make_shared<CheckCommand>();
  const auto stiff = std::make_shared<StiffCheck>();
  add_designs_option(*command, stiff->units, "with --stiff those that never miss; otherwise name one");
  add_bits_option(
      *command, stiff->units,
      "the design's own; with --stiff 24/24, 20/24, 16/16 and 12/12 for n/t designs, and at most 8");
  add_list_option(*command, "--category", options->categories,
                  "Draw only from these categories; an unknown name lists all", "NAME");
  const CLI::Option* const tests = add_large_count_option(
      *command, "--tests", options->tests, 1, 10'000'000'000'000,
      "Number of tests, divided among the categories (1 to 10^13); with --stiff of boxes "
      "for each ratio (1 to 10^9, default 60000)");
  add_seed_option(*command, options->seed);
  add_count_option(*command, "--threads", options->threads, {1, 1024},
                   "Number of threads; results do not depend on it")
      ->capture_default_str();
  CLI::Option* const with_rtl =
      command->add_flag("--rtl", options->rtl, "The Verilog answers every test too");
  add_interval_option(*command, options->interval)->needs(with_rtl);
  command->add_option("--replay", options->replay, "Judge the one case that a failed check printed")
      ->type_name("CASE");
  CLI::Option* const is_stiff = command->add_flag(
      "--stiff", options->stiff,
      "Count false hits as the components of a ray's direction grow apart, of several designs and formats");
  as_input(command->add_option(
               "--scene", stiff->scene,
               "With --stiff: also count the box tests of stiff rays through a built-in scene or a "
               "mesh file"))
      ->needs(is_stiff)
      ->type_name("NAME|FILE");
  add_hierarchy_options(*command, stiff->hierarchy);
  for (const std::string_view name : hierarchy_option_names())
    command->get_option(std::string(name))->needs(is_stiff);
  add_large_count_option(*command, "--rays", stiff->rays, 1, 1'000'000'000,
                         "With --stiff: rays through the scene for each ratio (1 to 10^9)")
      ->needs(is_stiff);
  add_folder_option(*command, stiff->out,
                    "With --stiff: folder for the rows as CSV and for the plots as SVG, PDF and gnuplot")
      ->needs(is_stiff);
  add_plot_width_option(*command, stiff->pictures, "With --stiff: ")->needs(is_stiff)->needs("--out");
  for (const char* const other : {"--category", "--rtl", "--replay"})
    exclude(is_stiff, command->get_option(other), "stiff rays have cases of their own, and the C++ answers");
  add_format_option(*command, options->format);
  command->callback([options, stiff, tests, command, &exit_code] {
    if (options->stiff) {
      if (tests->count() > 0) stiff->tests = options->tests;
      if (stiff->tests > most_stiff)
        throw std::runtime_error(fmt::format("--tests: with --stiff allowed is 1 to {}", most_stiff));
      stiff->seed = options->seed;
      stiff->threads = options->threads;
      stiff->hierarchy.build.threads = options->threads;
      stiff->format = options->format;
      exit_code = check_stiff_rays(*stiff, notes_of(*command));
      return;
    }
    options->choice = stiff->units.only("check");
    const rtl::Design& design = options->choice.design();
    if (design.kind == hls::triangle_kind) {
      if (options->replay)
        throw std::runtime_error(fmt::format(
            "--replay: design {} tests triangles; only cases of boxes are replayed", design.name));
      exit_code = check_triangle_unit({options->choice, options->categories, options->tests, options->seed,
                                       options->threads, options->rtl, options->interval, options->format});
      return;
    }
    exit_code = options->replay ? replay(*options) : judge(*options);
  });
  return command;
}

}  // namespace hitpipe::cli
