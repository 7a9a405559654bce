// The options of a command whose work can be cut into pieces (docs/choosing.md): --pieces N prints the
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
  /// Of a command that does all or one of them.
  [[nodiscard]] host::Piece chosen() const { return piece.value_or(host::Piece{}); }
};

/// What --out names where no piece is asked for.
enum class Output { file, folder };

/// Adds --pieces, --piece and --join, and --out, which names the folder of the pieces' files, the file of one
/// piece, or else what `what` says. Options that the command requires are not required with --join.
CLI::Option* add_pieces_options(CLI::App& command, PiecesChoice& choice, std::string& out, Output kind,
                                const std::string& what);

/// Of a command, without what does not decide its result: pieces, output, format, threads. Seeds are named.
[[nodiscard]] std::string whole_command(const CLI::App& parsed);

/// What a user asks of work that can be cut.
struct CutWork {
  const CLI::App& parsed;
  const PiecesChoice& choice;
  const std::string& out;  ///< of --out
  std::uint64_t count;     ///< of its parts
  std::string_view parts;  ///< what they are, such as "rows"
};

/// Prints a command for each piece, as a shell takes it. Its file is FOLDER/NUMBER.ENDING. Throws
/// std::runtime_error, one line, when there are fewer parts than pieces.
void print_pieces(const CutWork& work, std::string_view ending);

/// The note of the piece that is asked for, with the hashes of the files that were read so far. Throws
/// std::runtime_error as print_pieces() does, and when there is no --out.
[[nodiscard]] PieceNote piece_note(const CutWork& work);

/// `there` is the note of the file that --out names. Throws std::runtime_error when that file holds another
/// piece, or was made with other contents of the files that were read so far.
void check_same_piece(const CutWork& work, const PieceNote& there);

/// Says that the piece is done.
void print_done(const CutWork& work);

/// Prints the pieces; or does one and writes its file, unless the file holds it already; or does all.
/// `piece` gives what a piece keeps, `all` does everything and returns the exit code. The exit code of a
/// piece says nothing of its result: --join judges it.
int do_work(const CutWork& work, const std::function<Row(host::Piece)>& piece,
            const std::function<int()>& all);

/// The whole command with its output: it makes in one run what pieces are joined to.
[[nodiscard]] std::string joined_command(const std::string& whole, const std::string& out);

/// The pieces that --join names, in order. Throws what read_pieces() throws.
[[nodiscard]] std::vector<PieceFile> joined_pieces(const CLI::App& parsed, const PiecesChoice& choice);

}  // namespace hitpipe::cli
