#include "cli/commands/implement_on_board.hpp"

#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/text/progress.hpp"
#include "host/files.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "sim/implement/board_implementation.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

/// To as many digits as nextpnr's result is worth.
double rounded_mhz(double mhz) {
  return std::round(mhz * 100) / 100;
}

/// Why there is no bitstream.
std::string obstacle(const sim::Implementation& chip, const rtl::Board& board) {
  if (const std::string excess = chip.excess(); !excess.empty()) return "does not fit: " + excess;
  if (chip.placed->seeds.empty()) return "does not fit: " + chip.placed->why_not;
  return fmt::format("reaches {:.2f} MHz, and the board's clock has {:.2f}", chip.placed->best().fmax_mhz,
                     board.clock_hz / 1e6);
}

}  // namespace

int implement_on_board(const DesignChoice& choice, const BoardChoice& board_choice,
                       const sim::ImplementOptions& given, Format format) {
  const rtl::Board board = board_choice.board();
  const DesignChoice unit = board_choice.unit(choice);
  const rtl::Design& design = unit.design();
  const int baud = board_choice.baud.value_or(board.baud);
  std::optional<Progress> progress;
  sim::ImplementOptions options = given;
  options.progress = [&](const std::string& step) { progress.emplace(step); };
  const sim::BoardImplementation made = sim::implement_board(design, unit.format(), board, baud, options);
  progress.reset();

  const sim::Implementation& chip = made.chip;
  const bool placed = chip.placed && !chip.placed->seeds.empty();
  Row row{{"design", design.name},   {"bits", rtl::to_string(unit.format())},
          {"board", board.name},     {"target", board.target},
          {"library", chip.library}, {"module", chip.module},
          {"latency", chip.latency}};
  for (const sim::ResourceCount& count : chip.counts) row[count.name] = count.used;
  row.update({{"seeds", placed ? Row(chip.placed->seeds.size()) : Row(nullptr)},
              {"fmax_mhz", placed ? Row(rounded_mhz(chip.placed->median().fmax_mhz)) : Row(nullptr)},
              {"fmax_best_mhz", placed ? Row(rounded_mhz(chip.placed->best().fmax_mhz)) : Row(nullptr)},
              {"clock_mhz", rounded_mhz(board.clock_hz / 1e6)},
              {"baud", baud},
              {"bitstream", made.bitstream ? Row(made.bitstream->string()) : Row(nullptr)},
              {"bitstream_bytes", made.bitstream ? Row(fs::file_size(*made.bitstream)) : Row(nullptr)},
              {"tools", fmt::format("{}", fmt::join(chip.tools, "; "))}});
  fmt::print("{}", record_text(row, format));
  if (!chip.drawn) fmt::print(stderr, "hitpipe: {}\n", rtl::not_drawn);
  if (made.bitstream) return 0;
  fmt::print(stderr, "hitpipe: {} {} on {} {}\n", design.name, rtl::to_string(unit.format()), board.name,
             obstacle(chip, board));
  return 1;
}

}  // namespace hitpipe::cli
