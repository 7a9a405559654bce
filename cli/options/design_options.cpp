#include "cli/options/design_options.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/values.hpp"
#include "host/talk.hpp"
#include "host/text.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/schedule/sharing.hpp"

namespace hitpipe::cli {

namespace {

void append_once(std::vector<Format>& formats, const Format& format) {
  if (std::find(formats.begin(), formats.end(), format) == formats.end()) formats.push_back(format);
}

/// The formats of these designs: "n/t with n in .. for int_slabs, int_plucker; fp32, which .. for fp_slabs".
std::string spellings(const std::vector<const rtl::Design*>& designs) {
  std::vector<std::pair<const FormatFamily*, std::vector<std::string_view>>> users;
  for (const rtl::Design* const design : designs) {
    const FormatFamily* const family = &design->default_format.family();
    auto found = std::find_if(users.begin(), users.end(), [&](const auto& u) { return u.first == family; });
    if (found == users.end()) found = users.insert(users.end(), {family, {}});
    found->second.push_back(design->name);
  }
  std::vector<std::string> parts;
  for (const auto& [family, names] : users)
    parts.push_back(fmt::format("{} for {}", family->allowed(), fmt::join(names, ", ")));
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

void add_design_options(CLI::App& command, DesignChoice& choice) {
  command.add_option("design", choice.name, "A name that `hitpipe list designs` shows")
      ->required()
      ->type_name("NAME");
  command
      .add_option("--bits", choice.bits,
                  "Number format. `hitpipe list designs --format json` shows the formats of each design. "
                  "n/t: n bits of a coordinate, t bits kept of a product")
      ->type_name("FORMAT");
}

DesignChoice DesignsChoice::only(const std::string& command) const {
  if (names.size() != 1)
    throw std::runtime_error(
        fmt::format("{}: {} designs; allowed is one of: {}", command, names.size(), rtl::design_names()));
  if (bits.size() > 1)
    throw std::runtime_error(fmt::format("{}: {} formats; allowed is one", command, bits.size()));
  return {names.front(), bits.empty() ? std::nullopt : std::optional(bits.front())};
}

std::vector<const rtl::Design*> DesignsChoice::designs(WhyNot why_not) const {
  std::vector<const rtl::Design*> chosen;
  for (const std::string& name : names) {
    const rtl::Design& design = rtl::find_design(name);
    if (const std::string why = why_not(design); !why.empty()) throw std::runtime_error(why);
    if (std::find(chosen.begin(), chosen.end(), &design) == chosen.end()) chosen.push_back(&design);
  }
  if (!names.empty()) return chosen;
  for (const rtl::Design& design : rtl::designs()) {
    if (!design.kind.of_boxes) continue;
    const std::string why = why_not(design);
    if (why.empty()) {
      chosen.push_back(&design);
    } else {
      host::note(fmt::format("{}; left out", why));
    }
  }
  return chosen;
}

std::vector<sim::DesignFormats> DesignsChoice::formats(const std::vector<const rtl::Design*>& designs,
                                                       const Formats& otherwise) const {
  std::vector<sim::DesignFormats> all;
  for (const rtl::Design* const design : designs) all.push_back({design, {}});
  for (const std::string& text : bits) {
    const std::size_t equals = text.find('=');
    const std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    const std::string format = equals == std::string::npos ? text : text.substr(equals + 1);
    // Families may share a spelling: some take any eEmM, others only e8m23.
    const auto has = [&](const sim::DesignFormats& each) {
      const FormatFamily& family = each.design->default_format.family();
      const std::optional<FormatNumbers> numbers = family.parse(format);
      return numbers && family.valid(*numbers);
    };
    const bool some_have = name.empty() && std::any_of(all.begin(), all.end(), has);
    bool taken = false;
    for (sim::DesignFormats& each : all) {
      if (!name.empty() && each.design->name != name) continue;
      const FormatFamily& family = each.design->default_format.family();
      if (name.empty() && (some_have ? !has(each) : !family.parse(format))) continue;
      append_once(each.formats, each.design->parse_format(format));
      taken = true;
    }
    if (taken) continue;
    if (!name.empty())
      throw std::runtime_error(fmt::format("bits {}: design {} is not among those asked for",
                                           host::shortened(text), host::shortened(name)));
    const auto same_family = [&](const rtl::Design* design) {
      return &design->default_format.family() == &designs.front()->default_format.family();
    };
    if (std::all_of(designs.begin(), designs.end(), same_family))
      static_cast<void>(designs.front()->parse_format(text));  // throws
    throw std::runtime_error(
        fmt::format("bits {}: allowed is {}", host::shortened(text), spellings(designs)));
  }
  for (sim::DesignFormats& each : all)
    if (each.formats.empty()) each.formats = otherwise(*each.design);
  return all;
}

CLI::Option* add_designs_option(CLI::App& command, DesignsChoice& choice, const std::string& otherwise) {
  return command
      .add_option(
          "design", choice.names,
          fmt::format("Names that `hitpipe list designs` shows, separated by commas or blanks. Default: {}",
                      otherwise))
      ->delimiter(',')
      ->type_name("NAME");
}

CLI::Option* add_bits_option(CLI::App& command, DesignsChoice& choice, const std::string& otherwise) {
  return add_list_option(command, "--bits", choice.bits,
                         fmt::format("Number formats. FORMAT is for every design that has it, DESIGN=FORMAT "
                                     "for one design. Default: {}",
                                     otherwise),
                         "FORMAT");
}

void add_library_option(CLI::App& command, std::string& library) {
  as_input(command.add_option("--library", library,
                              fmt::format("Component library, a built-in one ({}) or a file NAME.json",
                                          fmt::join(rtl::built_in_names(), ", "))))
      ->type_name("NAME|FILE")
      ->capture_default_str();
}

void add_block_luts_option(CLI::App& command, std::optional<int>& block_luts) {
  add_count_option(command, "--block-luts", block_luts, {0, 1'000'000},
                   "Lookup tables that a multiplier block is worth: an odd piece of a product takes a block "
                   "only if logic would take more. Default: the library's");
}

CLI::Option* add_interval_option(CLI::App& command, int& value, const std::string& more) {
  return add_count_option(command, "--ii", value, {1, rtl::most_interval},
                          "Initiation interval: a test may begin every N cycles, and operations share "
                          "components where that makes the unit smaller" +
                              more)
      ->capture_default_str();
}

CLI::Option* add_intervals_option(CLI::App& command, std::vector<int>& values, const std::string& what) {
  return add_list_option(command, "--ii", values,
                         fmt::format("Initiation intervals: {} (1 to {})", what, rtl::most_interval), "N")
      ->transform(number_from(1, rtl::most_interval));
}

CLI::Option* add_flow_control_option(CLI::App& command, rtl::FlowControl& value, const std::string& more) {
  Choices<rtl::FlowControl> choices;
  for (const auto flow : {rtl::FlowControl::stall, rtl::FlowControl::none})
    choices.emplace_back(rtl::flow_control_name(flow), flow);
  return add_choice_option(
      command, "--flow-control", value, choices,
      "stall: valid and ready on both sides, and the pipeline stands still while a result "
      "waits; none: a result comes a fixed number of cycles after its operands, and "
      "nothing waits" +
          more);
}

}  // namespace hitpipe::cli
