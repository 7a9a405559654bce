// What a unit can be implemented in: a chip, or standard cells. A target says which component library drives
// the schedule, how Yosys maps the Verilog, how mapped cells are counted, how they are placed or timed, and
// which models simulate them. Each target is a data file, targets/NAME.json, that is compiled in by being
// there.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rtl_gen/board/board.hpp"
#include "sim/model/tool.hpp"

namespace hitpipe::sim {

/// The resources that a target may count, in the order in which they are printed.
inline constexpr std::string_view resource_names[] = {"luts",     "registers", "dsps",       "rams",
                                                      "lut_rams", "carries",   "logic_cells"};

struct Resource {
  std::string name;                                ///< one of resource_names
  std::vector<std::pair<std::string, int>> cells;  ///< patterns of mapped cells, and how many each takes
  std::string packed;            ///< nextpnr's name of it, where it is counted after packing
  std::optional<int> available;  ///< on the chip
};

struct Models {
  std::vector<std::string> files;  ///< Verilog; "{yosys}" stands for the data folder of Yosys
  std::vector<std::string> defines;
  std::vector<std::string> verilator_options;
};

/// A program, the Debian package that has it, and the variable that names another: for nextpnr-ice40 it is
/// $NEXTPNR_ICE40.
struct TargetProgram {
  std::string name;
  std::string package;  ///< empty: Debian 12 has none

  [[nodiscard]] std::string variable() const;
};

/// How a board's pins go into the placer, and how a bitstream comes out. An option's word is the ending of
/// its file: "--pcf" reads TOP.pcf.
struct BoardFlow {
  std::string pins_option;
  std::string pin_line;  ///< "{port}" and "{pin}" stand for what they name
  std::string placed_option;
  TargetProgram packer;   ///< its arguments are the placed file and the bitstream
  std::string bitstream;  ///< ending of its file

  [[nodiscard]] std::string pins_file(const std::string& top) const;
  [[nodiscard]] std::string placed_file(const std::string& top, int seed) const;
  [[nodiscard]] std::string bitstream_file(const std::string& top) const { return top + bitstream; }
  /// The contents of pins_file().
  [[nodiscard]] std::string pin_constraints(const rtl::Board& board) const;
};

/// One of nextpnr's programs, and how it takes a netlist of the target.
struct Placer {
  TargetProgram program;
  std::vector<std::string> options;
  std::optional<BoardFlow> board;
};

struct Target {
  std::string name;
  std::string chip;                    ///< its name in full
  std::string library;                 ///< the component library, as rtl::library_called() takes it
  std::vector<std::string> synthesis;  ///< lines for Yosys; "{top}" and "{liberty}" stand for what they name
  std::vector<std::pair<std::string, std::string>> files;  ///< that the tools read: name and contents
  std::vector<Resource> resources;
  std::string liberty;  ///< of standard cells: they have an area, OpenSTA times them
  std::string package;  ///< the Debian package of the Liberty file
  std::optional<Placer> placer;
  std::string not_placed;        ///< why it is not placed: never, or where there is no `placer` to be found
  std::optional<Models> models;  ///< without them a netlist cannot be simulated

  /// Throws std::runtime_error, one line with `origin` and the wrong entry.
  [[nodiscard]] static Target from_json(std::string_view text, const std::string& origin);
};

struct BuiltInTarget {
  std::string_view name;
  std::string_view json;
};
/// In the order of their names.
[[nodiscard]] std::span<const BuiltInTarget> built_in_targets();
[[nodiscard]] std::vector<std::string> target_names();

/// The target of a built-in name, or of a file whose name ends in .json. Throws std::runtime_error with one
/// line; for an unknown name it says which names there are.
[[nodiscard]] Target target_called(const std::string& name_or_file);

/// The programs that put Verilog into a target. They are looked for before anything long begins.
struct ChipTools {
  Tool yosys;
  std::optional<Tool> placer;  ///< where the target is placed
  std::optional<Tool> sta;     ///< where it is timed by OpenSTA
};

/// $YOSYS, the target's placer, $STA, or the programs of these names. Throws as find_tool() does; also when
/// the Liberty file is not there. A target that says why it is not placed needs no placer, unless a variable
/// names one.
[[nodiscard]] ChipTools find_chip_tools(const Target& target);

}  // namespace hitpipe::sim
