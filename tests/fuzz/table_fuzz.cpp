// What a command prints for words that a user chose, such as the name of a scene. A reader must be able to
// read the JSON and CSV back, whatever the bytes.
#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/text/table.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace hitpipe;
using fuzz::expect;

/// The first cell of a line of CSV (RFC 4180).
std::string first_cell(const std::string& line) {
  if (!line.starts_with('"')) return line.substr(0, line.find_first_of(",\r\n"));
  std::string cell;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '"' && line[++i] != '"') break;
    cell += line[i];
  }
  return cell;
}

bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(cli::Row(text).dump());
    return true;
  } catch (const cli::Row::type_error&) {
    return false;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const cli::Row row{{"scene", text}, {"triangles", size}, {"files", {text, text}}};
  for (const std::string& printed : {cli::record_text(row, cli::OutputFormat::json),
                                     cli::table_text({row, row}, cli::OutputFormat::json)}) {
    expect(nlohmann::json::accept(printed), "JSON can be read");
  }
  if (is_utf8(text)) {
    const auto read = nlohmann::json::parse(cli::record_text(row, cli::OutputFormat::json));
    expect(read.at("scene") == text && read.at("files").at(1) == text, "JSON keeps every character");
  }
  const std::string csv = cli::record_text(row, cli::OutputFormat::csv);
  const std::string cell = first_cell(csv.substr(csv.find('\n') + 1));
  // What a spreadsheet would take for a date, such as 6/6, has an n before it.
  expect(cell == text || cell == 'n' + text, "CSV keeps every byte");
  expect(!cli::record_text(row, cli::OutputFormat::text).empty(), "text is printed");
  expect(!cli::table_text({row, row}, cli::OutputFormat::text).empty(), "text is printed");
  return 0;
}
