// The inside of a module: the logic of each stage and the registers at its end. A component that several
// operations share stands before the stages, and the selection of its operands behind them.
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
  Binding binding{};              ///< with shared components, `phase` says which stages are at work
  bool is_step = false;           ///< a machine's: all that is computed in one cycle
};

/// A unit that a body instantiates.
struct UnitUse {
  std::shared_ptr<const Submodule> unit;
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
  /// Assignments to registers, at each clock edge at which the condition holds; an empty one always holds.
  [[nodiscard]] std::string loaded(const std::string& assignments, const std::string& condition) const;
  /// The register of this place.
  void declare(std::size_t i);
  void write_registers(int boundary);
  /// A component and what it is connected to.
  struct Connected {
    NodeId like;                        ///< it carries out operations such as this one
    std::vector<std::string> operands;  ///< Verilog expressions
    std::string result;                 ///< the wire that it drives
    BitSpan declared;                   ///< the bits of that wire
    std::string comment;                ///< "  // what", or nothing
  };
  void write_component(const Connected& c);
  void write_value(const Connected& c);
  void write_multiplier(const Connected& c);
  void write_unit(const Connected& c);
  /// One that several operations share.
  struct SharedComponent {
    std::vector<NodeId> operations;
    std::string name;                   ///< also of the wire that it drives
    std::vector<std::string> operands;  ///< registers; a constant that all operations read is none
    BitSpan declared;                   ///< the bits of that wire: all that any operation declares
  };
  [[nodiscard]] SharedComponent written_shared_component(const std::vector<NodeId>& operations);
  void write_selection(const SharedComponent& shared);
  [[nodiscard]] const SharedComponent& shared_by(NodeId id) const;
  /// Stages inside the component that carries it out; 1: combinational.
  [[nodiscard]] int stages_inside(NodeId id) const;
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
  RegisterTable table_;
  std::map<MultiplierShape, std::string> multipliers_;
  std::map<std::string, UnitUse> units_;
  std::map<int, SharedComponent> shared_;  ///< by instance
  std::string text_;
};

}  // namespace hitpipe::rtl
