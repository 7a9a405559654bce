#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/values.hpp"
#include "cli/text/table.hpp"
#include "rtl_gen/component/library.hpp"

namespace hitpipe::cli {

namespace {

constexpr std::size_t page_width = 80;

std::string counted(const rtl::Library& library) {
  if (library.chip() == nullptr) return "area in mm2";
  return library.chip()->block ? fmt::format("LUT, FF, {}", library.chip()->block->name) : "LUT, FF";
}

Row row_of(const rtl::Library& library) {
  return {{"library", library.name()},
          {"of", library.chip() != nullptr ? library.chip()->device : library.process()},
          {"counts", counted(library)},
          {"source", library.source()}};
}

/// The words in lines of the page's width that begin with `indent` blanks, without the first blanks.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string lines;
  std::size_t column = indent;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (column > indent && column + 1 + word.size() > page_width) {
      lines += fmt::format("\n{:{}}", "", indent);
      column = indent;
    } else if (column > indent) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
  }
  return lines;
}

std::string described(const Row& row) {
  std::string text = row.at("library").get<std::string>() + "\n";
  for (const auto& [key, value] : row.items()) {
    if (key == "library" || value.get<std::string>().empty()) continue;
    const std::string head = fmt::format("  {:<8}", key);
    text += fmt::format("{}{}\n", head, wrapped(value.get<std::string>(), head.size()));
  }
  return text;
}

}  // namespace

void add_libraries_command(CLI::App& program, int& /*exit_code*/) {
  CLI::App* const command =
      program.add_subcommand("libraries", "List the component libraries: what they are of and from where");
  const auto format = std::make_shared<Format>(Format::text);
  add_format_option(*command, *format);
  command->callback([format] {
    std::vector<Row> rows;
    std::string text;
    for (const std::string& name : rtl::built_in_names()) {
      rows.push_back(row_of(rtl::library_called(name)));
      text += described(rows.back());
    }
    fmt::print("{}", *format == Format::text ? text : table_text(rows, *format));
  });
}

}  // namespace hitpipe::cli
