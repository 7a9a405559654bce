#include "rtl_gen/part/assembly.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::rtl {

namespace {

std::string bits_of(const std::string& word, int word_width, int low, int width) {
  if (width == word_width) return word;
  return width == 1 ? fmt::format("{}[{}]", word, low) : fmt::format("{}[{}:{}]", word, low + width - 1, low);
}

/// Calls use(bits) with all that a source reads.
template <class Use>
void for_each_read(const Source& source, const Use& use) {
  for (const Source::Piece& piece : source.pieces)
    if (piece.bits) use(*piece.bits);
  for (const Gate& gate : source.gates) {
    use(gate.bits);
    if (gate.equals) use(*gate.equals);
  }
}

class Text {
 public:
  explicit Text(const Assembly& assembly) : of_(assembly) {}

  [[nodiscard]] std::string whole() const {
    std::string text = of_.interface.head() + "\n" + nets() + "\n";
    for (std::size_t i = 0; i < of_.parts.size(); ++i) text += instance(i) + "\n";
    for (const Joint& joint : of_.joints)
      if (joint.part == PinBits::outside)
        text +=
            fmt::format("  assign {} = {};\n", of_.interface.pins[joint.pin].name, expression(joint.from));
    if (const std::vector<std::string> unused = unused_bits(of_); !unused.empty())
      text += fmt::format("\n  wire unused = &{{1'b0, {}}};\n", fmt::join(unused, ", "));
    return text + "endmodule\n";
  }

 private:
  [[nodiscard]] std::string name(std::size_t part, std::size_t pin) const {
    const Pin& of = of_.pin(part, pin);
    return part == PinBits::outside ? of.name : fmt::format("{}_{}", of_.parts[part].name, of.name);
  }
  [[nodiscard]] std::string text(const PinBits& bits) const {
    return bits_of(name(bits.part, bits.pin), of_.pin(bits.part, bits.pin).width, bits.low, bits.width);
  }
  [[nodiscard]] std::string text(const Gate& gate) const {
    if (gate.equals) return fmt::format("({} == {})", text(gate.bits), text(*gate.equals));
    return (gate.inverted ? "~" : "") + text(gate.bits);
  }
  [[nodiscard]] std::string expression(const Source& source) const {
    std::vector<std::string> all;  // the highest first
    for (auto piece = source.pieces.rbegin(); piece != source.pieces.rend(); ++piece)
      all.push_back(piece->bits ? text(*piece->bits)
                                : fmt::format("{}'h{:x}", piece->width, piece->constant));
    std::string made = all.size() == 1 ? all[0] : fmt::format("{{{}}}", fmt::join(all, ", "));
    std::vector<std::string> gates;
    for (const Gate& gate : source.gates) gates.push_back(text(gate));
    // A gate of a constant 1 is all there is.
    if (!gates.empty() && source.pieces[0].bits) gates.insert(gates.begin(), made);
    if (!gates.empty()) made = fmt::format("{}", fmt::join(gates, " & "));
    return source.inverted ? (gates.size() > 1 ? "~(" + made + ")" : "~" + made) : made;
  }
  [[nodiscard]] std::string nets() const {
    std::string text;
    for (std::size_t i = 0; i < of_.parts.size(); ++i) {
      const std::vector<Pin>& pins = of_.parts[i].interface.pins;
      for (std::size_t pin = 0; pin < pins.size(); ++pin)
        if (!pins[pin].is_input)
          text += fmt::format("  wire {}{};\n", vector_range(pins[pin].width), name(i, pin));
    }
    // What is more than a net has one of its own.
    for (const Joint& joint : of_.joints)
      if (joint.part != PinBits::outside && has_net(joint))
        text += fmt::format("  wire {}{} = {};\n", vector_range(of_.pin(joint.part, joint.pin).width),
                            name(joint.part, joint.pin), expression(joint.from));
    return text;
  }
  static bool has_net(const Joint& joint) { return !joint.from.gates.empty() || joint.from.inverted; }
  [[nodiscard]] std::string connected(std::size_t part, std::size_t pin) const {
    if (!of_.pin(part, pin).is_input) return name(part, pin);
    const auto joint = std::ranges::find_if(
        of_.joints, [&](const Joint& each) { return each.part == part && each.pin == pin; });
    return has_net(*joint) ? name(part, pin) : expression(joint->from);
  }
  [[nodiscard]] std::string instance(std::size_t place) const {
    const Part& part = of_.parts[place];
    const std::vector<Pin>& pins = part.interface.pins;
    std::vector<std::string> connections;
    int tag_bits = 0;
    for (const bool is_input : {true, false}) {
      std::vector<std::string> tags;  // the last is above
      tag_bits = 0;
      for (std::size_t i = 0; i < pins.size(); ++i) {
        if (part.design == nullptr || pins[i].role != Pin::Role::tag || pins[i].is_input != is_input)
          continue;
        tags.insert(tags.begin(), connected(place, i));
        tag_bits += pins[i].width;
      }
      if (!tags.empty())
        connections.push_back(
            fmt::format("    .{}({{{}}})", is_input ? "in_tag" : "out_tag", fmt::join(tags, ", ")));
    }
    for (std::size_t i = 0; i < pins.size(); ++i)
      if (part.design == nullptr || pins[i].role != Pin::Role::tag)
        connections.push_back(fmt::format("    .{}({})", pins[i].name, connected(place, i)));
    const std::string parameters = tag_bits == 0 ? "" : fmt::format(" #(.TAG_BITS({}))", tag_bits);
    return fmt::format("  {}{} {} (\n{}\n  );\n", part.interface.module, parameters, part.name,
                       fmt::join(connections, ",\n"));
  }

  const Assembly& of_;
};

}  // namespace

int Source::width() const {
  return std::accumulate(pieces.begin(), pieces.end(), 0,
                         [](int sum, const Piece& piece) { return sum + piece.width; });
}

const Source* Assembly::source_of(std::size_t part, std::size_t pin) const {
  const auto joint =
      std::ranges::find_if(joints, [&](const Joint& each) { return each.part == part && each.pin == pin; });
  return joint == joints.end() ? nullptr : &joint->from;
}

std::vector<std::string> verify(const Assembly& assembly) {
  std::vector<std::string> broken;
  const auto name = [&](std::size_t part, std::size_t pin) {
    return fmt::format("{}.{}",
                       part == PinBits::outside ? assembly.interface.module : assembly.parts[part].name,
                       assembly.pin(part, pin).name);
  };
  std::map<std::pair<std::size_t, std::size_t>, int> driven;
  for (const Joint& joint : assembly.joints) {
    const Pin& to = assembly.pin(joint.part, joint.pin);
    ++driven[{joint.part, joint.pin}];
    if (to.is_input == (joint.part == PinBits::outside))
      broken.push_back(name(joint.part, joint.pin) + ": it is not driven from here");
    if (joint.from.width() != to.width)
      broken.push_back(fmt::format("{}: it has {} bits, and what drives it {}", name(joint.part, joint.pin),
                                   to.width, joint.from.width()));
    if ((!joint.from.gates.empty() || joint.from.inverted) && to.width != 1)
      broken.push_back(name(joint.part, joint.pin) + ": a gate has one bit");
    for_each_read(joint.from, [&](const PinBits& bits) {
      const Pin& from = assembly.pin(bits.part, bits.pin);
      if (from.is_input != (bits.part == PinBits::outside))
        broken.push_back(
            fmt::format("{}: {} gives nothing", name(joint.part, joint.pin), name(bits.part, bits.pin)));
      if (bits.low < 0 || bits.low + bits.width > from.width)
        broken.push_back(fmt::format("{}: {} has {} bits", name(joint.part, joint.pin),
                                     name(bits.part, bits.pin), from.width));
    });
  }
  const auto expect = [&](std::size_t part, const std::vector<Pin>& pins, bool inputs) {
    for (std::size_t pin = 0; pin < pins.size(); ++pin)
      if (const int times = driven[{part, pin}]; pins[pin].is_input == inputs && times != 1)
        broken.push_back(fmt::format("{}: it is driven {} times", name(part, pin), times));
  };
  for (std::size_t i = 0; i < assembly.parts.size(); ++i) expect(i, assembly.parts[i].interface.pins, true);
  expect(PinBits::outside, assembly.interface.pins, false);
  return broken;
}

std::vector<std::string> unused_bits(const Assembly& assembly) {
  std::map<std::size_t, std::vector<bool>> used;
  std::set<std::pair<std::size_t, std::size_t>> read;
  for (const Joint& joint : assembly.joints)
    for_each_read(joint.from, [&](const PinBits& bits) {
      read.insert({bits.part, bits.pin});
      if (bits.part != PinBits::outside) return;
      std::vector<bool>& all = used[bits.pin];
      all.resize(static_cast<std::size_t>(assembly.interface.pins[bits.pin].width));
      std::fill_n(all.begin() + bits.low, bits.width, true);
    });
  std::vector<std::string> unused;
  for (std::size_t i = 0; i < assembly.interface.pins.size(); ++i) {
    const Pin& pin = assembly.interface.pins[i];
    if (!pin.is_input) continue;
    std::vector<bool> all = used[i];
    all.resize(static_cast<std::size_t>(pin.width));
    for (int low = 0; low < pin.width;) {
      int high = low;
      const bool is = all[static_cast<std::size_t>(low)];
      while (high < pin.width && all[static_cast<std::size_t>(high)] == is) ++high;
      if (!is) unused.push_back(bits_of(pin.name, pin.width, low, high - low));
      low = high;
    }
  }
  for (std::size_t i = 0; i < assembly.parts.size(); ++i)
    for (std::size_t pin = 0; pin < assembly.parts[i].interface.pins.size(); ++pin)
      if (const Pin& of = assembly.parts[i].interface.pins[pin]; !of.is_input && !read.contains({i, pin}))
        unused.push_back(fmt::format("{}_{}", assembly.parts[i].name, of.name));
  return unused;
}

std::string module_text(const Assembly& assembly) {
  return Text(assembly).whole();
}

}  // namespace hitpipe::rtl
