// A feature is what a core may have or not: a cache, rays from memory, questions. All that is particular to it stands
// in one value: how a user chooses it, what it changes in the core, what registers, header and harness say of it.
// Whatever is written of a core goes through the features that it has, and names none. docs/features.md shows how to
// add one.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "hls/machines/register_table.hpp"
#include "rtl_gen/core/core_options.hpp"
#include "rtl_gen/core/plan.hpp"
#include "rtl_gen/emit/manifest.hpp"

namespace hitpipe::rtl {

struct Core;
struct CoreRecords;
class AxiPlan;

/// A number or a word that a user gives on the command line.
struct CoreOption {
  /// Commands have all options of a group, or none.
  enum class Group { rays, core, cache, limits, ports, bus };
  using Words = std::vector<std::pair<std::string, int>>;

  Group group;
  std::string_view name;  ///< "--cache"
  std::string help;
  int (*get)(const CoreOptions& options);
  void (*set)(CoreOptions& options, int value);
  int least = 0, most = -1;  ///< numbers that are allowed; none: words alone
  Words words{};             ///< with the value that each stands for. Only words and no numbers: one of these
  bool is_flag = false;      ///< without an argument: sets 1
  bool power_of_two = false;  ///< a number, but 0
  std::string_view type{};    ///< of the argument in the help; empty: N
  std::string_view needs{};   ///< an option that must be given too
  std::string_view json{};    ///< its name in manifests; empty: none

  [[nodiscard]] bool has_numbers() const { return least <= most; }
  /// What a user writes for a value: a word, or the number.
  [[nodiscard]] std::string text(int value) const;
};
/// Of an option that is a number or a flag of CoreOptions.
template <auto Field>
int number_at(const CoreOptions& options) {
  return static_cast<int>(options.*Field);
}
template <auto Field>
void put_number(CoreOptions& options, int value) {
  options.*Field = static_cast<std::remove_reference_t<decltype(options.*Field)>>(value);
}

/// The registers FORMAT, SHAPE, PORTS and LIMITS, which the C header of a core has too, so that a driver sees whether
/// they go together. Their fields are those of hls/machines/register_table.hpp that have a number in each core.
class CoreIdentity {
 public:
  /// Throws std::logic_error for a name that no field has, for one that was put, and for a number that has too many
  /// bits.
  void put(std::string_view field, int number);
  /// Throws std::logic_error if a field was not put.
  void check() const;
  /// Of the register with that name; 0 of one that has no such field.
  [[nodiscard]] std::uint32_t operator[](std::string_view name) const;

 private:
  std::map<std::string_view, std::uint32_t> numbers_;  ///< by their fields
};

/// What a feature adds to the C header of a core.
struct CHeaderPart {
  std::vector<std::string> includes{};  ///< "math.h"
  std::string constants{};              ///< of status and control, lines
  std::string functions{};              ///< behind those that pack rays and unpack answers
};

/// The core has this as well, or the feature cannot be there.
struct Needs {
  std::string_view feature;
  std::string_view otherwise;  ///< what stands in its place: "integers"
};
/// Not both.
struct Excludes {
  std::string_view feature;
  std::string_view instead;  ///< what is allowed: "rays at pins"
};

/// What goes wrong, and what one sees then.
struct Failure {
  std::string_view what, shows;
};

/// What is promised of a feature. A proof of a machine shows it (tests/formal/prove_machines.sh) and finds damage of
/// its Verilog. Or only a test shows it.
struct Promise {
  struct Damage {
    std::string_view change;  ///< an expression of sed
    std::string_view what = "damage";
  };
  std::string_view what;
  std::string_view machine{}, bits{};  ///< of the proof. Without bits none is made of the machine
  std::vector<Damage> damage{};
  std::string_view test{};  ///< "Suite.Test" if there is no proof
};

struct Feature {
  std::string_view name;
  std::string_view what;     ///< in messages: "questions count and next"
  std::string_view summary;  ///< a line for users
  /// What turns it on in the smallest core that faults are planted in: "--cache 2". Empty of the base.
  std::string_view smallest;
  bool (*is_in)(const CoreOptions& options);
  std::vector<CoreOption> options{};
  std::vector<Needs> needs{};
  std::vector<Excludes> excludes{};
  /// Called for a core that has it. Throws std::runtime_error, one line, for numbers outside their limits.
  void (*check)(const CoreOptions& options) = nullptr;
  void (*change)(CorePlan& plan, const CoreOptions& options) = nullptr;
  /// Pins and machines of the wrapper, and what joins them.
  void (*axi)(AxiPlan& plan) = nullptr;
  /// What the machine `registers` has for it.
  void (*registers)(hls::RegisterBits& bits) = nullptr;
  void (*axi_json)(Json& json, const Core& core) = nullptr;
  /// What rays and answers look like outside. The last feature that says it has its way.
  CoreRecords (*records)(const Core& core) = nullptr;
  /// Called for every core: the identity also says that a core lacks the feature.
  void (*identify)(CoreIdentity& identity, const CoreOptions& options) = nullptr;
  /// A constant of the C header that each core has, and its number.
  std::string_view c_constant{};
  int (*c_value)(const CoreOptions& options) = nullptr;
  CHeaderPart (*c_header)(const Core& core) = nullptr;
  /// What the harness does for it: "float_door" is struct FloatDoor of rtl_gen/core/harness/float_door.hpp. The other
  /// one stands in its place in a core without the feature.
  std::string_view harness{}, harness_otherwise{};
  // For readers (docs/core.md, docs/formal.md).
  std::vector<Failure> failures{};
  std::vector<Promise> promises{};
};

/// Those of designs.cmake, the base core first. Each changes the plan that those before it have made.
[[nodiscard]] std::span<const Feature* const> all_features();
/// Throws std::logic_error for a name that no feature has.
[[nodiscard]] const Feature& feature_called(std::string_view name);
/// Throws std::logic_error for a name that no option has.
[[nodiscard]] const CoreOption& core_option(std::string_view name);
/// The features of a core, in that order.
[[nodiscard]] std::vector<const Feature*> features_of(const CoreOptions& options);

[[nodiscard]] CorePlan plan_of(const CoreOptions& options);
/// What a core wants of memory.
[[nodiscard]] CoreBus bus_of(const CoreOptions& options);
/// Of the options that have a name in manifests: what they are.
[[nodiscard]] Json options_json(const CoreOptions& options);
/// With all its fields: throws std::logic_error if no feature puts one of them.
[[nodiscard]] CoreIdentity identity_of(const CoreOptions& options);

}  // namespace hitpipe::rtl
