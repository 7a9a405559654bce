#include "cli/text/csv_metadata.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

template <class Vector>
Row numbers(const Vector& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

std::string command_line(const CLI::App& command, const std::vector<std::string>& without,
                         const std::vector<std::string>& always) {
  const auto is_in = [](const std::vector<std::string>& names, const CLI::Option* option) {
    return std::find(names.begin(), names.end(), option->get_name()) != names.end();
  };
  std::string text = "hitpipe " + command.get_name();
  for (const CLI::Option* const option : command.get_options()) {
    if (option->count() == 0 && is_in(always, option))
      text += " " + option->get_name() + " " + option->get_default_str();
    if (option->count() == 0 || is_in(without, option)) continue;
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

Row notes_of(const CLI::App& command) {
  return {{"program", command.get_parent()->version()}, {"command", command_line(command)}};
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
  return row;
}

std::filesystem::path metadata_file(const std::filesystem::path& table) {
  return table.string() + "-metadata.json";
}

std::string csv_metadata(const std::vector<std::string>& tables, const Row& notes) {
  Row row{{"@context", "http://www.w3.org/ns/csvw"}};
  if (tables.size() == 1) {
    row["url"] = tables.front();
  } else {
    row["tables"] = Row::array();
    for (const std::string& table : tables) row["tables"].push_back({{"url", table}});
  }
  row["notes"] = Row::array({notes});
  return record_text(row, OutputFormat::json);
}

}  // namespace hitpipe::cli
