#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "host/text.hpp"
#include "sim/operands/operands.hpp"
#include "sim/operands/own_operands.hpp"

namespace hitpipe::cli {

namespace {

using sim::TestForm;

struct OperandsCommand {
  DesignChoice choice;
  sim::OperandFiles files;
  std::string own;  ///< a file of operands, in place of rays and boxes
  std::optional<ref::Bounds> bounds;
  std::string out;
  std::optional<TestForm> form;
  bool with_input = false;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  OutputFormat format = OutputFormat::text;
};

ref::Bounds parse_bounds(const std::string& text) {
  std::array<double, 6> numbers{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t comma = rest.find(',');
    const std::optional<double> number = sim::read_double(rest.substr(0, comma));
    const bool last = i + 1 == numbers.size();
    if (!number || last != (comma == std::string_view::npos))
      throw CLI::ValidationError(
          "--bounds",
          fmt::format("{} is not min_x,min_y,min_z,max_x,max_y,max_z; give six numbers, for example "
                      "-10,-10,0,10,10,5",
                      host::shortened(text)));
    numbers[i] = *number;
    if (!last) rest.remove_prefix(comma + 1);
  }
  return {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

TestForm form_of(const OperandsCommand& command) {
  if (command.form) return *command.form;
  const std::string extension = std::filesystem::path(command.out).extension().string();
  if (command.out == "-" || extension == ".csv") return TestForm::csv;
  if (extension == ".json" || extension == ".jsonl") return TestForm::json;
  if (extension == ".hex") return TestForm::hex;
  throw std::runtime_error(fmt::format(
      "--out {}: unknown extension \"{}\"; allowed are .csv, .json, .jsonl and .hex, or give --as",
      command.out, host::shortened(extension)));
}

/// The exit code for these counts.
int verdict(const OperandsCommand& command, const sim::OperandCounts& counts) {
  if (!counts.false_miss || !command.choice.design().conservative) return 0;
  fmt::print(stderr, "hitpipe: {} false misses; the first: line {} of the rays, line {} of the boxes\n",
             counts.false_misses, counts.false_miss->ray_line, counts.false_miss->box_line);
  return 1;
}

/// Of rays and boxes.
sim::OperandCounts judge_operands(const OperandsCommand& command, TestForm form,
                                  const std::function<void(std::string_view)>& write,
                                  const std::function<void(double)>& progress) {
  const rtl::Design& design = command.choice.design();
  const Format format = command.choice.format();
  const sim::Placement placement = command.bounds ? sim::Placement(*command.bounds) : sim::Placement();
  return sim::write_operands(
      [&] { return sim::make_box_test(design, format); },
      {design, format, placement, form, command.with_input},
      {.files = command.files, .placement = placement, .threads = command.threads, .progress = progress},
      write);
}

int make_operands(const OperandsCommand& command, const CLI::App& parsed) {
  if (command.own.empty() && (command.files.rays.empty() || command.files.boxes.empty()))
    throw std::runtime_error("operands: give --rays and --boxes, or --operands");
  if (command.files.rays == "-" && command.files.boxes == "-")
    throw std::runtime_error("--rays and --boxes are both -; only one can be standard input");
  const rtl::Design& design = command.choice.design();
  const Format format = command.choice.format();
  const TestForm form = form_of(command);
  const bool to_file = command.out != "-";
  std::optional<host::PendingFile> file;
  if (to_file) file.emplace(command.out);
  const auto write = [&](std::string_view text) {
    if (to_file) {
      file->write(text);
    } else if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) {
      throw std::runtime_error("standard output: cannot be written");
    }
  };
  std::optional<Progress> progress(std::in_place, "testing");
  const auto show = [&](double share) { progress->show(share); };
  Row row{{"design", design.name}, {"bits", to_string(format)}};
  if (command.bounds) {
    const sim::Placement placement(*command.bounds);
    const ref::Normalisation& cube = placement.transform();
    row.update(
        {{"offset", Row::array({cube.offset.x, cube.offset.y, cube.offset.z})}, {"scale", cube.scale}});
  }
  Row notes = row;
  sim::OperandCounts counts;
  if (command.own.empty()) {
    counts = judge_operands(command, form, write, show);
    row.update({{"tests", counts.tests},
                {"hits", counts.hits},
                {"exact_hits", counts.exact_hits},
                {"false_hits", counts.false_hits},
                {"false_misses", counts.false_misses}});
  } else {
    const sim::RunCounts run = sim::run_operands(design, format, command.own, form, write, show);
    row.update({{"tests", run.tests}, {"hits", run.hits}});
  }
  if (to_file) {
    file->close();
    file->rename();
    if (form == TestForm::csv) {
      notes.update(notes_of(parsed));
      std::string header;
      std::getline(std::ifstream(command.out), header);
      host::write_file(metadata_file(command.out), csv_metadata({csv_table(command.out, header)}, notes));
    }
  }
  progress.reset();

  if (to_file) row["operands"] = command.out;
  fmt::print(to_file ? stdout : stderr, "{}", record_text(row, command.format));
  return verdict(command, counts);
}

}  // namespace

CLI::App* add_operands_command(CLI::App& program, int& exit_code) {
  CLI::App* const command =
      program.add_subcommand("operands", "Operands of your rays and boxes, with HIT and the exact answer");
  const auto options = std::make_shared<OperandsCommand>();
  add_design_options(*command, options->choice);
  const auto input = [&](const char* name, std::string& file, const char* what) {
    return as_input(command->add_option(name, file, what))->type_name("FILE");
  };
  input("--rays", options->files.rays,
        "CSV file with the columns ox,oy,oz,dx,dy,dz and, if you like, length; - is standard input");
  input("--boxes", options->files.boxes,
        "CSV file with the columns min_x,min_y,min_z,max_x,max_y,max_z; for a design that tests two "
        "boxes at a time min_x_0,...,max_z_0,min_x_1,...,max_z_1");
  CLI::Option* const own = input("--operands", options->own,
                                 "In place of rays and boxes: CSV file of operands of your own, with a "
                                 "column for each. The results of the "
                                 "unit are written behind them");
  as_output(command->add_option("--out", options->out, "File to write; - is standard output"))->required();
  add_choice_option<std::optional<TestForm>>(
      *command, "--as", options->form,
      {{"csv", TestForm::csv}, {"json", TestForm::json}, {"hex", TestForm::hex}},
      "What to write: csv; json, one object a line; or hex, the vectors of the emitted testbench. Default: "
      "as the file's extension says, csv on standard output");
  command->add_flag("--all-pairs", options->files.all_pairs,
                    "Test every ray with every box, in place of line i of one file with line i of the other");
  command
      ->add_option_function<std::string>(
          "--bounds", [options](const std::string& text) { options->bounds = parse_bounds(text); },
          "What your boxes lie in, in your units. It is moved into the cube [-1, 1] by one scale and one "
          "offset. Without it all numbers must be in the cube")
      ->type_name("X,Y,Z,X,Y,Z");
  command->add_flag("--with-input", options->with_input,
                    "Also write ray and box as they were tested: in the cube, in binary32");
  for (const char* const other : {"--rays", "--boxes", "--all-pairs", "--bounds", "--with-input"})
    exclude(own, command->get_option(other), "operands are what the unit takes, without a ray and a box");
  add_count_option(*command, "--threads", options->threads, {1, 1024},
                   "Number of threads; results do not depend on it")
      ->capture_default_str();
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe operands int_slabs --rays rays.csv --boxes boxes.csv --out tests.csv",
                          "hitpipe operands fp_slabs --operands tests.csv --out results.csv"});
  command->callback([options, command, &exit_code] { exit_code = make_operands(*options, *command); });
  return command;
}

}  // namespace hitpipe::cli
