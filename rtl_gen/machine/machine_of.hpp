// A machine of hls/machines from its one template: its graph, and its software.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hls/machines/memory.hpp"
#include "hls/machines/record.hpp"
#include "hls/num/domain.hpp"
#include "hls/num/sized.hpp"
#include "rtl_gen/graph/trace.hpp"
#include "rtl_gen/machine/machine.hpp"

namespace hitpipe::rtl {

namespace detail {

/// How often each field was written in a step.
class WriteCounts {
 public:
  void written(const std::string& field) { ++counts_[field]; }
  [[nodiscard]] int of(const std::string& field) const {
    const auto found = counts_.find(field);
    return found == counts_.end() ? 0 : found->second;
  }

 private:
  std::map<std::string, int> counts_;
};

/// The records of values that follow from a machine's lists, and one cycle of it.
template <class M>
struct WithRecords : M {
  template <class D, class F>
  using State = hls::Values<D, F, typename M::State>;
  template <class D, class F>
  using Inputs = hls::Values<D, F, typename M::In>;
  template <class D, class F>
  using Outputs = hls::Values<D, F, typename M::Out>;
  template <class Memory>
  using Memories = hls::detail::MemorySlots<Memory, typename M::Memory::Items>;

  template <class D, class F, class Memory, class Log>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& now, Memories<Memory>& memories,
                                         Log& log) {
    Outputs<D, F> out;
    M::template outputs<D>(format, now, hls::Accesses<typename M::Memory, F, Memory>(format, memories),
                           hls::Writable<Outputs<D, F>, Log>(out, log));
    return out;
  }
  template <class D, class F, class Memory, class Log>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories, Log& log) {
    const State<D, F> now = state;
    M::template step<D>(format, now, in, hls::Accesses<typename M::Memory, F, Memory>(format, memories),
                        hls::Next<State<D, F>, Log>(now, state, log));
  }
};
/// A memory of a traced machine. Its accesses become inputs and outputs of the graph, in whatever order the
/// machine states them.
class TracedMemory {
 public:
  void declare(const hls::MemoryShape& shape) {
    shape_ = shape;
    word_ = Trace::uint(TraceRecorder::graph().input(memory_port(shape_, "word"), shape_.width, false));
  }
  template <class Place>
  Trace::uint read(const Place& place, [[maybe_unused]] int width) {
    assert(shape_.kind == hls::MemoryKind::lookup && width == shape_.width);
    // Outputs and step may both read it, at one place.
    if (read_ != no_node && read_ != place.id())
      throw std::logic_error(fmt::format("{} is read at two places", shape_.name));
    if (read_ == no_node) accesses_.push_back({"read", place.id()});
    read_ = place.id();
    return word_;
  }
  template <class Place>
  void ask(const Place& place) {
    assert(shape_.is_late());
    accesses_.push_back({"asked", place.id()});
  }
  [[nodiscard]] Trace::uint word([[maybe_unused]] int width) const {
    assert(shape_.is_late() && width == shape_.width);
    return word_;
  }
  template <class Place, class Written>
  void write(const Trace::bit& enable, const Place& place, const Written& word) {
    accesses_.push_back({"writes", enable.id()});
    accesses_.push_back({"place", place.id()});
    accesses_.push_back({"written", word.id()});
  }
  template <class Place, class Written>
  void access(const Trace::bit& writes, const Place& place, const Written& word) {
    assert(shape_.kind == hls::MemoryKind::single);
    write(writes, place, word);
  }
  void add_outputs(Graph& graph) const {
    for (const std::string_view what : {"read", "asked", "writes", "place", "written"})
      for (const auto& [name, node] : accesses_)
        if (name == what) graph.output(memory_port(shape_, what), node);
  }

 private:
  hls::MemoryShape shape_{};
  Trace::uint word_;
  NodeId read_ = no_node;
  std::vector<std::pair<std::string_view, NodeId>> accesses_;
};

/// The low bits of a value of the host's domains, and back.
template <int W, bool S>
Word pattern_of(const hls::ap_base<W, S>& x) {
  return static_cast<Word>(x.word()) & ones_below(W);
}
template <bool S, class W>
Word pattern_of(const hls::SizedInt<S, W>& x) {
  return static_cast<Word>(x.pattern());
}
template <int W, bool S>
void set_pattern(hls::ap_base<W, S>& x, Word pattern, int /*width*/) {
  using Own = typename hls::ap_base<W, S>::word_type;
  x = hls::ap_base<W, S>::wrapped(static_cast<Own>(pattern));
}
template <bool S, class W>
void set_pattern(hls::SizedInt<S, W>& x, Word pattern, int width) {
  x = hls::SizedInt<S, W>(static_cast<W>(pattern), width);
}

/// A memory of a machine in domain D of the host.
template <class D>
class HostMemory {
 public:
  void declare(const hls::MemoryShape& shape, Collision collision) {
    spoils_ = collision == Collision::any_word;
    width_ = shape.width;
    words_.assign(static_cast<std::size_t>(shape.words), 0);
    if (shape.contents != nullptr) std::copy_n(shape.contents, words_.size(), words_.begin());
  }
  template <class Place, class W>
  hls::Word<D, W> read(const Place& place, const W& width) const {
    return as_word(words_[static_cast<std::size_t>(pattern_of(place))], width);
  }
  template <class Place>
  void ask(const Place& place) {
    asked_ = static_cast<std::size_t>(pattern_of(place));
  }
  template <class W>
  hls::Word<D, W> word(const W& width) const {
    return as_word(word_, width);
  }
  template <class Place, class Written>
  void write(const typename D::bit& enable, const Place& place, const Written& word) {
    writes_ = pattern_of(enable) != 0;
    if (!writes_) return;
    place_ = static_cast<std::size_t>(pattern_of(place));
    written_ = pattern_of(word);
  }
  template <class Place, class Written>
  void access(const typename D::bit& writes, const Place& place, const Written& word) {
    write(writes, place, word);
    if (!writes_) ask(place);
    holds_ = writes_;
  }
  /// The clock edge.
  void clock() {
    const bool spoilt = spoils_ && writes_ && place_ == asked_;
    if (!holds_) word_ = spoilt ? ~written_ & ones_below(width_) : words_[asked_];
    if (writes_) words_[place_] = written_;
    writes_ = false;
  }

 private:
  template <class W>
  static hls::Word<D, W> as_word(Word pattern, const W& width) {
    hls::Word<D, W> x{};
    set_pattern(x, pattern, width);
    return x;
  }

  std::vector<Word> words_;
  Word word_ = 0, written_ = 0;
  std::size_t asked_ = 0, place_ = 0;
  int width_ = 0;
  bool writes_ = false, spoils_ = false;
  bool holds_ = false;  ///< it keeps the word that it gives: its one port writes
};

/// M has its records.
template <class M, class D, class F>
class NativeMachineOf final : public JoinedMachine {
 public:
  NativeMachineOf(const F& format, Collision collision) : format_(format) {
    memories_.for_each(format_, memories_, [&](const hls::MemoryShape& shape, auto& memory) {
      memory.declare(shape, collision);
    });
    state_.for_each(format_, state_, [](const hls::Field& field, auto& x) {
      set_pattern(x, static_cast<Word>(field.reset), field.width);
    });
  }

  void outputs(Word* outputs) override { give_to(outputs); }
  void give(std::uint64_t* outputs) override { give_to(outputs); }
  void step(const Word* inputs, bool reset) override {
    take_from([&] { return *inputs++; }, reset);
  }
  void take(const std::uint64_t* const* inputs, bool reset) override {
    take_from([&] { return **inputs++; }, reset);
  }

  void state(Word* registers) const override {
    state_.for_each(format_, state_, [&](const hls::Field&, const auto& x) { *registers++ = pattern_of(x); });
  }

 private:
  template <class W>
  void give_to(W* outputs) {
    const auto out = M::template outputs<D>(format_, state_, memories_, log_);
    out.for_each(format_, out,
                 [&](const hls::Field&, const auto& x) { *outputs++ = static_cast<W>(pattern_of(x)); });
  }
  template <class Input>
  void take_from(Input&& input, bool reset) {
    in_.for_each(format_, in_,
                 [&](const hls::Field& field, auto& x) { set_pattern(x, input(), field.width); });
    M::template step<D>(format_, state_, in_, memories_, log_);
    memories_.for_each(format_, memories_, [](const hls::MemoryShape&, auto& memory) { memory.clock(); });
    if (!reset) return;
    state_.for_each(format_, state_, [](const hls::Field& field, auto& x) {
      if (field.has_reset) set_pattern(x, static_cast<Word>(field.reset), field.width);
    });
  }

  F format_;
  typename M::template State<D, F> state_{};
  typename M::template Inputs<D, F> in_{};
  typename M::template Memories<HostMemory<D>> memories_{};
  hls::NoLog log_;
};

}  // namespace detail

template <class Machine>
MachineGraph traced_machine(const typename Machine::Bits& format) {
  using M = detail::WithRecords<Machine>;
  using Bits = typename M::Bits;
  MachineGraph machine{
      .name = M::name, .state = {}, .inputs = {}, .outputs = {}, .memories = {}, .graph = Graph(M::name)};
  Graph& graph = machine.graph;
  const TraceRecorder recorder(graph);
  const auto port = [&](std::vector<hls::Field>& fields) {
    return [&]<bool S>(const hls::Field& field, Signal<S>& x) {
      fields.push_back(field);
      x = Signal<S>(graph.input(field.name, field.width, S));
    };
  };
  typename M::template State<Trace, Bits> state;
  typename M::template Inputs<Trace, Bits> in;
  typename M::template Memories<detail::TracedMemory> memories;
  state.for_each(format, state, port(machine.state));
  in.for_each(format, in, port(machine.inputs));
  memories.for_each(format, memories, [&](const hls::MemoryShape& shape, detail::TracedMemory& memory) {
    machine.memories.push_back(shape);
    memory.declare(shape);
  });
  detail::WriteCounts given, written;
  const auto out = M::template outputs<Trace>(format, state, memories, given);
  M::template step<Trace>(format, state, in, memories, written);
  memories.for_each(format, memories, [&](const hls::MemoryShape&, const detail::TracedMemory& memory) {
    memory.add_outputs(graph);
  });
  // verify() refuses a name that is given twice, and an output that is not given.
  state.for_each(format, state, [&](const hls::Field& field, const auto& x) {
    const std::string name = std::string("next_") + field.name;
    for (int i = 0; i < std::max(1, written.of(field.name)); ++i) graph.output(name, x.id());
    // A value that the C++ does not name; a register that another one follows keeps its own name.
    if (graph[x.id()].op != Op::input) graph.annotate(x.id(), name + "_value", {});
  });
  out.for_each(format, out, [&](const hls::Field& field, const auto& x) {
    machine.outputs.push_back(field);
    for (int i = 0; i < given.of(field.name); ++i) graph.output(field.name, x.id());
  });
  return machine;
}

template <class Machine>
std::unique_ptr<JoinedMachine> native_machine(const typename Machine::Bits& format, Collision collision) {
  using M = detail::WithRecords<Machine>;
  std::unique_ptr<JoinedMachine> made;
  const auto choose = [&]<class... F>(hls::FormatList<F...>) {
    ((format == typename M::Bits(F{})
          ? void(made = std::make_unique<detail::NativeMachineOf<M, hls::Native, F>>(F{}, collision))
          : void()),
     ...);
  };
  choose(typename M::BuiltIn());
  if (!made)
    made = std::make_unique<detail::NativeMachineOf<M, hls::WideSized, typename M::Bits>>(format, collision);
  return made;
}

template <class M>
Machine machine_of() {
  using Bits = typename M::Bits;
  return {.name = M::name,
          .summary = M::summary,
          .default_format = Bits{},
          .graph_at = [](const Format& format) { return traced_machine<M>(format.as<Bits>()); },
          .native_at = [](const Format& format,
                          Collision collision) { return native_machine<M>(format.as<Bits>(), collision); }};
}

}  // namespace hitpipe::rtl
