// The options of a command whose work can be cut into pieces (docs/many_machines.md): --pieces N prints the
// commands of N pieces, --piece K/N does one of them, and --join makes one result of their files.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/pieces/piece_file.hpp"
#include "cli/text/table.hpp"
#include "host/piece.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hitpipe::cli {

struct PiecesChoice {
  std::uint64_t pieces = 0;  ///< to be printed as commands; 0: none
  std::optional<host::Piece> piece;
  std::vector<std::string> join;  ///< files of pieces

  [[nodiscard]] bool any() const { return pieces > 0 || piece || !join.empty(); }
};

/// What --out names where no piece is asked for.
enum class Output { file, folder };

/// Adds --pieces, --piece and --join, and --out, which names the folder of the pieces' files, the file of one
/// piece, or else what `what` says. Options that the command requires are not required with --join.
CLI::Option* add_pieces_options(CLI::App& command, PiecesChoice& choice, std::string& out, Output kind,
                                const std::string& what);

/// Of a command, without what does not decide its result: pieces, output, format, threads. Seeds are named.
[[nodiscard]] std::string whole_command(const CLI::App& parsed);

/// Prints a command for each piece, as a shell takes it. Its file is FOLDER/NUMBER.ENDING. Throws
/// std::runtime_error, one line, when there are fewer parts than pieces; `parts` is what there are so many
/// of, such as "rows".
void print_pieces(const CLI::App& parsed, const PiecesChoice& choice, const std::string& folder,
                  std::uint64_t count, std::string_view parts, std::string_view ending);

/// "hitpipe 1.2.3", as pieces name it.
[[nodiscard]] std::string program_of(const CLI::App& parsed);

/// The note of the piece that is asked for. It has `count` parts of the work, and the hashes of the files
/// that were read so far. Throws std::runtime_error as print_pieces() does.
[[nodiscard]] PieceNote piece_note(const CLI::App& parsed, const PiecesChoice& choice, std::uint64_t count,
                                   std::string_view parts);

/// Says that the piece is done.
void print_done(const std::string& file, const PieceNote& note);

/// Whether these notes are of one piece. Files that were read do not matter.
[[nodiscard]] bool same_piece(const PieceNote& one, const PieceNote& other);

/// Throws std::runtime_error: the file holds another piece than what is asked for.
[[noreturn]] void refuse_other_piece(const std::string& file, const PieceNote& there, const PieceNote& asked);

/// Does the piece and writes its file, unless the file holds it already. Returns the exit code, which says
/// nothing of the result: --join judges it.
int run_piece(const CLI::App& parsed, const PiecesChoice& choice, const std::string& file,
              std::uint64_t count, std::string_view parts, const std::function<Row()>& result);

/// The pieces that --join names, in order. Throws what read_pieces() throws.
[[nodiscard]] std::vector<PieceFile> joined_pieces(const CLI::App& parsed, const PiecesChoice& choice);

}  // namespace hitpipe::cli
