// The pins of an emitted module, as one value. The head of the module, an instance of it, its manifest, and
// the testbench and programs that drive it are written from this value. A wrapper maps the interface of the
// module that it contains to its own.
#pragma once

#include <array>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/catalogue/port.hpp"

namespace hitpipe::rtl {

/// Whether a pipeline can wait.
enum class FlowControl {
  stall,  ///< valid and ready on both sides: while a result waits, the whole pipeline stands still
  none,   ///< nothing waits: a test's result comes out `latency` cycles after it. Valid alone, unless the
          ///< unit takes tests in some cycles only
};
/// In the order of the enumeration.
inline constexpr std::array<std::string_view, 2> flow_control_names{"stall", "none"};
[[nodiscard]] constexpr std::string_view flow_control_name(FlowControl flow) {
  return flow_control_names[static_cast<std::size_t>(flow)];
}

/// "[7:0] ", or nothing for one bit.
[[nodiscard]] std::string vector_range(int width);

/// The range of a tag. With TAG_BITS = 0 it has one bit, which nobody needs to connect.
inline constexpr std::string_view tag_range = "[(TAG_BITS > 0 ? TAG_BITS : 1)-1:0]";

/// The channels of a unit: tests go in, results come out. A wrapper may have others.
inline const std::string tests_channel = "in";
inline const std::string results_channel = "out";

struct Pin {
  /// Data of a channel move at an edge with its valid and its ready high; without a ready pin, whenever valid
  /// is.
  enum class Role { clock, reset, enable, valid, ready, tag, data };

  std::string name;
  Role role;
  std::string channel;  ///< empty for clock, reset and enable
  bool is_input;
  int width = 1;  ///< tag_width: as many bits as the parameter TAG_BITS says, at least one
  bool is_signed = false;
  std::string comment{};  ///< for the reader of the Verilog; may be empty

  static constexpr int tag_width = 0;
};

struct ModuleInterface {
  std::string module;
  std::vector<Pin> pins;  ///< in the order of the Verilog
  int interval = 1;       ///< a test may begin every so many cycles

  /// Whether the channel has a ready pin.
  [[nodiscard]] bool has_ready(std::string_view channel) const;
  [[nodiscard]] FlowControl flow_control() const {
    return has_ready(results_channel) ? FlowControl::stall : FlowControl::none;
  }
  /// The channels that are neither tests nor results.
  [[nodiscard]] std::vector<std::string> more_channels() const;
  /// The data pins of a channel: of a unit the operands, and the results.
  [[nodiscard]] std::vector<Port> data(std::string_view channel) const;
  [[nodiscard]] std::vector<Port> operands() const { return data(tests_channel); }
  [[nodiscard]] std::vector<Port> results() const { return data(results_channel); }

  /// "module NAME #(...) (...);" with a line for each pin.
  [[nodiscard]] std::string head() const;
  /// What a pin of an instance is connected to.
  using Wire = std::function<std::string(const Pin&)>;
  [[nodiscard]] std::string instance(const std::string& name, const std::string& tag_bits,
                                     const Wire& wire) const;
  /// ".in_valid(...), .in_ready(...), .in_tag(...)": the pins of these channels but data.
  [[nodiscard]] std::string control_connections(std::initializer_list<std::string_view> channels,
                                                const Wire& wire) const;
  [[nodiscard]] std::string data_connections(const Wire& wire) const;
};

/// Adds a data pin for each port.
void add_data(std::vector<Pin>& pins, const std::string& channel, bool is_input,
              const std::vector<Port>& ports);

/// The interface of a unit: clk, rst, in_valid, in_ready, in_tag, out_valid, out_ready, out_tag, operands and
/// results. Without flow control there is no out_ready, and in_ready only with an interval of more than a
/// cycle.
[[nodiscard]] ModuleInterface unit_interface(const std::string& module, const std::vector<Port>& operands,
                                             const std::vector<Port>& results, FlowControl flow,
                                             int interval = 1);

/// Throws std::runtime_error, one line, when a data pin of `unit` has the name of another pin of the wrapper
/// around it or of one of `inside`, which the wrapper's text declares.
void check_names(const ModuleInterface& wrapper, const ModuleInterface& unit,
                 std::initializer_list<std::string_view> inside);

}  // namespace hitpipe::rtl
