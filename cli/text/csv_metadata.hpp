// A CSV file has no place for the program, the command line, the scene and its camera. They stand in a JSON
// file beside it, as the W3C's "Metadata Vocabulary for Tabular Data" has them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cli/text/table.hpp"
#include "rays/scene/scene.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// "hitpipe sweep --scene spheres ...": the words as the user gave them, for a shell. Leaves out the options
/// `without`, and names those of `always` that the command has even if the user did not.
[[nodiscard]] std::string command_line(const CLI::App& command, const std::vector<std::string>& without = {},
                                       const std::vector<std::string>& always = {});

/// The program of a command, with its version.
[[nodiscard]] std::string program_of(const CLI::App& command);

/// Of a command that ran: its program and its command line.
[[nodiscard]] Row notes_of(const CLI::App& command);
/// The same with camera_notes().
[[nodiscard]] Row notes_of(const CLI::App& command, const ref::Scene& scene);

/// What places the scene in the cube and the camera before it.
[[nodiscard]] Row camera_notes(const ref::Scene& scene);

/// The name of the JSON file beside a table: FILE-metadata.json.
[[nodiscard]] std::filesystem::path metadata_file(const std::filesystem::path& table);

/// A CSV file by its name, and the names of its columns.
struct CsvTable {
  std::string name;
  std::vector<std::string> columns;
};
/// Takes the columns from the first line of the file's text.
[[nodiscard]] CsvTable csv_table(const std::filesystem::path& file, std::string_view text);

/// For one table, or for all tables of a folder. Each column has its name, and the unit that its name ends
/// with.
[[nodiscard]] std::string csv_metadata(const std::vector<CsvTable>& tables, const Row& notes);

}  // namespace hitpipe::cli
