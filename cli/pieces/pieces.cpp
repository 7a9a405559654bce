#include "cli/pieces/pieces.hpp"

#include <algorithm>
#include <filesystem>
#include <span>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/values.hpp"
#include "cli/text/csv_metadata.hpp"
#include "host/files.hpp"
#include "host/outputs.hpp"
#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

bool given(const CLI::App& command, const std::string& option) {
  const CLI::Option* const found = command.get_option_no_throw(option);
  return found != nullptr && found->count() > 0;
}

host::Piece parse_piece(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto number = host::number_in<std::uint64_t>(std::string_view(text).substr(0, slash));
    const auto of = host::number_in<std::uint64_t>(std::string_view(text).substr(slash + 1));
    if (number && of && *number >= 1 && *number <= *of && *of <= host::Piece::most) return {*number, *of};
  }
  throw CLI::ValidationError("--piece", fmt::format("{} is not K/N, a piece from 1/N to N/N, N at most {}",
                                                    host::shortened(text), host::Piece::most));
}

/// What it means depends on the other options, which are all known when values are checked.
std::string check_out(const CLI::App& command, Output kind, const std::string& out) {
  const bool folder = given(command, "--pieces") || (kind == Output::folder && !given(command, "--piece"));
  if (out.empty()) return fmt::format("is empty; give the name of a {}", folder ? "folder" : "file");
  if (folder)
    host::announce_output_folder(out);
  else
    host::announce_output("--out", out);
  return "";
}

std::string contents_hash(const std::string& file) {
  const std::string text = host::read_file(file);
  return fmt::format("fnv1a-{:016x}", host::fnv1a(std::as_bytes(std::span(text))));
}

void check_count(std::string_view option, std::uint64_t pieces, std::uint64_t count, std::string_view parts) {
  if (pieces > count)
    throw std::runtime_error(fmt::format("{}: {} pieces of {} {}; allowed is 1 to {}", option, pieces, count,
                                         parts, std::min(count, host::Piece::most)));
}

}  // namespace

CLI::Option* add_pieces_options(CLI::App& command, PiecesChoice& choice, std::string& out, Output kind,
                                const std::string& what) {
  CLI::Option* const pieces =
      command
          .add_option(
              "--pieces", choice.pieces,
              fmt::format("Print the commands of so many pieces of the work, and do nothing (1 to {})",
                          host::Piece::most))
          ->transform(number_from(std::uint64_t{1}, host::Piece::most))
          ->type_name("N");
  CLI::Option* const piece =
      command
          .add_option_function<std::string>(
              "--piece", [&choice](const std::string& text) { choice.piece = parse_piece(text); },
              "Do this one of N pieces and write its file")
          ->type_name("K/N");
  CLI::Option* const join =
      as_input(command.add_option("--join", choice.join, "Make one result of the files of all pieces"))
          ->type_name("FILE");
  CLI::Option* const out_option =
      command
          .add_option("--out", out, what + ". With --pieces the folder of their files, with --piece its file")
          ->type_name(kind == Output::file ? "FILE" : "FOLDER")
          ->check([&command, kind](const std::string& text) { return check_out(command, kind, text); });
  exclude(piece, pieces, "one prints commands, the other does what one of them says");
  exclude_all_but(command, join, {"--out", "--format", "--judge"}, "the pieces say it");
  join->check([&command](const std::string&) {
    for (CLI::Option* const option : command.get_options())
      if (option->get_name() != "--out") option->required(false);
    return std::string();
  });
  return out_option;
}

std::string whole_command(const CLI::App& parsed) {
  std::vector<std::string> seeds{"--seed"};
  if (!given(parsed, "--rays")) seeds.emplace_back("--light-seed");
  return command_line(parsed, {"--pieces", "--piece", "--join", "--out", "--format", "--threads"}, seeds);
}

void print_pieces(const CLI::App& parsed, const PiecesChoice& choice, const std::string& folder,
                  std::uint64_t count, std::string_view parts, std::string_view ending) {
  if (folder.empty()) throw std::runtime_error("--pieces: needs --out, the folder of their files");
  check_count("--pieces", choice.pieces, count, parts);
  const std::vector<std::string>& called = parsed.get_parent()->get_aliases();
  const std::string program = called.empty() ? "hitpipe" : host::shell_word(called.front());
  const std::string rest = whole_command(parsed).substr(std::string_view("hitpipe").size());
  const CLI::Option* const threads = parsed.get_option_no_throw("--threads");
  const std::string on = threads == nullptr      ? ""
                         : threads->count() == 0 ? " --threads 1"
                                                 : " --threads " + threads->results().front();
  const std::size_t digits = std::to_string(choice.pieces).size();
  for (std::uint64_t i = 1; i <= choice.pieces; ++i) {
    const fs::path file = fs::path(folder) / fmt::format("{:0{}}.{}", i, digits, ending);
    fmt::print("{}{}{} --piece {}/{} --out {}\n", program, rest, on, i, choice.pieces,
               host::shell_word(file.string()));
  }
}

std::string program_of(const CLI::App& parsed) {
  return parsed.get_parent()->version();
}

PieceNote piece_note(const CLI::App& parsed, const PiecesChoice& choice, std::uint64_t count,
                     std::string_view parts) {
  const host::Piece piece = choice.piece.value();
  check_count("--piece", piece.of, count, parts);
  PieceNote note{.program = program_of(parsed),
                 .command = whole_command(parsed),
                 .piece = piece,
                 .parts = piece.range(count).size()};
  for (const std::string& file : host::inputs()) note.inputs[file] = contents_hash(file);
  return note;
}

void print_done(const std::string& file, const PieceNote& note) {
  fmt::print("{}: piece {} of {}\n", file, note.piece.number, note.piece.of);
}

bool same_piece(const PieceNote& one, const PieceNote& other) {
  return one.program == other.program && one.command == other.command && one.piece == other.piece;
}

void refuse_other_piece(const std::string& file, const PieceNote& there, const PieceNote& asked) {
  throw std::runtime_error(
      fmt::format("{}: holds {} by {}, asked for is {} by {}; give another file or remove it", file,
                  there.text(), there.program, asked.text(), asked.program));
}

int run_piece(const CLI::App& parsed, const PiecesChoice& choice, const std::string& file,
              std::uint64_t count, std::string_view parts, const std::function<Row()>& result) {
  if (file.empty()) throw std::runtime_error("--piece: needs --out, the file of the piece");
  const PieceNote asked = piece_note(parsed, choice, count, parts);
  if (fs::exists(file)) {
    const PieceNote there = read_piece(file).note;
    if (!same_piece(there, asked)) refuse_other_piece(file, there, asked);
  } else {
    Row made = result();
    write_piece({file, piece_note(parsed, choice, count, parts), std::move(made)});
  }
  print_done(file, asked);
  return 0;
}

std::vector<PieceFile> joined_pieces(const CLI::App& parsed, const PiecesChoice& choice) {
  return read_pieces(choice.join, program_of(parsed), parsed.get_name());
}

}  // namespace hitpipe::cli
