#include "rtl_gen/core/picture.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/core/axi.hpp"

namespace hitpipe::rtl {

namespace {

/// What a port belongs to, for the reader of the picture.
std::string side_of(const std::string& port) {
  if (port.starts_with("ray_")) return "rays";
  if (port.starts_with("hit_")) return "hits";
  if (port.starts_with("request_") || port.starts_with("read_")) return "memory";
  return "registers";
}

std::string block(const Part& part) {
  if (part.pipeline)
    return fmt::format("label=\"{}\\n{}\\n{} stages, II {}\" shape=box fillcolor=\"#f6d5a8\"", part.name,
                       part.design->name, part.pipeline->latency(), part.pipeline->interval());
  if (!part.graph) return fmt::format("label=\"{}\" shape=box3d fillcolor=\"#d9ead3\"", part.name);
  int memory = 0;
  for (const hls::MemoryShape& shape : part.graph->memories) memory += shape.words * shape.width;
  const std::string memories = memory == 0 ? "" : fmt::format("\\n{} bits of memory", memory);
  return fmt::format("label=\"{}{}\" shape=box fillcolor=\"#cfe3f5\"", part.name, memories);
}

/// What the pins of a channel have in common: "m_axi_ring" of m_axi_ring_arvalid.
std::string interface_of(const std::string& pin) {
  return pin.substr(0, pin.rfind('_'));
}

using Side = std::string (*)(const std::string& pin);

/// `sides` are those that are drawn first.
std::string picture(const Assembly& assembly, const std::string& title, Side side_of,
                    std::vector<std::string> sides) {
  std::map<std::pair<std::string, std::string>, int> bits;  // by the ends of an edge
  const auto end = [&](std::size_t part, std::size_t pin) {
    if (part != PinBits::outside) return std::string(assembly.parts[part].name);
    const std::string side = side_of(assembly.interface.pins[pin].name);
    if (std::ranges::find(sides, side) == sides.end()) sides.push_back(side);
    return side;
  };
  for (const Joint& joint : assembly.joints) {
    const Pin::Role role = assembly.pin(joint.part, joint.pin).role;
    if (role == Pin::Role::clock || role == Pin::Role::reset) continue;
    for (const Source::Piece& piece : joint.from.pieces)
      if (piece.bits)
        bits[{end(piece.bits->part, piece.bits->pin), end(joint.part, joint.pin)}] += piece.width;
  }
  std::string text = fmt::format(
      "digraph core {{\n"
      "  graph [rankdir=LR label=\"{}: bits between its parts\" labelloc=t "
      "fontname=\"Helvetica\" fontsize=20 nodesep=0.3 ranksep=0.6]\n"
      "  node [fontname=\"Helvetica\" fontsize=12 style=filled fillcolor=white]\n"
      "  edge [fontname=\"Helvetica\" fontsize=10 arrowsize=0.6 color=\"#555555\"]\n",
      title);
  for (const std::string& side : sides) text += fmt::format("  {} [shape=ellipse]\n", side);
  for (const Part& part : assembly.parts) text += fmt::format("  {} [{}]\n", part.name, block(part));
  for (const auto& [ends, count] : bits)
    text += fmt::format("  {} -> {} [label=\"{}\"]\n", ends.first, ends.second, count);
  return text + "}\n";
}

std::string title_of(const Core& core, const std::string& module) {
  return fmt::format("{} {}, {} rays in flight", module, to_string(Format(core.options.bits)),
                     core.options.rays);
}

}  // namespace

std::string core_picture(const Core& core) {
  return picture(assembly_of(core), title_of(core, core.module), side_of,
                 {"rays", "hits", "memory", "registers"});
}

std::string axi_picture(const Core& core) {
  return picture(behind_axi(core), title_of(core, axi_module(core)), interface_of, {});
}

}  // namespace hitpipe::rtl
