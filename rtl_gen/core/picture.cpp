#include "rtl_gen/core/picture.hpp"

#include <map>
#include <utility>

#include <fmt/format.h>

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
  int memory = 0;
  for (const hls::MemoryShape& shape : part.graph->memories) memory += shape.words * shape.width;
  const std::string memories = memory == 0 ? "" : fmt::format("\\n{} bits of memory", memory);
  return fmt::format("label=\"{}{}\" shape=box fillcolor=\"#cfe3f5\"", part.name, memories);
}

}  // namespace

std::string to_dot(const Core& core) {
  std::map<std::pair<std::string, std::string>, int> bits;  // by the ends of an edge
  for (const CoreWire& wire : core.wires) {
    const Part& from = core.parts[wire.from];
    bits[{std::string(from.name), std::string(core.parts[wire.to].name)}] +=
        from.interface.pins[wire.output].width;
  }
  for (const CorePort& port : core.ports)
    for (const CorePort::End& end : port.ends) {
      std::pair<std::string, std::string> ends{side_of(port.pin.name), core.parts[end.part].name};
      if (!port.pin.is_input) std::swap(ends.first, ends.second);
      bits[ends] += port.pin.width;
    }

  std::string text = fmt::format(
      "digraph core {{\n"
      "  graph [rankdir=LR label=\"{} {}, {} rays in flight: bits between its parts\" labelloc=t "
      "fontname=\"Helvetica\" fontsize=20 nodesep=0.3 ranksep=0.6]\n"
      "  node [fontname=\"Helvetica\" fontsize=12 style=filled fillcolor=white]\n"
      "  edge [fontname=\"Helvetica\" fontsize=10 arrowsize=0.6 color=\"#555555\"]\n",
      core.module, to_string(Format(core.options.bits)), core.options.rays);
  for (const char* const side : {"rays", "hits", "memory", "registers"})
    text += fmt::format("  {} [shape=ellipse]\n", side);
  for (const Part& part : core.parts) text += fmt::format("  {} [{}]\n", part.name, block(part));
  for (const auto& [ends, count] : bits)
    text += fmt::format("  {} -> {} [label=\"{}\"]\n", ends.first, ends.second, count);
  return text + "}\n";
}

}  // namespace hitpipe::rtl
