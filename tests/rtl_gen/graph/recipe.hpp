// Random legal graphs as lists of calls. A recipe can be recorded in any order that its operands allow. It
// can compute every value itself, without the graph's code.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/graph/graph.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl {

struct Step {
  Op op;
  int width;
  std::array<std::size_t, 3> args{};
  bool is_signed = false;
  int low = 0;
  Word value = 0;
  std::string name{};
};

class Recipe {
 public:
  /// `inputs` ports, `length` random steps, and some steps that make operands equally wide. The last values
  /// are outputs. No value is wider than `widest`; ports have up to 24 bits, or 60 beside wider values.
  Recipe(Seeded& random, int inputs, int length, int outputs, int widest = 64) : widest_(widest) {
    for (int i = 0; i < inputs; ++i) {
      const int width = i == 0 ? 1 : random.between(1, is_wide() ? 60 : 24);
      steps_.push_back(
          {.op = Op::input, .width = width, .is_signed = random.flip(), .name = fmt::format("in{}", i)});
    }
    input_count_ = steps_.size();
    for (int i = 0; i < length; ++i) add_random(random);
    const std::size_t last = steps_.size() - 1;
    for (int i = 0; i < outputs; ++i) {
      std::size_t out = last - static_cast<std::size_t>(i) * 3;
      const int width = steps_[out].width;
      if (width > most_port_bits)
        out =
            push({.op = Op::slice, .width = most_port_bits, .args = {out}, .low = random.below(width - 63)});
      outputs_.push_back(out);
    }
    name_some(random);
  }

  [[nodiscard]] std::size_t input_count() const { return input_count_; }
  [[nodiscard]] const Step& operator[](std::size_t i) const { return steps_[i]; }

  /// One bit that depends on every output, in place of the outputs: a design's "hit".
  void join_outputs() {
    std::size_t joined = bit_of(outputs_.front());
    for (std::size_t i = 1; i < outputs_.size(); ++i) {
      joined = push({.op = Op::bit_xor, .width = 1, .args = {joined, bit_of(outputs_[i])}});
    }
    outputs_ = {joined};
  }

  /// Records it in the order written.
  [[nodiscard]] Graph graph(std::string_view name = "recipe", std::string_view output = "out") const {
    std::vector<std::size_t> order(steps_.size());
    std::iota(order.begin(), order.end(), 0);
    return record(order, name, output);
  }
  /// Records it in another order: inputs first, then at random among the steps that can be recorded.
  [[nodiscard]] Graph shuffled(Seeded& random) const {
    std::vector<std::size_t> order;
    std::vector<bool> done(steps_.size(), false);
    for (std::size_t i = 0; i < input_count_; ++i) done[i] = true, order.push_back(i);
    while (order.size() < steps_.size()) {
      std::vector<std::size_t> ready;
      for (std::size_t i = 0; i < steps_.size(); ++i) {
        const auto& args = steps_[i].args;
        const auto arity = static_cast<std::ptrdiff_t>(arity_of(steps_[i].op));
        const bool can =
            std::all_of(args.begin(), args.begin() + arity, [&](std::size_t a) { return done[a]; });
        if (!done[i] && can) ready.push_back(i);
      }
      const std::size_t next = ready[static_cast<std::size_t>(random.below(static_cast<int>(ready.size())))];
      done[next] = true;
      order.push_back(next);
    }
    return record(order, "recipe", "out");
  }

  /// The outputs for given inputs, by the plain meaning of every step.
  [[nodiscard]] std::vector<std::uint64_t> outputs(const std::vector<std::uint64_t>& inputs) const {
    std::vector<Word> value(inputs.begin(), inputs.end());
    for (std::size_t i = input_count_; i < steps_.size(); ++i)
      value.push_back(evaluate_step(steps_[i], value));
    std::vector<std::uint64_t> results;
    for (const std::size_t out : outputs_) results.push_back(static_cast<std::uint64_t>(value[out]));
    return results;
  }

  [[nodiscard]] std::vector<std::uint64_t> random_inputs(Seeded& random) const {
    std::vector<std::uint64_t> values;
    for (std::size_t i = 0; i < input_count_; ++i) values.push_back(random.value(steps_[i].width));
    return values;
  }

 private:
  [[nodiscard]] bool is_wide() const { return widest_ > 64; }
  static std::size_t arity_of(Op op) {
    if (op == Op::input || op == Op::constant) return 0;
    if (op == Op::slice || op == Op::extend || op == Op::invert) return 1;
    return op == Op::mux ? 3 : 2;
  }

  std::size_t push(Step step) {
    steps_.push_back(std::move(step));
    return steps_.size() - 1;
  }
  std::size_t any(Seeded& random) {
    return static_cast<std::size_t>(random.below(static_cast<int>(steps_.size())));
  }

  std::size_t resized(std::size_t value, int width, bool is_signed) {
    const int from = steps_[value].width;
    if (from == width) return value;
    if (from > width) return push({.op = Op::slice, .width = width, .args = {value}});
    return push({.op = Op::extend, .width = width, .args = {value}, .is_signed = is_signed});
  }
  std::size_t bit_of(std::size_t value) {
    const int width = steps_[value].width;
    const std::size_t top = push({.op = Op::slice, .width = 1, .args = {value}, .low = width - 1});
    if (width == 1) return value;
    return push({.op = Op::bit_xor, .width = 1, .args = {top, resized(value, 1, false)}});
  }

  void add_random(Seeded& random) {
    static constexpr std::array ops{Op::constant, Op::slice,  Op::slice,   Op::concat, Op::extend,
                                    Op::extend,   Op::invert, Op::bit_and, Op::bit_or, Op::bit_xor,
                                    Op::add,      Op::sub,    Op::sub,     Op::mul,    Op::less,
                                    Op::equal,    Op::mux,    Op::mux};
    const Op op = ops[static_cast<std::size_t>(random.below(static_cast<int>(ops.size())))];
    const bool is_signed = random.flip();
    std::size_t a = any(random);
    std::size_t b = any(random);
    const int wa = steps_[a].width;
    const int wb = steps_[b].width;
    switch (op) {
      case Op::constant: {
        const int width = random.between(1, 24);
        push({.op = op, .width = width, .value = random.value(width)});
        return;
      }
      case Op::slice: {
        const int low = random.below(wa);
        push({.op = op, .width = random.between(1, wa - low), .args = {a}, .low = low});
        return;
      }
      case Op::extend:
        push({.op = op,
              .width = std::min(40, wa) + random.below(8) + std::max(0, wa - 40),
              .args = {a},
              .is_signed = is_signed});
        if (is_wide()) steps_.back().width = random.between(wa, widest_);
        steps_.back().width = std::min(steps_.back().width, widest_);
        return;
      case Op::invert:
        push({.op = op, .width = wa, .args = {a}});
        return;
      case Op::concat:
        if (wa + wb <= (is_wide() ? widest_ : 48)) push({.op = op, .width = wa + wb, .args = {a, b}});
        return;
      case Op::mul:
        a = resized(a, std::min(wa, is_wide() ? widest_ / 2 : 20), is_signed);
        b = resized(b, std::min(wb, is_wide() ? widest_ / 2 : 20), is_signed);
        push({.op = op, .width = steps_[a].width + steps_[b].width, .args = {a, b}, .is_signed = is_signed});
        return;
      default:
        break;
    }
    const int width = random.flip() ? wa : wb;
    a = resized(a, width, random.flip());
    b = resized(b, width, random.flip());
    if (op == Op::mux) {
      const std::size_t select = resized(any(random), 1, false);
      push({.op = op, .width = width, .args = {select, a, b}});
      return;
    }
    const bool one_bit = op == Op::less || op == Op::equal;
    push({.op = op, .width = one_bit ? 1 : width, .args = {a, b}, .is_signed = op == Op::less && is_signed});
  }

  /// A node that two steps share has the name of the first step. Only one step names it, so that order does
  /// not matter.
  void name_some(Seeded& random) {
    Graph graph("naming");
    std::vector<NodeId> ids;
    std::set<NodeId> named;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      ids.push_back(record_step(graph, steps_[i], ids));
      if (i >= input_count_ && random.below(3) == 0 && graph[ids.back()].op != Op::input &&
          named.insert(ids.back()).second) {
        steps_[i].name = fmt::format("v{}", i);
      }
    }
  }

  template <class Ids>
  static NodeId record_step(Graph& graph, const Step& s, const Ids& ids) {
    const auto arg = [&](std::size_t i) { return ids[s.args[i]]; };
    switch (s.op) {
      case Op::input:
        return graph.input(s.name, s.width, s.is_signed);
      case Op::constant:
        return graph.constant(s.width, s.value);
      case Op::slice:
        return graph.slice(arg(0), s.low + s.width - 1, s.low);
      case Op::concat:
        return graph.concat(arg(0), arg(1));
      case Op::extend:
        return graph.extend(arg(0), s.width, s.is_signed);
      case Op::invert:
        return graph.invert(arg(0));
      case Op::mux:
        return graph.mux(arg(0), arg(1), arg(2));
      default:
        return graph.binary(s.op, arg(0), arg(1), s.is_signed);
    }
  }

  /// Outputs are called `output`, `output1`, and so on.
  [[nodiscard]] Graph record(const std::vector<std::size_t>& order, std::string_view name,
                             std::string_view output) const {
    Graph graph{std::string(name)};
    std::vector<NodeId> ids(steps_.size(), no_node);
    for (const std::size_t i : order) {
      ids[i] = record_step(graph, steps_[i], ids);
      if (i >= input_count_) graph.annotate(ids[i], steps_[i].name, {});
    }
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      graph.output(i == 0 ? std::string(output) : fmt::format("{}{}", output, i), ids[outputs_[i]]);
    }
    return graph;
  }

  [[nodiscard]] Word evaluate_step(const Step& s, const std::vector<Word>& value) const {
    const auto bit = [](Word x, int i) { return x >> i & 1; };
    const auto arg = [&](std::size_t i) { return value[s.args[i]]; };
    const auto width = [&](std::size_t i) { return steps_[s.args[i]].width; };
    // In two's complement, by the weight of the top bit.
    const auto number = [&](std::size_t i) {
      const Word sign = bit(arg(i), width(i) - 1) << (width(i) - 1);
      return static_cast<Number>(arg(i) - sign - sign);
    };
    const auto bit_of_result = [&](int i) -> Word {
      if (s.op == Op::slice) return bit(arg(0), s.low + i);
      if (s.op == Op::concat) return i < width(1) ? bit(arg(1), i) : bit(arg(0), i - width(1));
      if (s.op == Op::extend)
        return i < width(0) ? bit(arg(0), i) : s.is_signed ? bit(arg(0), width(0) - 1) : Word{0};
      if (s.op == Op::invert) return 1 - bit(arg(0), i);
      if (s.op == Op::bit_and) return bit(arg(0), i) * bit(arg(1), i);
      if (s.op == Op::bit_or) return bit(arg(0), i) != 0 ? Word{1} : bit(arg(1), i);
      return bit(arg(0), i) != bit(arg(1), i) ? 1 : 0;  // bit_xor
    };
    const auto wrapped = [&](Word result) { return result & ~Word{0} >> (128 - s.width); };
    // The first factor by each bit of the second; the top bit of a signed factor counts less than nothing.
    const auto product = [&] {
      Word sum = 0;
      const Word first = s.is_signed ? static_cast<Word>(number(0)) : arg(0);
      for (int i = 0; i < width(1); ++i) {
        const Word part = bit(arg(1), i) * (first << i);
        sum = s.is_signed && i == width(1) - 1 ? sum - part : sum + part;
      }
      return sum;
    };
    if (s.op == Op::constant) return s.value;
    if (s.op == Op::add) return wrapped(arg(0) + arg(1));
    if (s.op == Op::sub) return wrapped(arg(0) - arg(1));
    if (s.op == Op::mul) return wrapped(product());
    if (s.op == Op::less) return (s.is_signed ? number(0) < number(1) : arg(0) < arg(1)) ? 1 : 0;
    if (s.op == Op::equal) return arg(0) == arg(1) ? 1 : 0;
    if (s.op == Op::mux) return arg(0) == 1 ? arg(1) : arg(2);
    Word result = 0;
    for (int i = 0; i < s.width; ++i) result |= bit_of_result(i) << i;
    return result;
  }

  std::vector<Step> steps_;
  int widest_;
  std::size_t input_count_ = 0;
  std::vector<std::size_t> outputs_;
};

}  // namespace hitpipe::rtl
