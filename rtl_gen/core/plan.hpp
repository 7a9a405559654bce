// What a core is made of before its parts are scheduled: parts, what joins them, and pins. It is data. The base core
// fills it (base.cpp), and each feature that the core has changes it (feature.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hls/machines/record.hpp"
#include "host/format.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// The names of a list's fields.
template <class Fields>
inline constexpr auto field_names = []<auto... F>(hls::List<F...>) {
  return std::array<std::string_view, sizeof...(F)>{F.name()...};
}
(typename Fields::Items());

/// A channel from one machine to another. Its fields are joined in their order, but for those that one of the
/// machines does not have.
struct Link {
  using Names = std::span<const std::string_view>;

  std::string_view from, to;
  Names given, taken;            ///< outputs of the one, inputs of the other
  Names given_back, taken_back;  ///< outputs of the other, inputs of the one
};
/// The taker may have the fields of another channel, with other names.
template <class Given, class Taken = Given>
constexpr Link link(std::string_view from, std::string_view to) {
  Link made{from, to, field_names<Given>, field_names<Taken>, {}, {}};
  if constexpr (requires { typename Given::Back; }) {
    made.given_back = field_names<typename Taken::Back>;
    made.taken_back = field_names<typename Given::Back>;
  }
  return made;
}

/// From an output of a part to an input of another one. Both have one width.
struct PlannedWire {
  std::string_view from;
  std::string output;
  std::string_view to;
  std::string input;
};

/// A machine, or a unit that takes a test every `interval` cycles.
struct PlannedPart {
  std::string_view name;
  std::string_view of;  ///< the machine's or the design's name
  Format format;
  int interval = 0;  ///< of a unit, 1 or more
  FlowControl flow = FlowControl::none;
  int tag_bits = 0;  ///< of a unit: what it says again of each test

  [[nodiscard]] bool is_unit() const { return interval != 0; }
};

/// A unit between machines that know tests by the number of their ray (hls/machines/channels.hpp, Tested).
struct UnitJoins {
  std::string_view feed;  ///< has outputs with the names of its operands; or empty: another entry says it
  std::string_view unit;
  std::vector<std::string_view> takers;  ///< get its results, as far as they have inputs with their names
};
/// Each output OUT of the unit goes to every machine that has the input PREFIX_OUT.
struct Broadcast {
  std::string_view unit, prefix;
  std::vector<std::pair<std::string, std::string>> renamed;  ///< outputs, and the inputs that take them
};

/// A unit says more of each test again, above its tag.
struct Carried {
  std::string_view unit;
  std::string name;  ///< its pins are in_NAME and out_NAME
  int width;
};

/// A pin of the core, and what it tells the reader of the Verilog. An input goes to every machine that has an input of
/// this name without a wire; an output comes from its part.
struct CorePin {
  std::string name;
  bool is_input;
  std::string_view part;  ///< of an input: empty, or the only part that has it
  std::string comment;
  std::string of{};  ///< the pin of the part, if it has another name
  /// When an output means something, in Verilog, of outputs want_NAME. Empty: when its channel is valid.
  std::string meaning{};

  [[nodiscard]] CorePin named(std::string_view other) const {
    CorePin made = *this;
    made.of = std::exchange(made.name, other);
    return made;
  }
  [[nodiscard]] CorePin meant(std::string when) const {
    CorePin made = *this;
    made.meaning = std::move(when);
    return made;
  }
};
CorePin input(auto field, std::string_view comment) {
  return {std::string(field.name()), true, "", std::string(comment)};
}
CorePin output(auto field, std::string_view from, std::string_view comment) {
  return {std::string(field.name()), false, from, std::string(comment)};
}

/// What the core wants of memory.
struct CoreBus {
  int data_bits;           ///< of a beat
  int burst_bits;          ///< of a request
  bool has_one_id;         ///< all requests have one identifier
  bool has_lines = false;  ///< a request reads a line, in beats; else a block

  /// Beats in which the bus carries what a request reads; the widest has room for two blocks.
  [[nodiscard]] int beats() const { return data_bits < burst_bits ? burst_bits / data_bits : 1; }
};

struct CorePlan {
  std::vector<PlannedPart> parts;  ///< machines, then units
  std::vector<Link> links;
  std::vector<UnitJoins> units;
  std::vector<Broadcast> broadcasts;
  std::vector<Carried> carried;
  std::vector<PlannedWire> wires;
  std::vector<CorePin> pins;
  CoreBus bus;

  [[nodiscard]] bool has(std::string_view part) const {
    return std::ranges::any_of(parts, [&](const PlannedPart& each) { return each.name == part; });
  }
  // These throw std::logic_error if it is not there.
  [[nodiscard]] PlannedPart& part(std::string_view name);
  [[nodiscard]] CorePin& pin(std::string_view name);
  [[nodiscard]] UnitJoins& unit(std::string_view name);
  /// The format of a part. Throws std::logic_error if it is of another family.
  template <class Bits>
  [[nodiscard]] Bits bits(std::string_view name) {
    return checked<Bits>(name).format.template as<Bits>();
  }
  template <class Bits, class Change>
  void change(std::string_view name, const Change& how) {
    PlannedPart& part = checked<Bits>(name);
    Bits bits = part.format.template as<Bits>();
    how(bits);
    part.format = bits;
  }
  /// Puts a part behind another one.
  void add_behind(std::string_view other, const PlannedPart& part);
  /// Takes a part away, with what joins it to others.
  void remove(std::string_view part);
  void remove_link(std::string_view from, std::string_view to);
  void add_links(std::span<const Link> more) { links.insert(links.end(), more.begin(), more.end()); }
  void add_pins_behind(std::string_view other, std::vector<CorePin> more);
  using WhichPins = std::function<bool(const CorePin&)>;
  /// Puts pins where the first of these was. There must be one.
  void replace_pins(const WhichPins& which, std::vector<CorePin> by);

 private:
  template <class Bits>
  PlannedPart& checked(std::string_view name) {
    PlannedPart& found = part(name);
    if (!found.format.template is<Bits>()) wrong_family(name);
    return found;
  }
  [[noreturn]] static void wrong_family(std::string_view part);
};

}  // namespace hitpipe::rtl
