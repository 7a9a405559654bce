#include "cli/pieces/piece_file.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/text/csv_metadata.hpp"
#include "host/files.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), why));
}

/// Why the piece is not of the same work as `first`; empty when it is.
std::string difference(const PieceNote& first, const PieceNote& other) {
  if (other.command != first.command || other.piece.of != first.piece.of)
    return fmt::format("is {}, and the first file is {}", other.text(), first.text());
  if (const std::string input = differing_input(first, other); !input.empty())
    return fmt::format("was made with another {} than the first file", input);
  return other.inputs.size() == first.inputs.size() ? "" : "was made with other files than the first file";
}

std::string missing_text(const std::vector<std::uint64_t>& missing, const PieceNote& of) {
  constexpr std::size_t most = 8;
  const std::size_t shown = std::min(missing.size(), most);
  const std::vector<std::uint64_t> first(missing.begin(),
                                         missing.begin() + static_cast<std::ptrdiff_t>(shown));
  const std::string more =
      missing.size() > shown ? fmt::format(" and {} more", missing.size() - shown) : std::string();
  return fmt::format("--join: piece {}{} of {} of \"{}\" is missing", fmt::join(first, ", "), more,
                     of.piece.of, of.command);
}

}  // namespace

std::string PieceNote::text() const {
  return fmt::format("piece {} of {} of \"{}\"", piece.number, piece.of, command);
}

std::string differing_input(const PieceNote& note, const PieceNote& other) {
  for (const auto& [name, hash] : note.inputs) {
    const auto found = other.inputs.find(name);
    if (found == other.inputs.end() || found->second != hash) return name;
  }
  return "";
}

Row to_row(const PieceNote& note) {
  Row inputs = Row::object();
  for (const auto& [name, hash] : note.inputs) inputs[name] = hash;
  return {{"program", note.program},    {"command", note.command}, {"inputs", inputs},
          {"piece", note.piece.number}, {"pieces", note.piece.of}, {"parts", note.parts}};
}

PieceNote parse_note(const Row& row, const fs::path& file) {
  try {
    PieceNote note{.program = row.at("program").get<std::string>(),
                   .command = row.at("command").get<std::string>(),
                   .piece = {row.at("piece").get<std::uint64_t>(), row.at("pieces").get<std::uint64_t>()},
                   .parts = row.at("parts").get<std::uint64_t>()};
    for (const auto& [name, hash] : row.at("inputs").items()) note.inputs[name] = hash.get<std::string>();
    const host::Piece piece = note.piece;
    if (piece.number >= 1 && piece.number <= piece.of && piece.of <= host::Piece::most) return note;
  } catch (const Row::exception&) {  // said below
  }
  refuse_piece(file);
}

void refuse_piece(const fs::path& file) {
  refuse(file, "is no whole piece; run the command of this piece again");
}

void write_piece(const PieceFile& piece) {
  Row row = to_row(piece.note);
  row["result"] = piece.result;
  host::write_file(piece.file, record_text(row, OutputFormat::json));
}

PieceFile read_piece(const fs::path& file) {
  const std::string text = host::read_file(file, "cannot read the piece");
  const Row row = Row::parse(text, nullptr, false);
  if (!row.is_object() || !row.contains("result")) refuse_piece(file);
  return {file, parse_note(row, file), row.at("result")};
}

PieceFile note_beside(const fs::path& rows) {
  const fs::path file = metadata_file(rows);
  const Row row = Row::parse(host::read_file(file, "cannot read which piece is beside it"), nullptr, false);
  const Row::json_pointer notes("/notes/0");
  const Row::json_pointer piece("/notes/0/piece");
  if (!row.is_object() || !row.contains(piece)) refuse_piece(rows);
  return {rows, parse_note(row.at(piece), rows), row.at(notes)};
}

std::vector<PieceFile> read_pieces(const std::vector<std::string>& files, const std::string& program,
                                   const std::string& command) {
  std::vector<PieceFile> pieces;
  for (const std::string& file : files) pieces.push_back(read_piece(file));
  check_pieces(pieces, program, command);
  return pieces;
}

void check_pieces(std::vector<PieceFile>& pieces, const std::string& program, const std::string& command) {
  for (const PieceFile& each : pieces) {
    if (each.note.program != program)
      refuse(each.file, fmt::format("was made by {}, and this is {}", each.note.program, program));
    if (!each.note.command.starts_with(command + " "))
      refuse(each.file, fmt::format("is {}; allowed are pieces of {}", each.note.text(), command));
    if (const std::string why = difference(pieces.front().note, each.note); !why.empty())
      refuse(each.file, why);
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const PieceFile& a, const PieceFile& b) {
    return a.note.piece.number < b.note.piece.number;
  });
  std::vector<std::uint64_t> missing;
  std::uint64_t next = 1;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::uint64_t number = pieces[i].note.piece.number;
    if (i > 0 && number == pieces[i - 1].note.piece.number)
      refuse(pieces[i].file, fmt::format("is piece {} of {}, as {} is; give each once", number,
                                         pieces[i].note.piece.of, pieces[i - 1].file.string()));
    for (; next < number; ++next) missing.push_back(next);
    next = number + 1;
  }
  const PieceNote& last = pieces.back().note;
  for (; next <= last.piece.of; ++next) missing.push_back(next);
  if (!missing.empty()) throw std::runtime_error(missing_text(missing, last));
}

}  // namespace hitpipe::cli
