#include "rtl_gen/component/library.hpp"

#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/component/thesis_250nm.hpp"

namespace hitpipe::rtl {

namespace {

constexpr std::array<std::string_view, component_count> names{"latch", "mux2", "int_subtract", "int_multiply",
                                                              "int_compare"};

int tree_depth(int bits) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(bits - 1)));
}

Above above_from(const std::string& law, std::string_view origin, std::string_view component) {
  if (law == "same") return Above::same;
  if (law == "tree") return Above::tree;
  if (law == "stages") return Above::stages;
  throw std::runtime_error(
      fmt::format("{}: {}: \"above\" is \"{}\", allowed are same, tree, stages", origin, component, law));
}

}  // namespace

std::string_view component_name(Component component) {
  return names[static_cast<std::size_t>(component)];
}

Library Library::from_json(std::string_view text, std::string_view origin) {
  Library library;
  try {
    const auto json = nlohmann::json::parse(text);
    library.name_ = json.at("name").get<std::string>();
    library.gate_delay_ps_ = json.at("gate_delay_ps").get<int>();
    if (library.gate_delay_ps_ < 1) {
      throw std::runtime_error(fmt::format("{}: gate_delay_ps must be at least 1", origin));
    }
    for (std::size_t i = 0; i < component_count; ++i) {
      const auto& entry = json.at("components").at(std::string(names[i]));
      Family& family = library.families_[i];
      family.above = above_from(entry.at("above").get<std::string>(), origin, names[i]);
      for (const auto& row : entry.at("cells")) {
        family.cells.push_back({.bits = row.at("bits").get<int>(),
                                .area_um2 = row.at("area_um2").get<int>(),
                                .delay_ps = row.at("delay_ps").get<int>(),
                                .stages = row.at("stages").get<int>(),
                                .estimated = row.value("estimated", false)});
        const Cell& cell = family.cells.back();
        if (cell.bits < 1 || cell.area_um2 < 0 || cell.delay_ps < 1 || cell.stages < 0) {
          throw std::runtime_error(
              fmt::format("{}: {}:{}: bits and delay_ps must be at least 1, area_um2 and stages at least 0",
                          origin, names[i], cell.bits));
        }
      }
      if (family.cells.empty()) throw std::runtime_error(fmt::format("{}: {}: no cells", origin, names[i]));
      const auto wider = [](const Cell& a, const Cell& b) { return a.bits >= b.bits; };
      if (std::adjacent_find(family.cells.begin(), family.cells.end(), wider) != family.cells.end()) {
        throw std::runtime_error(
            fmt::format("{}: {}: cells must be in ascending order of bits", origin, names[i]));
      }
      if (family.above == Above::tree && family.cells.back().bits < 2) {
        throw std::runtime_error(
            fmt::format("{}: {}: \"tree\" needs a cell of at least 2 bits", origin, names[i]));
      }
    }
  } catch (const nlohmann::json::exception& e) {
    throw std::runtime_error(fmt::format("{}: not a component library: {}", origin, e.what()));
  }
  return library;
}

Library Library::load(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot read the component library", file.string()));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return from_json(text, file.string());
}

const Library& Library::thesis() {
  static const Library library = from_json(thesis_250nm_json, "thesis_250nm.json");
  return library;
}

Cell Library::timing(Component component, int bits) const {
  const Family& family = families_[static_cast<std::size_t>(component)];
  for (const Cell& cell : family.cells) {
    if (cell.bits >= bits) return cell;
  }
  Cell cell = family.cells.back();
  switch (family.above) {
    case Above::same:
      break;
    case Above::tree:
      // Rounded up: a longer tree is never faster.
      cell.delay_ps = (cell.delay_ps * tree_depth(bits) + tree_depth(cell.bits) - 1) / tree_depth(cell.bits);
      break;
    case Above::stages:
      cell.stages = (bits * cell.stages + cell.bits - 1) / cell.bits;
      break;
  }
  cell.estimated = true;
  return cell;
}

bool is_component(Op op) {
  return op == Op::add || op == Op::sub || op == Op::mul || op == Op::less || op == Op::equal ||
         op == Op::mux;
}

ComponentUse component_of(const Graph& graph, NodeId node) {
  const Node& n = graph[node];
  const auto operand = [&](std::size_t i) { return graph[n.args[i]].width; };
  switch (n.op) {
    case Op::add:  // the thesis lists subtractors only; an adder is the same carry tree
    case Op::sub:
      return {Component::int_subtract, n.width};
    case Op::mul:
      return {Component::int_multiply, std::max(operand(0), operand(1))};
    case Op::less:
    case Op::equal:
      return {Component::int_compare, operand(0)};
    case Op::mux:
      return {Component::mux2, n.width};
    default:
      throw std::logic_error(fmt::format("{} is not a component", op_name(n.op)));
  }
}

Cell timing_of(const Graph& graph, NodeId node, const Library& library) {
  if (is_component(graph[node].op)) {
    const ComponentUse use = component_of(graph, node);
    return library.timing(use.component, use.bits);
  }
  return {.bits = graph[node].width, .delay_ps = library.gate_delay_ps()};
}

}  // namespace hitpipe::rtl
