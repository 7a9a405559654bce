// A core behind AXI while its features build it (feature.hpp): pins, machines around the core, and what joins them.
// Names are those of parts and pins; the part "" is the wrapper itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/emit/axi_stream.hpp"
#include "rtl_gen/part/assembly.hpp"

namespace hitpipe::rtl {

/// A channel of AXI: valid, ready and data with their widths. An input has valid and data as inputs.
struct AxiChannel {
  std::string before;  ///< "m_axi_ar": of its pins' names
  bool is_input;
  std::vector<std::pair<std::string, int>> data;
};

class AxiPlan {
 public:
  explicit AxiPlan(const Core& inside);

  void add_channel(const AxiChannel& channel);
  void add_pin(const Pin& pin) { made_.interface.pins.push_back(pin); }
  /// Of the wrapper, all of an output of a part.
  void add_output(std::string_view name, std::string_view part, std::string_view output);
  /// Parts get the clock, and are reset by aresetn.
  void add_machine(std::string_view machine, const Format& format);
  [[nodiscard]] bool has(std::string_view part, std::string_view pin) const;
  [[nodiscard]] bool has_part(std::string_view part) const { return place_of(part).has_value(); }

  /// All of a pin; `width` bits of it from `low` on.
  [[nodiscard]] Source all(std::string_view part, std::string_view pin) const;
  [[nodiscard]] Source some(std::string_view part, std::string_view pin, int low, int width) const;
  static Source constant(std::uint64_t value, int width) {
    return {.pieces = {{std::nullopt, value, width}}};
  }
  /// Side by side, the lowest first.
  static Source beside(const std::vector<Source>& sources);
  /// What is valid on a channel of answers, without those of before a hard reset. Only identifiers tell these.
  [[nodiscard]] Source valid_now(const std::string& channel) const;
  /// A hard reset.
  [[nodiscard]] Source is_reset() const;
  [[nodiscard]] Gate gate(std::string_view part, std::string_view pin) const;
  static Source through(Source source, const Gate& gate) {
    source.gates.push_back(gate);
    return source;
  }

  void join(std::string_view part, std::string_view pin, Source from);
  /// From the pin of a part to that of another one.
  void join(std::string_view part, std::string_view pin, std::string_view from, std::string_view output) {
    join(part, pin, all(from, output));
  }
  /// The fields of a word: inputs of a part called BEFORE_NAME. The word is a pin of the wrapper.
  void join_fields(std::string_view part, std::string_view before, const std::vector<StreamField>& fields,
                   std::string_view word);
  /// And outputs of a part, with zeros between.
  void join_word(std::string_view word, const std::vector<StreamField>& fields, std::string_view part,
                 std::string_view before);
  /// Words of 64 bits: the inputs BEFORE_0, BEFORE_1, ... that a part has, of a beat.
  void join_beat(std::string_view part, std::string_view before, std::string_view word);
  /// What is the same for all bursts on a channel of addresses. `beat_bytes` is a power of two.
  void join_burst(const std::string& channel, Source length, int beat_bytes);
  [[nodiscard]] bool is_joined(std::string_view part, std::string_view pin) const;

  /// An input of a part that nothing drives gets the output of another part that has its name. Throws std::logic_error,
  /// a line for each, when verify() finds something.
  Assembly made() &&;

  const Core& core;

 private:
  struct Place {
    std::size_t part, pin;
  };
  void join_rest();
  [[nodiscard]] const std::vector<Pin>& pins_of(std::size_t part) const;
  [[nodiscard]] std::optional<std::size_t> place_of(std::string_view part) const;
  [[nodiscard]] Place place(std::string_view part, std::string_view pin) const;

  Assembly made_;
};

}  // namespace hitpipe::rtl
