#include "sim/implement/target.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "host/process.hpp"
#include "host/text.hpp"
#include "sim/implement/workbench.hpp"

namespace hitpipe::sim {

namespace {

using OrderedJson = nlohmann::ordered_json;

/// An entry of the file, and the words that lead to it in a message.
struct Entry {
  const OrderedJson& json;
  std::string path;

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", path, what));
  }
  void check_keys(const std::vector<std::string>& allowed) const {
    if (!json.is_object()) fail("is not an object");
    for (const auto& [key, value] : json.items())
      if (std::find(allowed.begin(), allowed.end(), key) == allowed.end())
        fail(fmt::format("{}: unknown; allowed are {}", host::shortened(key), fmt::join(allowed, ", ")));
  }
  [[nodiscard]] bool has(const char* key) const { return json.contains(key); }
  [[nodiscard]] Entry at(const std::string& key) const {
    if (!json.contains(key)) fail(fmt::format("{} is missing", key));
    return {json[key], fmt::format("{}: {}", path, key)};
  }
  /// An entry under a key of the user's own.
  [[nodiscard]] Entry inside(const std::string& key, const OrderedJson& value) const {
    return {value, fmt::format("{}: {}", path, host::shortened(key))};
  }
  [[nodiscard]] std::string text() const {
    if (!json.is_string()) fail("is not a text");
    return json.get<std::string>();
  }
  [[nodiscard]] std::string text(const char* key) const { return has(key) ? at(key).text() : ""; }
  [[nodiscard]] int count() const {
    if (!json.is_number_unsigned() || json > 1'000'000'000) fail("is not a whole number from 0 to 10^9");
    return json.get<int>();
  }
  [[nodiscard]] std::vector<std::string> texts() const {
    if (!json.is_array()) fail("is not a list of texts");
    std::vector<std::string> all;
    for (const OrderedJson& each : json) all.push_back(Entry{each, path}.text());
    return all;
  }
  /// A text, or a list of its lines.
  [[nodiscard]] std::string lines() const {
    if (!json.is_array()) return text();
    std::string all;
    for (const std::string& line : texts()) all += line + "\n";
    return all;
  }
  [[nodiscard]] std::vector<std::string> texts(const char* key) const {
    return has(key) ? at(key).texts() : std::vector<std::string>{};
  }
};

Resource resource_of(const std::string& name, const Entry& entry) {
  entry.check_keys({"cells", "packed", "available"});
  Resource resource{name, {}, entry.text("packed"), {}};
  if (entry.has("available")) resource.available = entry.at("available").count();
  if (entry.has("cells") == entry.has("packed")) entry.fail("has either cells or packed");
  if (!entry.has("cells")) return resource;
  const Entry cells = entry.at("cells");
  if (!cells.json.is_object()) cells.fail("is not an object");
  for (const auto& [cell, weight] : cells.json.items())
    resource.cells.emplace_back(cell, cells.inside(cell, weight).count());
  return resource;
}

std::vector<Resource> resources_of(const Entry& entry) {
  entry.check_keys({std::begin(resource_names), std::end(resource_names)});
  std::vector<Resource> all;
  for (const std::string_view name : resource_names)
    if (entry.json.contains(name)) all.push_back(resource_of(std::string(name), entry.at(std::string(name))));
  return all;
}

Models models_of(const Entry& entry) {
  entry.check_keys({"files", "defines", "verilator_options"});
  return {entry.at("files").texts(), entry.texts("defines"), entry.texts("verilator_options")};
}

TargetProgram program_in(const Entry& entry) {
  return {entry.at("program").text(), entry.text("package")};
}

/// An option whose word is the ending of a file.
std::string file_option_in(const Entry& entry) {
  std::string option = entry.at("option").text();
  if (!option.starts_with("--")) entry.at("option").fail("does not begin with --");
  return option;
}

BoardFlow board_flow_of(const Entry& entry) {
  entry.check_keys({"pins", "bitstream"});
  const Entry pins = entry.at("pins");
  pins.check_keys({"option", "line"});
  const Entry bitstream = entry.at("bitstream");
  bitstream.check_keys({"option", "program", "package", "ending"});
  return {file_option_in(pins), pins.at("line").text(), file_option_in(bitstream), program_in(bitstream),
          bitstream.at("ending").text()};
}

Placer placer_of(const Entry& entry) {
  entry.check_keys({"program", "package", "options", "board"});
  Placer placer{program_in(entry), entry.at("options").texts(), {}};
  if (entry.has("board")) placer.board = board_flow_of(entry.at("board"));
  return placer;
}

/// A file named after an option: ".pcf" of "--pcf".
std::string named_by(const std::string& stem, const std::string& option) {
  return fmt::format("{}.{}", stem, std::string_view(option).substr(2));
}

}  // namespace

std::string TargetProgram::variable() const {
  std::string upper = name;
  for (char& each : upper)
    each = std::isalnum(static_cast<unsigned char>(each)) ? static_cast<char>(std::toupper(each)) : '_';
  return upper;
}

std::string BoardFlow::pins_file(const std::string& top) const {
  return named_by(top, pins_option);
}

std::string BoardFlow::placed_file(const std::string& top, int seed) const {
  return named_by(fmt::format("{}_{}", top, seed), placed_option);
}

std::string BoardFlow::pin_constraints(const rtl::Board& board) const {
  std::string text = fmt::format("# {}: {}.\n# Pins from {}.\n# Generated by hitpipe; do not edit.\n",
                                 board.name, board.description, board.source);
  for (const rtl::BoardPin& pin : board.pins)
    text += filled_in(pin_line, {{"port", pin.port}, {"pin", pin.pin}}) + "\n";
  return text;
}

Target Target::from_json(std::string_view text, const std::string& origin) {
  const OrderedJson json = OrderedJson::parse(text, nullptr, false);
  if (json.is_discarded()) throw std::runtime_error(fmt::format("{}: is not JSON", origin));
  const Entry file{json, origin};
  file.check_keys({"name", "chip", "library", "synthesis", "files", "resources", "liberty", "package",
                   "place", "not_placed", "models"});
  Target target{.name = file.at("name").text(),
                .chip = file.at("chip").text(),
                .library = file.at("library").text(),
                .synthesis = file.at("synthesis").texts(),
                .files = {},
                .resources = resources_of(file.at("resources")),
                .liberty = file.text("liberty"),
                .package = file.text("package"),
                .placer = {},
                .not_placed = file.text("not_placed"),
                .models = {}};
  if (file.has("files")) {
    const Entry files = file.at("files");
    if (!files.json.is_object()) files.fail("is not an object");
    for (const auto& [name, contents] : files.json.items())
      target.files.emplace_back(name, files.inside(name, contents).lines());
  }
  if (file.has("place")) target.placer = placer_of(file.at("place"));
  if (file.has("models")) target.models = models_of(file.at("models"));
  if (!file.has("place") && !file.has("not_placed")) file.fail("has neither place nor not_placed");
  // The name becomes a folder.
  if (target.name.empty() || target.name.find_first_of("/ .") != std::string::npos)
    file.at("name").fail("is empty or has a slash, a blank or a point");
  return target;
}

std::vector<std::string> target_names() {
  std::vector<std::string> names;
  for (const BuiltInTarget& target : built_in_targets()) names.emplace_back(target.name);
  return names;
}

Target target_called(const std::string& name_or_file) {
  if (name_or_file.ends_with(".json")) return Target::from_json(host::read_file(name_or_file), name_or_file);
  const auto targets = built_in_targets();
  const auto found = std::find_if(targets.begin(), targets.end(),
                                  [&](const BuiltInTarget& target) { return target.name == name_or_file; });
  if (found == targets.end())
    throw std::runtime_error(
        fmt::format("target {}: unknown; there are {}, and any file whose name ends in .json",
                    host::shortened(name_or_file), fmt::join(target_names(), ", ")));
  return Target::from_json(found->json, fmt::format("{}.json", found->name));
}

namespace {

/// A program that the user names must be there.
std::optional<Tool> find_placer(const Placer& placer, bool may_be_missing) {
  const auto& [name, package] = placer.program;
  const std::string variable = placer.program.variable();
  const bool named = !host::environment(variable.c_str(), "").empty();
  if (may_be_missing && !named && Tool{{name}, ""}.run({"--version"}).not_found()) return std::nullopt;
  return find_tool(variable.c_str(), name, package);
}

}  // namespace

ChipTools find_chip_tools(const Target& target) {
  ChipTools tools{.yosys = find_tool("YOSYS", "yosys", "yosys", "-V"), .placer = {}, .sta = {}};
  if (target.placer) tools.placer = find_placer(*target.placer, !target.not_placed.empty());
  if (!target.liberty.empty()) {
    tools.sta = find_tool("STA", "sta", "opensta", "-version");
    if (!std::filesystem::exists(target.liberty))
      throw std::runtime_error(
          fmt::format("{}: is not there; install the package {}", target.liberty, target.package));
  }
  return tools;
}

}  // namespace hitpipe::sim
