#include "cli/commands/board_chips.hpp"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/text/implementation_text.hpp"
#include "cli/text/progress.hpp"
#include "host/format.hpp"
#include "host/talk.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "sim/implement/board_implementation.hpp"

namespace hitpipe::cli {

namespace {

/// Why there is no bitstream.
std::string obstacle(const sim::Implementation& chip, const rtl::Board& board) {
  if (const std::string excess = chip.excess(); !excess.empty()) return "does not fit: " + excess;
  if (chip.placed->seeds.empty()) return "does not fit: " + chip.placed->why_not;
  return fmt::format("reaches {:.2f} MHz, and the board's clock has {:.2f}", chip.placed->best().fmax_mhz,
                     board.clock_hz / 1e6);
}

struct OnBoard {
  const sim::BoardImplementation& made;
  const rtl::Board& board;
  int baud;
  std::string what;  ///< name and format, for people
};

/// Prints the row and what follows from the chip. Returns the exit code.
int report(const OnBoard& on, Row row, OutputFormat format) {
  const sim::Implementation& chip = on.made.chip;
  const bool placed = chip.placed && !chip.placed->seeds.empty();
  for (const sim::ResourceCount& count : chip.counts) row[count.name] = count.used;
  const auto& bitstream = on.made.bitstream;
  row.update({{"seeds", placed ? Row(chip.placed->seeds.size()) : Row(nullptr)},
              {"fmax_mhz", placed ? rounded(chip.placed->median().fmax_mhz) : Row(nullptr)},
              {"fmax_best_mhz", placed ? rounded(chip.placed->best().fmax_mhz) : Row(nullptr)},
              {"clock_mhz", rounded(on.board.clock_hz / 1e6)},
              {"baud", on.baud},
              {"bitstream", bitstream ? Row(bitstream->string()) : Row(nullptr)},
              {"bitstream_bytes", bitstream ? Row(std::filesystem::file_size(*bitstream)) : Row(nullptr)},
              {"tools", fmt::format("{}", fmt::join(chip.tools, "; "))}});
  fmt::print("{}", record_text(row, format));
  if (!chip.drawn) host::note(std::string(rtl::not_drawn));
  if (bitstream) return 0;
  fmt::print(stderr, "hitpipe: {} on {} {}\n", on.what, on.board.name, obstacle(chip, on.board));
  return 1;
}

}  // namespace

int implement_on_board(const DesignChoice& choice, const BoardChoice& board_choice,
                       const sim::ImplementOptions& given, OutputFormat format) {
  const rtl::Board board = board_choice.board();
  const DesignChoice unit = board_choice.unit(choice);
  const rtl::Design& design = unit.design();
  const std::string bits = to_string(unit.format());
  const int baud = board_choice.baud.value_or(board.baud);
  std::optional<Progress> progress;
  sim::ImplementOptions options = given;
  options.progress = [&](const std::string& step) { progress.emplace(step); };
  const sim::BoardImplementation made = sim::implement_board(design, unit.format(), board, baud, options);
  progress.reset();
  return report({made, board, baud, fmt::format("{} {}", design.name, bits)},
                {{"design", design.name},
                 {"bits", bits},
                 {"board", board.name},
                 {"target", board.target},
                 {"library", made.chip.library},
                 {"module", made.chip.module},
                 {"latency", made.chip.latency}},
                format);
}

rtl::CoreOptions core_on_board(const rtl::Board& board, const std::optional<std::string>& bits) {
  if (!board.core)
    throw std::runtime_error(fmt::format("board {}: has no memory for the image of a core", board.name));
  rtl::CoreOptions core = *board.core;
  if (bits) core.bits = parse_bits<hls::RayBits>(*bits);
  return core;
}

int implement_core_on_board(const std::optional<std::string>& bits, const BoardChoice& board_choice,
                            const sim::ImplementOptions& given, OutputFormat format) {
  const rtl::Board board = board_choice.board();
  rtl::CoreOptions core = core_on_board(board, bits);
  if (given.clock_ps) core.clock_ps = given.clock_ps;
  const int baud = board_choice.baud.value_or(board.baud);
  std::optional<Progress> progress;
  sim::ImplementOptions options = given;
  options.progress = [&](const std::string& step) { progress.emplace(step); };
  const sim::BoardImplementation made = sim::implement_core_board(core, board, baud, options);
  progress.reset();
  const std::string text = to_string(Format(core.bits));
  return report({made, board, baud, fmt::format("core {}", text)},
                {{"core", made.chip.module},
                 {"bits", text},
                 {"rays", core.rays},
                 {"board", board.name},
                 {"target", board.target},
                 {"library", made.chip.library}},
                format);
}

}  // namespace hitpipe::cli
