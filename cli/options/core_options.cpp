#include "cli/options/core_options.hpp"

#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/values.hpp"
#include "rtl_gen/catalogue/format.hpp"
#include "sim/core/memory_port.hpp"

namespace hitpipe::cli {

rtl::CoreOptions CoreChoice::core() const {
  rtl::CoreOptions made = options;
  if (bits) made.bits = rtl::parse_bits<hls::RayBits>(*bits);
  if (!has_model()) made.cache_kib = cache_kib;
  made.stack_bits = 0;
  while (1 << made.stack_bits < places) ++made.stack_bits;
  if (1 << made.stack_bits != places)
    throw std::runtime_error(fmt::format("--stack {}: allowed is a power of two", places));
  return made;
}

void add_core_bits_option(CLI::App& command, std::optional<std::string>& bits, const std::string& otherwise) {
  command
      .add_option("--bits", bits,
                  "Number format of rays, boxes and triangles, for example 20+1/11s20. Default: " + otherwise)
      ->type_name("FORMAT");
}

std::vector<CLI::Option*> add_core_options(CLI::App& command, CoreChoice& choice) {
  CLI::Option* const stack =
      add_count_option(command, "--stack", choice.places, {2, 64}, "Places of a ray's stack, a power of two")
          ->capture_default_str();
  CLI::Option* const levels =
      add_count_option(command, "--levels", choice.options.levels, {2, rtl::CoreOptions::most_levels},
                       "Records on a path through the image")
          ->capture_default_str();
  constexpr const char* serial = "serial";
  CLI::Option* const interval =
      command
          .add_option_function<std::string>(
              "--triangle-ii",
              [&choice](const std::string& text) {
                choice.options.triangle_interval = text == serial ? 0 : std::stoi(text);
              },
              fmt::format("Cycles from one triangle test to the next ({} to 64); or `{}`: a machine with one "
                          "multiplier takes some hundred cycles for one",
                          rtl::CoreOptions::least_triangle_interval, serial))
          ->transform(CLI::Validator(
              [](std::string& text) {
                return text == serial ? std::string()
                                      : number_from(rtl::CoreOptions::least_triangle_interval, 64)(text);
              },
              ""))
          ->default_str(fmt::format("{}", choice.options.triangle_interval))
          ->type_name("N|serial");
  Choices<rtl::Door> doors;
  for (const auto door : {rtl::Door::integer, rtl::Door::binary32})
    doors.emplace_back(rtl::door_name(door), door);
  CLI::Option* const door = add_choice_option(
      command, "--door", choice.options.door, doors,
      "Rays come as integers of the unit int_ray, or as floats, and this unit is in the core");
  CLI::Option* const rings = command.add_flag(
      "--dma", choice.options.rings,
      "The core reads rays from a ring in memory and writes answers to another, by a port of "
      "its own; with --door float");
  CLI::Option* const weights = command.add_flag("--barycentrics", choice.options.weights,
                                                "Answers say where in its triangle a ray hits");
  const Choices<bool> question_lists{{"nearest,any", false}, {"nearest,any,count,next", true}};
  CLI::Option* const questions =
      add_choice_option(command, "--questions", choice.options.questions, question_lists,
                        "What a ray may ask: the nearest hit, any; the count of all crossings, the next one "
                        "behind a place, so that all "
                        "are met in order, each once");
  return {stack, levels, interval, door, rings, weights, questions};
}

std::vector<CLI::Option*> add_one_core_options(CLI::App& command, CoreChoice& choice) {
  CLI::Option* const rays = add_count_option(command, "--rays", choice.options.rays,
                                             {1, rtl::CoreOptions::most_rays}, "Rays in flight")
                                ->capture_default_str();
  std::vector<CLI::Option*> options = add_core_options(command, choice);
  options.push_back(rays);
  return options;
}

std::vector<CLI::Option*> add_core_bus_options(CLI::App& command, CoreChoice& choice) {
  Choices<int> widths;
  for (const int width : {64, 128, 256, 512}) widths.emplace_back(fmt::format("{}", width), width);
  return {add_choice_option(command, "--data-bits", choice.options.data_bits, widths,
                            "Width of the AXI bus to memory; a block has 256 bits"),
          command.add_flag("--in-order", choice.options.in_order,
                           "All AXI requests have one identifier, so memory answers in their order; else "
                           "each ray has its own. A bus that has not 256 bits is always so")};
}

std::vector<CLI::Option*> add_core_cache_options(CLI::App& command, CoreChoice& choice, int most_kib) {
  static constexpr int least = 2, most = rtl::CoreOptions::most_cache_kib;
  CLI::Option* const cache =
      command
          .add_option(
              "--cache", choice.cache_kib,
              fmt::format("KiB of a cache in the core, a power of two from {} to {}; 0 is none{}", least,
                          most,
                          most_kib == most ? ""
                                           : fmt::format(". A larger one, up to {}, is a model in front of "
                                                         "memory, with 8 ways and lines of 64 bytes",
                                                         most_kib)))
          ->check(CLI::Validator(
              [most_kib](std::string& text) {
                const auto kib = host::number_in<int>(text);
                const bool allowed =
                    kib && (*kib == 0 || (*kib >= least && *kib <= most_kib && (*kib & (*kib - 1)) == 0));
                return allowed ? std::string()
                               : fmt::format("Value {} is not 0 or a power of two from {} to {}",
                                             host::shortened(text), least, most_kib);
              },
              ""))
          ->capture_default_str()
          ->type_name("KIB");
  const auto one_of = [&](const char* name, int& value, const char* what,
                          std::initializer_list<int> allowed) {
    Choices<int> choices;
    for (const int each : allowed) choices.emplace_back(fmt::format("{}", each), each);
    return add_choice_option(command, name, value, choices, what)->needs(cache);
  };
  return {cache, one_of("--cache-line", choice.options.cache_line, "Bytes of a line of the cache", {32, 64}),
          one_of("--cache-ways", choice.options.cache_ways, "Lines of a set of the cache", {4, 8})};
}

void add_memory_option(CLI::App& command, std::string& memory) {
  std::string text = "The memory behind the bus. ";
  for (const sim::KnownMemory& each : sim::known_memories())
    text += fmt::format("{}: {}. ", each.name, each.what);
  text += fmt::format(
      "A JSON file has some of these figures: {}. They may also follow a name: ideal,latency=1..200",
      sim::figure_names());
  command.add_option("--memory", memory, text)->capture_default_str()->type_name("NAME|FILE");
}

namespace {

CLI::Option* add_width_option(CLI::App& command, const char* name, int& value, CountRange allowed,
                              const char* what) {
  return add_count_option(command, name, value, allowed, what)->capture_default_str();
}

}  // namespace

std::vector<CLI::Option*> add_core_port_options(CLI::App& command, CoreChoice& choice) {
  rtl::CoreOptions& options = choice.options;
  return {add_width_option(command, "--block-bits", options.address_bits, {4, 32},
                           "Bits of a block's number in the image; a block has 32 bytes"),
          add_width_option(command, "--address-bits", options.byte_bits, {9, 64},
                           "Bits of an address, at least 5 more than of a block's number"),
          add_width_option(command, "--tag-bits", options.tag_bits, {1, 64}, "Bits of a ray's tag"),
          add_width_option(
              command, "--block-rams", options.block_rams, {0, rtl::CoreOptions::most_block_rams},
              "Mark memories for so many block RAMs of 16 bits, as iCE40 has them, where Yosys takes "
              "registers")};
}

std::vector<CLI::Option*> add_core_limit_options(CLI::App& command, CoreChoice& choice) {
  rtl::CoreOptions& options = choice.options;
  return {add_width_option(command, "--number-bits", options.number_bits, {4, hls::triangle_number_bits},
                           "Bits of a triangle's number"),
          add_width_option(command, "--leaf-bits", options.leaf_bits, {2, hls::child_count_bits},
                           "Bits of the number of triangles in a leaf"),
          add_width_option(command, "--step-bits", options.step_bits, {4, hls::step_count_bits},
                           "Bits of the number of records that a ray may test")};
}

}  // namespace hitpipe::cli
