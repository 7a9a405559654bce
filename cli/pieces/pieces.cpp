#include "cli/pieces/pieces.hpp"

#include <algorithm>
#include <filesystem>
#include <span>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/values.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/last_line.hpp"
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

void check_count(const CutWork& work, std::string_view option, std::uint64_t pieces) {
  if (pieces > work.count)
    throw std::runtime_error(fmt::format("{}: {} pieces of {} {}; allowed is 1 to {}", option, pieces,
                                         work.count, work.parts, std::min(work.count, host::Piece::most)));
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
  exclude_all_but(command, join, {"--out", "--format", "--judge", "--stiff", "--plot-width"},
                  "the pieces say it");
  join->check([&command](const std::string&) {
    for (CLI::Option* const option : command.get_options())
      if (option->get_name() != "--out") option->required(false);
    return std::string();
  });
  return out_option;
}

std::string whole_command(const CLI::App& parsed) {
  std::vector<std::string> seeds;
  // Where rays at edges alone are drawn at random, the seed is theirs.
  const bool of_edges = parsed.get_option_no_throw("--edge-rays") != nullptr;
  if (!of_edges || given(parsed, "--edge-rays")) seeds.emplace_back("--seed");
  if (!given(parsed, "--rays")) seeds.emplace_back("--light-seed");
  return command_line(
      parsed, {"--pieces", "--piece", "--join", "--out", "--format", "--threads", "--plot-width"}, seeds);
}

void print_pieces(const CutWork& work, std::string_view ending) {
  if (work.out.empty()) throw std::runtime_error("--pieces: needs --out, the folder of their files");
  const std::uint64_t pieces = work.choice.pieces;
  check_count(work, "--pieces", pieces);
  const CLI::App* root = &work.parsed;
  while (root->get_parent() != nullptr) root = root->get_parent();
  const std::vector<std::string>& called = root->get_aliases();
  const std::string program = called.empty() ? "hitpipe" : host::shell_word(called.front());
  const std::string rest = whole_command(work.parsed).substr(std::string_view("hitpipe").size());
  const CLI::Option* const threads = work.parsed.get_option_no_throw("--threads");
  const std::string on = threads == nullptr      ? ""
                         : threads->count() == 0 ? " --threads 1"
                                                 : " --threads " + threads->results().front();
  for (std::uint64_t i = 1; i <= pieces; ++i) {
    const fs::path file = fs::path(work.out) / fmt::format("{}.{}", i, ending);
    fmt::print("{}{}{} --piece {}/{} --out {}\n", program, rest, on, i, pieces,
               host::shell_word(file.string()));
  }
}

PieceNote piece_note(const CutWork& work) {
  const host::Piece piece = work.choice.chosen();
  if (work.out.empty()) throw std::runtime_error("--piece: needs --out, the file of the piece");
  check_count(work, "--piece", piece.of);
  PieceNote note{.program = program_of(work.parsed),
                 .command = whole_command(work.parsed),
                 .piece = piece,
                 .parts = piece.range(work.count).size()};
  for (const std::string& file : host::inputs()) note.inputs[file] = contents_hash(file);
  return note;
}

void check_same_piece(const CutWork& work, const PieceNote& there) {
  const PieceNote asked = piece_note(work);
  if (there.program != asked.program || there.command != asked.command || there.piece != asked.piece)
    throw std::runtime_error(
        fmt::format("{}: holds {} by {}, asked for is {} by {}; give another file or remove it", work.out,
                    there.text(), there.program, asked.text(), asked.program));
  if (const std::string input = differing_input(asked, there); !input.empty())
    throw std::runtime_error(
        fmt::format("{}: was made with another {}; give another file or remove it", work.out, input));
}

void print_done(const CutWork& work) {
  const host::Piece piece = work.choice.chosen();
  fmt::print("{}: piece {} of {}\n", work.out, piece.number, piece.of);
}

int do_work(const CutWork& work, const std::function<Row(host::Piece)>& piece,
            const std::function<int()>& all) {
  if (work.choice.pieces > 0) {
    print_pieces(work, "json");
    return 0;
  }
  if (!work.choice.piece) return all();
  if (fs::exists(work.out)) {
    check_same_piece(work, read_piece(work.out).note);
  } else {
    static_cast<void>(piece_note(work));  // refuses what cannot be done
    const host::Piece chosen = work.choice.chosen();
    const LastLine line(
        fmt::format("the same command begins piece {} of {} again", chosen.number, chosen.of));
    Row result = piece(chosen);
    write_piece({work.out, piece_note(work), std::move(result)});
  }
  print_done(work);
  return 0;
}

std::string joined_command(const std::string& whole, const std::string& out) {
  return out.empty() ? whole : whole + " --out " + host::shell_word(out);
}

std::vector<PieceFile> joined_pieces(const CLI::App& parsed, const PiecesChoice& choice) {
  return read_pieces(choice.join, program_of(parsed), full_name(parsed));
}

}  // namespace hitpipe::cli
