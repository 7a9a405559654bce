// What a file of a piece says of itself, and whether files are all pieces of one command
// (docs/choosing.md). It stands in the file, or for a sweep in the JSON file beside its rows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "host/piece.hpp"

namespace hitpipe::cli {

struct PieceNote {
  std::string program;  ///< its name, version and hash of the sources
  std::string command;  ///< that does all pieces in one run, without its output, its format and its threads
  std::map<std::string, std::string> inputs{};  ///< files that were read, with hashes of their contents
  host::Piece piece;
  std::uint64_t parts = 0;  ///< that this piece has of the work

  /// As the user knows it: piece 3 of 8 of "hitpipe check ...".
  [[nodiscard]] std::string text() const;
};

/// The first of these inputs that the other piece did not read, or read with other contents; empty if there
/// is none.
[[nodiscard]] std::string differing_input(const PieceNote& note, const PieceNote& other);

[[nodiscard]] Row to_row(const PieceNote& note);

/// Throws std::runtime_error, "FILE: ...", for what is no note of a piece.
[[nodiscard]] PieceNote parse_note(const Row& row, const std::filesystem::path& file);

struct PieceFile {
  std::filesystem::path file;
  PieceNote note;
  Row result;  ///< of its command's own form
};

/// Writes it whole or not at all. Throws std::runtime_error when it cannot be written.
void write_piece(const PieceFile& piece);

/// Throws std::runtime_error, one line that names the file, when it cannot be read, was cut or is no piece.
[[nodiscard]] PieceFile read_piece(const std::filesystem::path& file);

/// Of rows in a CSV file, with the notes of the JSON file beside it as its result. Throws as read_piece().
[[nodiscard]] PieceFile note_beside(const std::filesystem::path& rows);

/// Throws std::runtime_error: the file is no whole piece.
[[noreturn]] void refuse_piece(const std::filesystem::path& file);

/// What `parse` makes of the piece's result. Refuses the file when it has another form.
template <class Parse>
[[nodiscard]] auto result_of(const PieceFile& piece, Parse parse) {
  try {
    return parse(piece.result);
  } catch (const Row::exception&) {
    refuse_piece(piece.file);
  }
}

/// Reads files that have all pieces of one command, and returns them in order. `program` is the name and
/// version of this program, `command` the full name of its command. Throws what read_piece() throws, and
/// std::runtime_error, one line that names the piece, when one is missing or there twice, or is of another
/// version, command or input.
[[nodiscard]] std::vector<PieceFile> read_pieces(const std::vector<std::string>& files,
                                                 const std::string& program, const std::string& command);

/// The same checks of what was read elsewhere. Sorts.
void check_pieces(std::vector<PieceFile>& pieces, const std::string& program, const std::string& command);

}  // namespace hitpipe::cli
