#include "cli/text/csv_metadata.hpp"

#include <algorithm>
#include <array>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/text/help.hpp"
#include "cli/text/scene_text.hpp"
#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

template <class Vector>
Row numbers(const Vector& v) {
  return {v.x, v.y, v.z};
}

/// The unit that a column's name ends with. Empty: it is a count or a text.
std::string_view unit_of(std::string_view column) {
  struct Unit {
    std::string_view ending, unit;
  };
  // The longer of two endings first.
  static constexpr std::array units{Unit{"_mm2_ns", "mm2 ns"},
                                    Unit{"_mm2_ms", "mm2 ms"},
                                    Unit{"_lut_ms", "LUT ms"},
                                    Unit{"_pj_per_box", "pJ a box"},
                                    Unit{"_nj_per_ray", "nJ a ray"},
                                    Unit{"_per_million", "per million"},
                                    Unit{"_mm2", "mm2"},
                                    Unit{"_um2", "um2"},
                                    Unit{"_lut", "LUT"},
                                    Unit{"_ps", "ps"},
                                    Unit{"_ns", "ns"},
                                    Unit{"_ms", "ms"},
                                    Unit{"_seconds", "s"},
                                    Unit{"_mhz", "MHz"},
                                    Unit{"_pct", "%"}};
  for (const Unit& each : units)
    if (column.ends_with(each.ending)) return each.unit;
  return column.starts_with("bytes_") || column.find("_bytes") != std::string_view::npos ? "bytes" : "";
}

Row described(const CsvTable& table) {
  Row columns = Row::array();
  for (const std::string& name : table.columns) {
    Row column{{"name", name}};
    if (const std::string_view unit = unit_of(name); !unit.empty()) column["schema:unitText"] = unit;
    if (name == "bits") column["dc:description"] = "format of the design, as --bits takes it";
    columns.push_back(column);
  }
  return {{"url", table.name}, {"tableSchema", {{"columns", columns}}}};
}

}  // namespace

std::string command_line(const CLI::App& command, const std::vector<std::string>& without,
                         const std::vector<std::string>& always) {
  const auto is_in = [](const std::vector<std::string>& names, const CLI::Option* option) {
    return std::find(names.begin(), names.end(), option->get_name()) != names.end();
  };
  std::string text = full_name(command);
  for (const CLI::Option* const option : command.get_options()) {
    if (option->count() == 0 && is_in(always, option))
      text += " " + option->get_name() + " " + option->get_default_str();
    if (option->count() == 0 || is_in(without, option) || is_in(talk_options(), option)) continue;
    const bool flag = option->get_items_expected_max() == 0;
    std::vector<std::string> words = flag ? std::vector<std::string>{} : option->results();
    const bool list = !option->get_positional() && option->get_delimiter() != '\0';
    if (list) words = {fmt::format("{}", fmt::join(words, std::string(1, option->get_delimiter())))};
    if (flag) text += " " + option->get_name();
    for (const std::string& word : words) {
      if (!option->get_positional()) text += " " + option->get_name();
      text += " " + host::shell_word(word);
    }
  }
  return text;
}

std::string program_of(const CLI::App& command) {
  const CLI::App* program = &command;
  while (program->get_parent() != nullptr) program = program->get_parent();
  return program->version();
}

Row notes_of(const CLI::App& command) {
  return {{"program", program_of(command)}, {"command", command_line(command)}};
}

Row notes_of(const CLI::App& command, const ref::Scene& scene) {
  Row notes = notes_of(command);
  notes.update(camera_notes(scene));
  return notes;
}

Row camera_notes(const ref::Scene& scene) {
  const ref::Camera& camera = scene.camera;
  Row row{{"scene", scene.name},
          {"cube", {{"offset", numbers(scene.to_cube.offset)}, {"scale", scene.to_cube.scale}}}};
  Row in_cube{{"eye", numbers(camera.eye)},
              {"forward", numbers(camera.forward)},
              {"right", numbers(camera.right)},
              {"up", numbers(camera.up)}};
  if (camera.projection == ref::Projection::orthographic)
    in_cube["half_height"] = camera.half_height;
  else
    in_cube["tan_half_height"] = camera.tan_half_height;
  row["camera_in_cube"] = std::move(in_cube);
  row["mesh"] = scene_row(scene);
  return row;
}

std::filesystem::path metadata_file(const std::filesystem::path& table) {
  return table.string() + "-metadata.json";
}

CsvTable csv_table(const std::filesystem::path& file, std::string_view text) {
  return {file.filename().string(), host::csv_cells(text.substr(0, text.find('\n')))};
}

std::string csv_metadata(const std::vector<CsvTable>& tables, const Row& notes) {
  Row row{{"@context", "http://www.w3.org/ns/csvw"}};
  if (tables.size() == 1) {
    row.update(described(tables.front()));
  } else {
    row["tables"] = Row::array();
    for (const CsvTable& table : tables) row["tables"].push_back(described(table));
  }
  row["notes"] = Row::array({notes});
  return record_text(row, OutputFormat::json);
}

}  // namespace hitpipe::cli
