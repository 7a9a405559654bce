#include "rtl_gen/graph/trace.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::rtl {

namespace {

/// The last `count` components of a path, without a slash before them.
std::string_view last_components(std::string_view path, int count) {
  std::size_t start = path.size();
  for (; start > 0; --start)
    if (path[start - 1] == '/' && (--count == 0 || start == 1)) break;
  return path.substr(start);
}

}  // namespace

thread_local Graph* TraceRecorder::current_ = nullptr;

Graph& TraceRecorder::graph() {
  if (current_ == nullptr) throw std::logic_error("a Signal was used while no TraceRecorder is in scope");
  return *current_;
}

SourceLine source_line(std::string_view path, unsigned line) {
  const std::string_view of_project = last_components(path, 3);
  return {std::string(of_project.starts_with("hls/") ? of_project : last_components(path, 2)), line};
}

void check_sources(const Graph& graph, const std::vector<std::string>& headers) {
  for (NodeId id = 0; id < graph.size(); ++id) {
    const std::string& file = graph[id].source.file;
    const bool shared = file.empty() || file.starts_with("hls/num/") || file.starts_with("hls/box/") ||
                        file.ends_with("_parts.hpp");
    if (shared || std::find(headers.begin(), headers.end(), file) != headers.end()) continue;
    throw std::runtime_error(fmt::format(
        "design {}: its value {} comes from {}:{}, not from {} or a shared header; give its functions a "
        "namespace of their own, or name the other pipeline in `Shares`",
        graph.name(), graph[id].name, file, graph[id].source.line, fmt::join(headers, ", ")));
  }
  for (const auto& unit : graph.submodules()) check_sources(unit->body, headers);
}

void check_ports(const Graph& graph) {
  const auto check = [&](NodeId id, std::string_view port) {
    if (graph[id].width > most_port_bits)
      throw std::runtime_error(
          fmt::format("design {}: port {} has {} bits, allowed are 1 to {}; make it two ports", graph.name(),
                      port, graph[id].width, most_port_bits));
  };
  for (const NodeId id : graph.inputs()) check(id, graph[id].name);
  for (const Output& out : graph.outputs()) check(out.node, out.name);
}

namespace detail {

namespace {

/// The width of a in an operation with b: an unsigned operand beside a signed operand needs a zero bit on
/// top.
int exact_width(Operand a, Operand b) {
  return TraceRecorder::graph()[a.id].width + (b.is_signed && !a.is_signed ? 1 : 0);
}

NodeId binary(Op op, Operand a, Operand b, int width, bool is_signed) {
  Graph& graph = TraceRecorder::graph();
  const NodeId wide_a = graph.resize(a.id, width, a.is_signed);
  return graph.binary(op, wide_a, graph.resize(b.id, width, b.is_signed), is_signed);
}

}  // namespace

NodeId of_one_width(Op op, Operand a, Operand b, int growth) {
  return binary(op, a, b, std::max(exact_width(a, b), exact_width(b, a)) + growth, false);
}

NodeId less(Operand a, Operand b) {
  const int width = std::max(exact_width(a, b), exact_width(b, a));
  return binary(Op::less, a, b, width, a.is_signed || b.is_signed);
}

NodeId product(Operand a, Operand b) {
  Graph& graph = TraceRecorder::graph();
  const int width = graph[a.id].width + graph[b.id].width;
  // A multiplier reads both operands as signed or both as unsigned; an unsigned operand beside a signed
  // operand gains a zero bit.
  const NodeId left = graph.resize(a.id, exact_width(a, b), a.is_signed);
  const NodeId right = graph.resize(b.id, exact_width(b, a), b.is_signed);
  return graph.slice(graph.binary(Op::mul, left, right, a.is_signed || b.is_signed), width - 1, 0);
}

}  // namespace detail

}  // namespace hitpipe::rtl
