// Reads a component library's file. What is wrong is said in one line: where, the entry, what is allowed.
#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "host/text.hpp"
#include "rtl_gen/component/library.hpp"

namespace hitpipe::rtl {

namespace {

using FileJson = nlohmann::json;

struct Limits {
  std::int64_t least, most;
};
// Wide enough for any process. Sums and products of such numbers stay within 64 bits.
constexpr Limits bits_limits{1, 1024};
constexpr Limits area_limits{0, Library::most_area_um2};
constexpr Limits delay_limits{1, 1'000'000};
constexpr Limits stages_limits{0, 64};

const FileJson& required(const FileJson& object, const std::string& key, std::string_view where) {
  if (!object.is_object()) throw std::runtime_error(fmt::format("{}: must be a JSON object", where));
  const auto found = object.find(key);
  if (found == object.end()) throw std::runtime_error(fmt::format("{}: \"{}\" is missing", where, key));
  return *found;
}

std::string text_of(const FileJson& object, const std::string& key, std::string_view where) {
  const FileJson& value = required(object, key, where);
  if (!value.is_string()) throw std::runtime_error(fmt::format("{}: \"{}\" must be a text", where, key));
  return value.get<std::string>();
}

int count_of(const FileJson& object, const std::string& key, std::string_view where, Limits allowed) {
  const FileJson& value = required(object, key, where);
  if (!value.is_number_integer() || value.get<std::int64_t>() < allowed.least ||
      value.get<std::int64_t>() > allowed.most) {
    // An array may be nested too deep to be printed.
    const std::string given = value.is_structured() ? value.type_name() : host::shortened(value.dump());
    throw std::runtime_error(fmt::format("{}: \"{}\" is {}, allowed are whole numbers from {} to {}", where,
                                         key, given, allowed.least, allowed.most));
  }
  return value.get<int>();
}

bool truth_of(const FileJson& object, const std::string& key, std::string_view where) {
  const FileJson& value = required(object, key, where);
  if (!value.is_boolean()) {
    throw std::runtime_error(fmt::format("{}: \"{}\" must be true or false", where, key));
  }
  return value.get<bool>();
}

std::string line_of_text(const FileJson& object, const std::string& key, std::string_view where) {
  std::string text = text_of(object, key, where);
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < ' '; })) {
    throw std::runtime_error(fmt::format("{}: \"{}\" must be one line", where, key));
  }
  return text;
}

/// The enumerator whose name, in the order of the enumeration, is the text.
template <class Law, std::size_t N>
Law law_of(const FileJson& object, const std::string& key, std::string_view where,
           const std::array<std::string_view, N>& laws) {
  const std::string law = text_of(object, key, where);
  const auto found = std::find(laws.begin(), laws.end(), law);
  if (found == laws.end()) {
    throw std::runtime_error(fmt::format("{}: \"{}\" is \"{}\", allowed are {}", where, key,
                                         host::shortened(law), fmt::join(laws, ", ")));
  }
  return static_cast<Law>(found - laws.begin());
}

constexpr Limits lut_inputs_limits{2, 16};
constexpr Limits block_width_limits{2, 64};
constexpr Limits percent_limits{0, 1000};
constexpr Limits bit_delay_limits{0, 100'000};
constexpr Limits shift_limits{2, 64};
constexpr Limits luts_limits{0, 1'000'000};

Block block_from(const FileJson& json, const std::string& where) {
  Block block{.name = line_of_text(json, "name", where),
              .width_a = count_of(json, "width_a", where, block_width_limits),
              .width_b = count_of(json, "width_b", where, block_width_limits),
              .reads_unsigned = truth_of(json, "reads_unsigned", where),
              .operand_registers = truth_of(json, "operand_registers", where),
              .product_registers = truth_of(json, "product_registers", where),
              .stages = count_of(json, "stages", where, {1, stages_limits.most}),
              .delay_ps = count_of(json, "delay_ps", where, delay_limits),
              .luts = count_of(json, "luts", where, luts_limits)};
  if (block.width_a < block.width_b) {
    throw std::runtime_error(fmt::format("{}: \"width_a\" is {}, less than \"width_b\" of {}", where,
                                         block.width_a, block.width_b));
  }
  return block;
}

Chip chip_from(const nlohmann::json& json, std::string_view origin) {
  const std::string where = fmt::format("{}: chip", origin);
  const auto part = [&](const char* name) -> std::pair<const FileJson&, std::string> {
    return {required(json, name, where), fmt::format("{}: {}", where, name)};
  };
  const auto [latch, latch_where] = part("register");
  const auto [gate, gate_where] = part("gate");
  const auto [mux, mux_where] = part("mux2");
  const auto [carry, carry_where] = part("carry");
  Chip chip{
      .device = line_of_text(json, "device", where),
      .estimated = truth_of(json, "estimated", where),
      .lut_inputs = count_of(json, "lut_inputs", where, lut_inputs_limits),
      .packs_registers = json.contains("packs_registers") && truth_of(json, "packs_registers", where),
      .maps_tables = json.contains("maps_tables") && truth_of(json, "maps_tables", where),
      .carry_takes_logic = carry.contains("takes_logic") && truth_of(carry, "takes_logic", carry_where),
      .shortest_shift_register = latch.contains("shortest_shift_register")
                                     ? count_of(latch, "shortest_shift_register", latch_where, shift_limits)
                                     : 0,
      .register_delay_ps = count_of(latch, "delay_ps", latch_where, delay_limits),
      .gate_delay_ps = count_of(gate, "delay_ps", gate_where, delay_limits),
      .mux_delay_ps = count_of(mux, "delay_ps", mux_where, delay_limits),
      .carry_delay_ps = count_of(carry, "delay_ps", carry_where, delay_limits),
      .compare_delay_ps =
          count_of(carry, carry.contains("compare_delay_ps") ? "compare_delay_ps" : "delay_ps", carry_where,
                   delay_limits),
      .carry_delay_ps_per_bit = count_of(carry, "delay_ps_per_bit", carry_where, bit_delay_limits),
      .subtrahend_delay_ps = carry.contains("subtrahend_delay_ps")
                                 ? count_of(carry, "subtrahend_delay_ps", carry_where, delay_limits)
                                 : 0,
      .gate_luts_pct = count_of(gate, "luts_pct", gate_where, percent_limits),
      .mux_luts_pct = count_of(mux, "luts_pct", mux_where, percent_limits),
      .carry_luts_pct = count_of(carry, "luts_pct", carry_where, percent_limits),
      .block = std::nullopt};
  if (json.contains("block")) chip.block = block_from(json.at("block"), where + ": block");
  return chip;
}

/// FuseSoC's other targets have other names.
bool names_synthesis(std::string_view name) {
  return name.starts_with("synth") && std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

/// A list of texts, or one value. So what is printed again is flat, and in one line.
bool is_option(const FileJson& value) {
  if (!value.is_array()) return value.is_primitive() && !value.is_null();
  return std::all_of(value.begin(), value.end(), [](const FileJson& each) { return each.is_string(); });
}

std::string flow_options_of(const FileJson& target, std::string_view where) {
  const FileJson& options = required(target, "flow_options", where);
  if (!options.is_object())
    throw std::runtime_error(fmt::format("{}: \"flow_options\" must be a JSON object", where));
  for (const auto& [name, value] : options.items())
    if (!is_option(value))
      throw std::runtime_error(
          fmt::format("{}: flow_options: \"{}\" must be a text, a number, true, false or a list of texts",
                      where, host::shortened(name)));
  return options.dump();
}

std::vector<SynthesisTarget> synthesis_targets_from(const FileJson& json, const std::string& where) {
  if (!json.is_object()) throw std::runtime_error(fmt::format("{}: must be a JSON object", where));
  std::vector<SynthesisTarget> targets;
  for (const auto& [name, target] : json.items()) {
    if (!names_synthesis(name))
      throw std::runtime_error(
          fmt::format("{}: target \"{}\", allowed are synth and what begins with it, of a-z, 0-9 and _",
                      where, host::shortened(name)));
    const std::string in_target = fmt::format("{}: {}", where, host::shortened(name));
    targets.push_back({.name = name,
                       .description = line_of_text(target, "description", in_target),
                       .flow = line_of_text(target, "flow", in_target),
                       .options = flow_options_of(target, in_target)});
  }
  return targets;
}

/// A file of cells states all others. Gates have one delay and no area (section 7.3).
bool has_cells(Component component) {
  return component != Component::gate;
}

FileJson parsed(std::string_view text, std::string_view origin) {
  try {
    return FileJson::parse(text);
  } catch (const FileJson::exception& error) {
    throw std::runtime_error(fmt::format("{}: not JSON: {}", origin, error.what()));
  }
}

// In the order of their enumerations.
constexpr std::array<std::string_view, 3> above_laws{"same", "tree", "stages"};
constexpr std::array<std::string_view, 2> area_laws{"linear", "quadratic"};

std::vector<Cell> cells_of(const FileJson& entry, std::string_view where) {
  const FileJson& rows = required(entry, "cells", where);
  if (!rows.is_array() || rows.empty()) throw std::runtime_error(fmt::format("{}: no cells", where));
  std::vector<Cell> cells;
  for (const FileJson& row : rows) {
    const int bits = count_of(row, "bits", where, bits_limits);
    const std::string cell = fmt::format("{}_{}", where, bits);
    if (!cells.empty() && cells.back().bits >= bits) {
      throw std::runtime_error(fmt::format("{}: cells must be in ascending order of bits", where));
    }
    cells.push_back({.bits = bits,
                     .area_um2 = count_of(row, "area_um2", cell, area_limits),
                     .delay_ps = count_of(row, "delay_ps", cell, delay_limits),
                     .stages = count_of(row, "stages", cell, stages_limits),
                     .estimated = row.contains("estimated") && truth_of(row, "estimated", cell)});
  }
  return cells;
}

}  // namespace

Library Library::from_json(std::string_view text, std::string_view origin) {
  const FileJson json = parsed(text, origin);
  Library library;
  library.name_ = line_of_text(json, "name", origin);
  if (json.contains("process")) library.process_ = line_of_text(json, "process", origin);
  if (json.contains("source")) library.source_ = text_of(json, "source", origin);
  if (json.contains("fusesoc"))
    library.synthesis_targets_ =
        synthesis_targets_from(json.at("fusesoc"), fmt::format("{}: fusesoc", origin));
  if (json.contains("chip")) {
    library.chip_ = chip_from(json.at("chip"), origin);
    library.gate_delay_ps_ = library.chip_->gate_delay_ps;
    return library;
  }
  library.gate_delay_ps_ = count_of(json, "gate_delay_ps", origin, delay_limits);
  const FileJson& components = required(json, "components", origin);
  for (std::size_t i = 0; i < component_count; ++i) {
    if (!has_cells(static_cast<Component>(i))) continue;
    const std::string name(component_name(static_cast<Component>(i)));
    const bool is_optional = static_cast<Component>(i) >= Component::fp_subtract;
    if (is_optional && !components.contains(name)) continue;
    const FileJson& entry = required(components, name, origin);
    const std::string where = fmt::format("{}: {}", origin, name);
    Family& family = library.families_[i];
    family.above = law_of<Above>(entry, "above", where, above_laws);
    family.area = law_of<AreaLaw>(entry, "area", where, area_laws);
    family.cells = cells_of(entry, where);
    if (family.above == Above::tree && family.cells.back().bits < 2) {
      throw std::runtime_error(fmt::format("{}: \"tree\" needs a cell of at least 2 bits", where));
    }
  }
  return library;
}

Library Library::load(const std::filesystem::path& file) {
  return from_json(host::read_file(file, "cannot read the component library"), file.string());
}

std::vector<std::string> built_in_names() {
  std::vector<std::string> names;
  for (const BuiltInFile& file : built_in_files()) names.emplace_back(file.name);
  return names;
}

Library library_called(std::string_view name_or_file) {
  if (name_or_file.ends_with(".json")) return Library::load(name_or_file);
  const auto files = built_in_files();
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const BuiltInFile& file) { return file.name == name_or_file; });
  if (found == files.end()) {
    throw std::runtime_error(
        fmt::format("library {}: unknown; there are {}, and any file whose name ends in .json",
                    host::shortened(name_or_file), fmt::join(built_in_names(), ", ")));
  }
  return Library::from_json(found->json, fmt::format("{}.json", found->name));
}

Library Library::with_block_luts(int luts) const {
  if (!chip_ || !chip_->block)
    throw std::runtime_error(fmt::format(
        "--block-luts: the library {} has no multiplier blocks; allowed with one of a chip that has them",
        host::shortened(name_)));
  Library other = *this;
  other.name_ += fmt::format(" --block-luts {}", luts);
  other.chip_->block->luts = luts;
  return other;
}

Library library_called(std::string_view name_or_file, std::optional<int> block_luts) {
  Library library = library_called(name_or_file);
  return block_luts ? library.with_block_luts(*block_luts) : library;
}

const Library& Library::thesis() {
  static const Library library = library_called(default_library);
  return library;
}

}  // namespace hitpipe::rtl
