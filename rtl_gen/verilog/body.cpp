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
    : graph_(graph),
      schedule_(schedule),
      placement_(placement),
      options_(std::move(options)),
      table_(placement, options_.binding.interval) {
  taken_ = options_.taken;
  taken_.insert({"clk", options_.enable, "unused"});
  for (const Output& out : graph.outputs()) taken_.insert(out.name);
  for (int boundary = 0; boundary <= schedule.stages; ++boundary) {
    taken_.insert(fmt::format("tag_s{}", boundary));
  }
  names_ = value_names(graph, placement, taken_);
  for (const ValueName& value : names_) taken_.insert(value.name);
  const auto instances = options_.binding.instances();
  if (!instances.empty()) text_ += "\n  // Components that several operations share.\n";
  for (const auto& [instance, operations] : instances)
    shared_[instance] = written_shared_component(operations);
  for (const Register& r : placement.registers) registers_.push_back(claim(wished_name(r)));
  // An earlier stage than the register's own may read it.
  for (std::size_t i = 0; i < placement.registers.size(); ++i)
    if (placement.registers[i].is_shared()) declare(i);
  if (std::any_of(placement.registers.begin(), placement.registers.end(),
                  [](const Register& r) { return r.boundary == 0; })) {
    text_ += "\n  // Input latches.\n";
    write_registers(0);
  }
  for (int stage = 1; stage <= schedule.stages; ++stage) write_stage(stage);
  for (const auto& [instance, shared] : shared_) write_selection(shared);
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

const Body::SharedComponent& Body::shared_by(NodeId id) const {
  return shared_.at(options_.binding.instance_of.at(id));
}

std::string Body::wished_name(const Register& r) const {
  if (r.is_shared()) return shared_by(r.value).name + "_result";
  const BitSpan whole = used_span(graph_, placement_, r.value);
  const std::string& name = names_[r.value].name;
  if (r.high == whole.high && r.low == whole.low) return fmt::format("{}_s{}", name, r.boundary);
  if (r.high == r.low && r.high == graph_[r.value].width - 1)
    return fmt::format("{}_sign_s{}", name, r.boundary);
  return fmt::format("{}_{}_{}_s{}", name, r.high, r.low, r.boundary);
}

std::string Body::bits_of(NodeId root, int high, int low, int stage) const {
  if (const auto found = table_.find(root, high, low, stage)) {
    const Register& r = placement_.registers[*found];
    return select_bits(registers_[*found], {r.high, r.low}, high, low);
  }
  if (options_.binding.shares(root)) {
    const SharedComponent& shared = shared_by(root);
    return select_bits(shared.name, shared.declared, high, low);
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

int Body::stages_inside(NodeId id) const {
  const Slot& slot = schedule_.slots[id];
  return slot.finish - slot.stage + (options_.binding.shares(id) ? 0 : 1);
}

void Body::write_component(const Connected& c) {
  if (is_pipelined_multiplier(c.like)) {
    write_multiplier(c);
  } else if (graph_[c.like].op == Op::call) {
    write_unit(c);
  } else {
    write_value(c);
  }
}

void Body::write_value(const Connected& c) {
  const Node& n = graph_[c.like];
  const auto arg = [&](std::size_t i) {
    const std::string& value = c.operands[i];
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
  text_ += fmt::format("  wire {}{} = {};{}\n", vector_range(n.width), c.result, right, c.comment);
}

std::string Body::clock_pins() const {
  return options_.enable.empty() ? ".clk(clk), " : fmt::format(".clk(clk), .en({}), ", options_.enable);
}

void Body::write_multiplier(const Connected& c) {
  const Node& n = graph_[c.like];
  const MultiplierShape shape{.width_a = graph_[n.args[0]].width,
                              .width_b = graph_[n.args[1]].width,
                              .is_signed = n.is_signed,
                              .stages = stages_inside(c.like),
                              .high = c.declared.high,
                              .low = c.declared.low,
                              .in_block = options_.on_chip};
  const std::string base = fmt::format("{}_mul_{}x{}{}_to_{}_{}", options_.prefix, shape.width_a,
                                       shape.width_b, shape.is_signed ? "s" : "u", shape.high, shape.low);
  const std::string& module = multipliers_.try_emplace(shape, base).first->second;
  const std::string clocked = shape.stages > 1 ? clock_pins() : "";
  text_ += fmt::format("  wire {}{};{}\n", vector_range(c.declared.width()), c.result, c.comment);
  text_ += fmt::format("  {} {} ({}.a({}), .b({}), .p({}));\n", module, claim("mul_" + c.result), clocked,
                       c.operands[0], c.operands[1], c.result);
}

void Body::write_unit(const Connected& c) {
  const std::shared_ptr<const Submodule>& unit = graph_.submodule_of(c.like);
  const Graph& body = unit->body;
  const std::string module = fmt::format("{}_{}", options_.prefix, body.name());
  const UnitUse use{unit, stages_inside(c.like)};
  units_.try_emplace(module, use);
  std::string operands;
  for (std::size_t i = 0; i < body.inputs().size(); ++i)
    operands += fmt::format(".{}({}), ", body[body.inputs()[i]].name, c.operands[i]);
  const std::string clocked = use.stages > 1 ? clock_pins() : "";
  text_ += fmt::format("  wire {}{};{}\n", vector_range(graph_[c.like].width), c.result, c.comment);
  text_ +=
      fmt::format("  {} {} ({}{}.{}({}));\n", module, claim(fmt::format("{}_{}", unit->component, c.result)),
                  clocked, operands, body.outputs().front().name, c.result);
}

Body::SharedComponent Body::written_shared_component(const std::vector<NodeId>& operations) {
  const Node& n = graph_[operations.front()];
  SharedComponent shared{
      .operations = operations, .name = {}, .operands = {}, .declared = {0, most_value_bits}};
  std::vector<std::string> names, uses;
  for (const NodeId id : operations) {
    const BitSpan span = declared(id);
    shared.declared = {std::max(shared.declared.high, span.high), std::min(shared.declared.low, span.low)};
    names.push_back(names_[id].name);
    uses.push_back(fmt::format("{} (reads in stage {})", names_[id].name, schedule_.slots[id].stage));
  }
  const bool is_unit = n.op == Op::call;
  std::string wish =
      fmt::format("shared_{}", is_unit ? std::string_view(graph_.submodule_of(operations.front())->component)
                                       : op_name(n.op));
  if (const std::string common = shared_name(names); !common.empty()) wish += "_" + common;
  shared.name = claim(wish);
  text_ += fmt::format("  // {}, for {}.\n", shared.name, fmt::join(uses, ", "));
  for (std::size_t i = 0; i < n.operands().size(); ++i) {
    if (!is_selected(graph_, operations, i)) {
      shared.operands.push_back(expression(n.args[i], 0));
      continue;
    }
    const Graph* const inside = is_unit ? &graph_.submodule_of(operations.front())->body : nullptr;
    const std::string pin =
        inside != nullptr ? (*inside)[inside->inputs()[i]].name : std::string(1, static_cast<char>('a' + i));
    shared.operands.push_back(claim(fmt::format("{}_{}", shared.name, pin)));
    text_ += fmt::format("  reg {}{};\n", vector_range(graph_[n.args[i]].width), shared.operands.back());
  }
  write_component({operations.front(), shared.operands, shared.name, shared.declared, ""});
  return shared;
}

void Body::write_selection(const SharedComponent& shared) {
  const int interval = options_.binding.interval;
  const int width = phase_bits(interval);
  const std::string indent = options_.enable.empty() ? "" : "  ";
  std::string cases;
  for (const NodeId id : shared.operations) {
    const int stage = schedule_.slots[id].stage;
    cases += fmt::format(
        "{}      {}: begin  // stage {}, for {}\n", indent,
        id == shared.operations.back() ? "default" : fmt::format("{}'d{}", width, stage % interval), stage,
        names_[id].name);
    for (std::size_t i = 0; i < shared.operands.size(); ++i)
      if (is_selected(graph_, shared.operations, i))
        cases += fmt::format("{}        {} <= {};\n", indent, shared.operands[i],
                             expression(graph_[id].args[i], stage));
    cases += indent + "      end\n";
  }
  cases = fmt::format("{0}    case (phase)\n{1}{0}    endcase\n", indent, cases);
  if (!options_.enable.empty()) cases = fmt::format("    if ({}) begin\n{}    end\n", options_.enable, cases);
  text_ +=
      fmt::format("\n  // What {} reads next.\n  always @(posedge clk) begin\n{}  end\n", shared.name, cases);
}

std::string Body::loaded(const std::string& assignments, const std::string& condition) const {
  if (assignments.empty()) return "";
  const std::string body =
      condition.empty() ? assignments : fmt::format("    if ({}) begin\n{}    end\n", condition, assignments);
  return fmt::format("  always @(posedge clk) begin\n{}  end\n", body);
}

void Body::declare(std::size_t i) {
  const Register& r = placement_.registers[i];
  std::string what = fmt::format("stage {}", r.boundary);
  for (const Passing& other : r.others)
    what += fmt::format(", of {} stage {}", names_[other.value].name, other.boundary);
  text_ += fmt::format("  reg {}{};{}\n", vector_range(r.width()), registers_[i], comment(what, r.value));
}

void Body::write_registers(int boundary) {
  const int interval = options_.binding.interval;
  const std::string& enable = options_.enable;
  const auto loads = [&](const Register& r) -> std::string {
    if (!r.holds() || r.loads_again) return enable;
    std::set<int> phases;
    for (const Passing& p : r.values()) phases.insert(p.boundary % interval);
    std::vector<std::string> in;
    for (const int phase : phases) in.push_back(fmt::format("phase == {}'d{}", phase_bits(interval), phase));
    const std::string one_of = in.size() == 1 ? in.front() : fmt::format("({})", fmt::join(in, ") | ("));
    return enable.empty() ? one_of : fmt::format("{} & ({})", enable, one_of);
  };
  std::map<std::string, std::string> assignments;  // by condition
  for (std::size_t i = 0; i < placement_.registers.size(); ++i) {
    const Register& r = placement_.registers[i];
    if (r.boundary != boundary) continue;
    if (!r.is_shared()) declare(i);
    const std::string condition = loads(r);
    assignments[condition] += fmt::format("{}{} <= {};\n", condition.empty() ? "    " : "      ",
                                          registers_[i], bits_of(r.value, r.high, r.low, boundary));
  }
  for (const auto& [condition, all] : assignments) text_ += loaded(all, condition);
}

void Body::write_stage(int stage) {
  text_ += options_.is_step ? "\n  // What a cycle computes.\n" : fmt::format("\n  // Stage {}.\n", stage);
  for (NodeId id = 0; id < graph_.size(); ++id) {
    const Node& n = graph_[id];
    if (!is_root(n.op) || n.op == Op::input || schedule_.slots[id].stage != stage) continue;
    if (options_.binding.shares(id)) continue;
    const BitSpan span = declared(id);
    std::string what;
    if (is_pipelined_multiplier(id)) what = fmt::format("bits {}:{}, ", span.high, span.low);
    if (is_pipelined_multiplier(id) || n.op == Op::call)
      what += fmt::format("there in stage {}", schedule_.slots[id].finish);
    Connected component{id, {}, names_[id].name, span, comment(what, id)};
    for (const NodeId arg : n.operands()) component.operands.push_back(expression(arg, stage));
    write_component(component);
  }
  write_registers(stage);
}

void Body::write_unused() {
  std::vector<std::string> unused;
  const auto add = [&](const std::string& name, BitSpan span, Word rest) {
    for_each_run(rest, [&](int high, int low) { unused.push_back(select_bits(name, span, high, low)); });
  };
  for (NodeId id = 0; id < graph_.size(); ++id) {
    if (!is_root(graph_[id].op) || options_.binding.shares(id)) continue;
    const BitSpan span = declared(id);
    add(names_[id].name, span, bit_range(span.high, span.low) & ~placement_.used_bits[id]);
  }
  for (std::size_t i = 0; i < placement_.registers.size(); ++i) {
    const Register& r = placement_.registers[i];
    add(registers_[i], {r.high, r.low}, r.unread);
  }
  for (const auto& [instance, shared] : shared_) {
    Word rest = bit_range(shared.declared.high, shared.declared.low);
    for (const NodeId id : shared.operations) rest &= ~placement_.used_bits[id];
    add(shared.name, shared.declared, rest);
  }
  if (unused.empty()) return;
  text_ +=
      fmt::format("\n  // Not read on purpose.\n  wire unused = &{{1'b0, {}}};\n", fmt::join(unused, ", "));
}

}  // namespace hitpipe::rtl
