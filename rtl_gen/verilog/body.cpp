#include "rtl_gen/verilog/body.hpp"

#include <algorithm>
#include <bit>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::rtl {

namespace {

std::string select_bits(const std::string& name, BitSpan declared, int high, int low) {
  if (declared.high == high && declared.low == low) return name;
  if (high == low) return fmt::format("{}[{}]", name, high - declared.low);
  return fmt::format("{}[{}:{}]", name, high - declared.low, low - declared.low);
}

std::string repeated(int count, const std::string& bit) {
  return count == 1 ? bit : fmt::format("{{{}{{{}}}}}", count, bit);
}

std::string_view infix(Op op) {
  switch (op) {
    case Op::bit_and:
      return "&";
    case Op::bit_or:
      return "|";
    case Op::bit_xor:
      return "^";
    case Op::add:
      return "+";
    case Op::sub:
      return "-";
    case Op::mul:
      return "*";
    case Op::less:
      return "<";
    default:
      return "==";
  }
}

}  // namespace

Body::Body(const Graph& graph, const Schedule& schedule, const Placement& placement, BodyOptions options)
    : graph_(graph), schedule_(schedule), placement_(placement), options_(std::move(options)) {
  taken_ = options_.taken;
  taken_.insert({"clk", options_.enable, "unused"});
  for (const Output& out : graph.outputs()) taken_.insert(out.name);
  for (int boundary = 0; boundary <= schedule.stages; ++boundary) {
    taken_.insert(fmt::format("tag_s{}", boundary));
  }
  names_ = value_names(graph, placement, taken_);
  for (const ValueName& value : names_) taken_.insert(value.name);
  for (std::size_t i = 0; i < placement.registers.size(); ++i) {
    const Register& r = placement.registers[i];
    registers_.push_back(claim(wished_name(r)));
    registers_at_[{r.value, r.boundary}].push_back(i);
  }

  if (std::any_of(placement.registers.begin(), placement.registers.end(),
                  [](const Register& r) { return r.boundary == 0; })) {
    text_ += "\n  // Input latches.\n";
    write_registers(0);
  }
  for (int stage = 1; stage <= schedule.stages; ++stage) write_stage(stage);
  write_unused();
}

bool Body::is_pipelined_multiplier(NodeId id) const {
  return graph_[id].op == Op::mul && schedule_.slots[id].latched;
}

BitSpan Body::declared(NodeId root) const {
  return is_pipelined_multiplier(root) ? used_span(graph_, placement_, root)
                                       : BitSpan{graph_[root].width - 1, 0};
}

std::string Body::source_text(NodeId id) const {
  if (graph_[id].op == Op::input) return "port " + graph_[id].name;
  const ValueName& value = names_[id];
  if (value.source.line == 0) return "";
  return fmt::format("{}{}:{}", value.is_own ? "" : "for ", value.source.file, value.source.line);
}

std::string Body::comment(const std::string& what, NodeId id) const {
  const std::string source = source_text(id);
  if (what.empty() && source.empty()) return "";
  return fmt::format("  // {}{}{}", what, what.empty() || source.empty() ? "" : ", ", source);
}

std::string Body::claim(const std::string& wish) {
  std::string name = wish;
  for (int i = 2; !taken_.insert(name).second; ++i) name = fmt::format("{}_{}", wish, i);
  return name;
}

std::string Body::wished_name(const Register& r) const {
  const BitSpan whole = used_span(graph_, placement_, r.value);
  const std::string& name = names_[r.value].name;
  if (r.high == whole.high && r.low == whole.low) return fmt::format("{}_s{}", name, r.boundary);
  if (r.high == r.low && r.high == graph_[r.value].width - 1)
    return fmt::format("{}_sign_s{}", name, r.boundary);
  return fmt::format("{}_{}_{}_s{}", name, r.high, r.low, r.boundary);
}

std::string Body::bits_of(NodeId root, int high, int low, int stage) const {
  const auto found = registers_at_.find({root, stage - 1});
  if (found != registers_at_.end()) {
    for (const std::size_t i : found->second) {
      const Register& r = placement_.registers[i];
      if (r.low <= low && r.high >= high) return select_bits(registers_[i], {r.high, r.low}, high, low);
    }
  }
  return select_bits(names_[root].name, declared(root), high, low);
}

std::string Body::expression(NodeId value, int stage) const {
  return expression(value, graph_[value].width - 1, 0, stage);
}

std::string Body::expression(NodeId value, int high, int low, int stage) const {
  const Node& n = graph_[value];
  const int width = high - low + 1;
  switch (n.op) {
    case Op::constant:
      return fmt::format("{}'h{:x}", width, n.value >> low & bit_range(width - 1, 0));
    case Op::slice:
      return expression(n.args[0], n.low + high, n.low + low, stage);
    case Op::invert:
      return fmt::format("~{}", expression(n.args[0], high, low, stage));
    case Op::concat: {
      const int split = graph_[n.args[1]].width;
      if (high < split) return expression(n.args[1], high, low, stage);
      if (low >= split) return expression(n.args[0], high - split, low - split, stage);
      return fmt::format("{{{}, {}}}", expression(n.args[0], high - split, 0, stage),
                         expression(n.args[1], split - 1, low, stage));
    }
    case Op::extend: {
      const int source = graph_[n.args[0]].width;
      if (high < source) return expression(n.args[0], high, low, stage);
      const int extra = high - std::max(low, source) + 1;
      if (!n.is_signed) {
        const std::string zeros = fmt::format("{}'d0", extra);
        if (low >= source) return zeros;
        return fmt::format("{{{}, {}}}", zeros, expression(n.args[0], source - 1, low, stage));
      }
      const std::string sign = expression(n.args[0], source - 1, source - 1, stage);
      if (low >= source) return repeated(extra, sign);
      if (low == source - 1) return repeated(extra + 1, sign);
      return fmt::format("{{{}, {}}}", repeated(extra, sign), expression(n.args[0], source - 1, low, stage));
    }
    default:
      return bits_of(value, high, low, stage);
  }
}

void Body::write_value(NodeId id) {
  const Node& n = graph_[id];
  const int stage = schedule_.slots[id].stage;
  const auto arg = [&](std::size_t i) {
    const std::string value = expression(n.args[i], stage);
    // A product is wider than its operands: Verilog would extend them before it inverts them.
    return n.op == Op::mul && value.starts_with('~') ? fmt::format("{{{}}}", value) : value;
  };
  std::string right;
  if (n.op == Op::mux) {
    right = fmt::format("{} ? {} : {}", arg(0), arg(1), arg(2));
  } else {
    const bool reads_sign = n.is_signed && (n.op == Op::mul || n.op == Op::less);
    const std::string_view form = reads_sign ? "$signed({}) {} $signed({})" : "{} {} {}";
    right = fmt::format(fmt::runtime(form), arg(0), infix(n.op), arg(1));
  }
  text_ +=
      fmt::format("  wire {}{} = {};{}\n", vector_range(n.width), names_[id].name, right, comment("", id));
}

std::string Body::clock_pins() const {
  return options_.enable.empty() ? ".clk(clk), " : fmt::format(".clk(clk), .en({}), ", options_.enable);
}

void Body::write_multiplier(NodeId id) {
  const Node& n = graph_[id];
  const Slot& slot = schedule_.slots[id];
  const BitSpan used = declared(id);
  const MultiplierShape shape{.width_a = graph_[n.args[0]].width,
                              .width_b = graph_[n.args[1]].width,
                              .is_signed = n.is_signed,
                              .stages = slot.finish - slot.stage + 1,
                              .high = used.high,
                              .low = used.low,
                              .in_block = options_.on_chip};
  const std::string base = fmt::format("{}_mul_{}x{}{}_to_{}_{}", options_.prefix, shape.width_a,
                                       shape.width_b, shape.is_signed ? "s" : "u", shape.high, shape.low);
  const std::string& module = multipliers_.try_emplace(shape, base).first->second;
  const std::string clocked = shape.stages > 1 ? clock_pins() : "";
  const std::string& name = names_[id].name;
  const std::string what = fmt::format("bits {}:{}, there in stage {}", used.high, used.low, slot.finish);
  text_ += fmt::format("  wire {}{};{}\n", vector_range(used.width()), name, comment(what, id));
  text_ += fmt::format("  {} {} ({}.a({}), .b({}), .p({}));\n", module, claim("mul_" + name), clocked,
                       expression(n.args[0], slot.stage), expression(n.args[1], slot.stage), name);
}

void Body::write_unit(NodeId id) {
  const Slot& slot = schedule_.slots[id];
  const std::shared_ptr<const Unit>& unit = graph_.unit_of(id);
  const Graph& body = unit->body;
  const std::string module = fmt::format("{}_{}", options_.prefix, body.name());
  const UnitUse use{unit, slot.finish - slot.stage + 1};
  units_.try_emplace(module, use);
  std::string operands;
  for (std::size_t i = 0; i < body.inputs().size(); ++i) {
    operands +=
        fmt::format(".{}({}), ", body[body.inputs()[i]].name, expression(graph_[id].args[i], slot.stage));
  }
  const std::string clocked = use.stages > 1 ? clock_pins() : "";
  const std::string& name = names_[id].name;
  text_ += fmt::format("  wire {}{};{}\n", vector_range(graph_[id].width), name,
                       comment(fmt::format("there in stage {}", slot.finish), id));
  text_ += fmt::format("  {} {} ({}{}.{}({}));\n", module, claim(fmt::format("{}_{}", unit->component, name)),
                       clocked, operands, body.outputs().front().name, name);
}

void Body::write_registers(int boundary) {
  std::string load;
  for (std::size_t i = 0; i < placement_.registers.size(); ++i) {
    const Register& r = placement_.registers[i];
    if (r.boundary != boundary) continue;
    const std::string& name = registers_[i];
    text_ += fmt::format("  reg {}{};{}\n", vector_range(r.width()), name,
                         comment(fmt::format("stage {}", boundary), r.value));
    load += fmt::format("{}{} <= {};\n", options_.enable.empty() ? "    " : "      ", name,
                        bits_of(r.value, r.high, r.low, boundary));
  }
  if (load.empty()) return;
  if (!options_.enable.empty()) load = fmt::format("    if ({}) begin\n{}    end\n", options_.enable, load);
  text_ += fmt::format("  always @(posedge clk) begin\n{}  end\n", load);
}

void Body::write_stage(int stage) {
  text_ += fmt::format("\n  // Stage {}.\n", stage);
  for (NodeId id = 0; id < graph_.size(); ++id) {
    if (!is_root(graph_[id].op) || graph_[id].op == Op::input || schedule_.slots[id].stage != stage) continue;
    if (is_pipelined_multiplier(id)) {
      write_multiplier(id);
    } else if (graph_[id].op == Op::call) {
      write_unit(id);
    } else {
      write_value(id);
    }
  }
  write_registers(stage);
}

void Body::write_unused() {
  std::vector<std::string> unused;
  const auto add = [&](const std::string& name, BitSpan span, std::uint64_t rest) {
    while (rest != 0) {
      const int low = std::countr_zero(rest);
      const int high = low + std::countr_one(rest >> low) - 1;
      unused.push_back(select_bits(name, span, high, low));
      rest &= ~bit_range(high, low);
    }
  };
  for (NodeId id = 0; id < graph_.size(); ++id) {
    if (!is_root(graph_[id].op)) continue;
    const BitSpan span = declared(id);
    add(names_[id].name, span, bit_range(span.high, span.low) & ~placement_.used_bits[id]);
  }
  for (std::size_t i = 0; i < placement_.registers.size(); ++i) {
    const Register& r = placement_.registers[i];
    add(registers_[i], {r.high, r.low}, r.unread);
  }
  if (unused.empty()) return;
  text_ +=
      fmt::format("\n  // Not read on purpose.\n  wire unused = &{{1'b0, {}}};\n", fmt::join(unused, ", "));
}

}  // namespace hitpipe::rtl
