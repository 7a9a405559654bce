// The inside of a module: the logic of each stage and the registers at its end.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "rtl_gen/component/product.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module_interface.hpp"
#include "rtl_gen/verilog/names.hpp"

namespace hitpipe::rtl {

struct BodyOptions {
  std::string prefix;             ///< begins the names of component modules
  std::string enable;             ///< lets the registers load; empty: they load in every cycle
  std::set<std::string> taken{};  ///< names that are not free
  bool on_chip = false;           ///< a multiplier is a block of a chip
};

/// A unit that a body instantiates.
struct UnitUse {
  std::shared_ptr<const Unit> unit;
  int stages;  ///< 1: combinational; more: pipelined
};

class Body {
 public:
  /// The graph, schedule and placement must outlive the body.
  Body(const Graph& graph, const Schedule& schedule, const Placement& placement, BodyOptions options);

  [[nodiscard]] const std::string& text() const { return text_; }
  /// The Verilog of a value in a stage; stages + 1: behind the output latches.
  [[nodiscard]] std::string expression(NodeId value, int stage) const;
  /// The pipelined multipliers that it instantiates, and the names of their modules.
  [[nodiscard]] const std::map<MultiplierShape, std::string>& multipliers() const { return multipliers_; }
  /// The units that it instantiates, by the names of their modules.
  [[nodiscard]] const std::map<std::string, UnitUse>& units() const { return units_; }

 private:
  void write_stage(int stage);
  void write_registers(int boundary);
  void write_value(NodeId id);
  void write_multiplier(NodeId id);
  void write_unit(NodeId id);
  void write_unused();
  /// The first pins of a component with stages, each with a comma behind it.
  [[nodiscard]] std::string clock_pins() const;
  [[nodiscard]] std::string expression(NodeId value, int high, int low, int stage) const;
  [[nodiscard]] std::string bits_of(NodeId root, int high, int low, int stage) const;
  /// `wish`, with a number at its end when the name is taken.
  [[nodiscard]] std::string claim(const std::string& wish);
  [[nodiscard]] std::string wished_name(const Register& r) const;
  /// The C++ line of a value, or the line that it is for; of an operand, its port.
  [[nodiscard]] std::string source_text(NodeId id) const;
  /// "  // what, source", or nothing.
  [[nodiscard]] std::string comment(const std::string& what, NodeId id) const;
  /// The bits with which an unlatched value is declared: those of a pipelined multiplier that are read, all
  /// of any other.
  [[nodiscard]] BitSpan declared(NodeId root) const;
  [[nodiscard]] bool is_pipelined_multiplier(NodeId id) const;

  const Graph& graph_;
  const Schedule& schedule_;
  const Placement& placement_;
  BodyOptions options_;
  std::set<std::string> taken_;
  std::vector<ValueName> names_;        ///< by node
  std::vector<std::string> registers_;  ///< names, in the order of the placement
  /// By value and boundary: the places of its registers there.
  std::map<std::pair<NodeId, int>, std::vector<std::size_t>> registers_at_;
  std::map<MultiplierShape, std::string> multipliers_;
  std::map<std::string, UnitUse> units_;
  std::string text_;
};

}  // namespace hitpipe::rtl
