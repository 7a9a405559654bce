#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/commands/machines.hpp"
#include "cli/options/values.hpp"
#include "cli/text/help.hpp"
#include "cli/text/table.hpp"
#include "host/text.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/feature.hpp"
#include "sw_ref/scene/built_in.hpp"

namespace hitpipe::cli {

namespace {

bool has_hit(const rtl::Design& design) {
  return (design.kind.of_each & hls::meanings(hls::Meaning::hit)) != 0;
}

std::string designs_text(OutputFormat format) {
  std::vector<Row> rows;
  for (const rtl::Design& design : rtl::designs()) {
    rows.push_back({{"design", design.name},
                    {"bits", to_string(design.default_format)},
                    {"misses", !has_hit(design)      ? "-"
                               : design.conservative ? "never"
                                                     : "possible"},
                    {"what", design.summary}});
    if (format == OutputFormat::text) continue;  // lines of text are short
    rows.back()["formats"] = design.default_format.family().allowed();
  }
  return table_text(rows, format);
}

std::string scenes_text(OutputFormat format) {
  std::vector<Row> rows;
  for (const ref::BuiltInScene& scene : ref::built_in_scenes()) {
    Row& row = rows.emplace_back(Row{{"scene", scene.name}, {"triangles", scene.triangles}});
    if (format != OutputFormat::text)
      row.update({{"least", scene.least}, {"most", scene.most}, {"lights", scene.lights}});
    row["stands_for"] = scene.stands_for;
    row["what"] = scene.what;
  }
  return table_text(rows, format);
}

Row promise_row(const rtl::Promise& promise) {
  Row row{{"what", promise.what}};
  if (!promise.machine.empty()) row["machine"] = promise.machine;
  if (!promise.bits.empty()) row["bits"] = promise.bits;
  if (!promise.test.empty()) row["test"] = promise.test;
  for (const rtl::Promise::Damage& each : promise.damage)
    row["damage"].push_back({{"what", each.what}, {"change", each.change}});
  return row;
}

/// What a core may have.
std::string features_text(OutputFormat format) {
  std::vector<Row> rows;
  for (const rtl::Feature* const each : rtl::all_features()) {
    const std::string option(each->smallest);
    Row& row = rows.emplace_back(Row{{"feature", each->name}});
    row["option"] = format == OutputFormat::text ? option.substr(0, option.find(' ')) : option;
    row["what"] = each->summary;
    if (format != OutputFormat::json) continue;
    for (const rtl::Needs& other : each->needs) row["needs"].push_back(other.feature);
    for (const rtl::Excludes& other : each->excludes) row["excludes"].push_back(other.feature);
    for (const rtl::Failure& failure : each->failures)
      row["failures"].push_back({{"what", failure.what}, {"shows", failure.shows}});
    for (const rtl::Promise& promise : each->promises) row["promises"].push_back(promise_row(promise));
  }
  return table_text(rows, format);
}

std::string counted(const rtl::Library& library) {
  if (library.chip() == nullptr) return "area in mm2";
  return library.chip()->block ? fmt::format("LUT, FF, {}", library.chip()->block->name) : "LUT, FF";
}

/// A paragraph for each library, because their sources are long.
std::string described(const Row& row) {
  std::string text = row.at("library").get<std::string>() + "\n";
  for (const auto& [key, value] : row.items()) {
    if (key == "library" || value.get<std::string>().empty()) continue;
    const std::string head = fmt::format("  {:<8}", key);
    text += head + host::wrapped(value.get<std::string>(), head.size(), head.size());
  }
  return text;
}

std::string libraries_text(OutputFormat format) {
  std::vector<Row> rows;
  std::string text;
  for (const std::string& name : rtl::built_in_names()) {
    const rtl::Library library = rtl::library_called(name);
    rows.push_back({{"library", library.name()},
                    {"of", library.chip() != nullptr ? library.chip()->device : library.process()},
                    {"counts", counted(library)},
                    {"source", library.source()}});
    text += described(rows.back());
  }
  return format == OutputFormat::text ? text : table_text(rows, format);
}

using Listing = std::string (*)(OutputFormat);

struct ListCommand {
  Listing listing = nullptr;
  OutputFormat format = OutputFormat::text;
};

}  // namespace

CLI::App* add_list_command(CLI::App& program, int& /*exit_code*/) {
  CLI::App* const command =
      program.add_subcommand("list", "List designs, machines, features of the core, libraries or scenes");
  const auto options = std::make_shared<ListCommand>();
  add_choice_option<Listing>(*command, "what", options->listing,
                             {{"designs", designs_text},
                              {"machines", machines_text},
                              {"features", features_text},
                              {"libraries", libraries_text},
                              {"scenes", scenes_text}},
                             "What to list")
      ->required();
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe list designs", "hitpipe list scenes --format json"});
  command->callback([options] { fmt::print("{}", options->listing(options->format)); });
  return command;
}

}  // namespace hitpipe::cli
