#include "cli/options/core_options.hpp"

#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/values.hpp"
#include "rtl_gen/catalogue/format.hpp"

namespace hitpipe::cli {

rtl::CoreOptions CoreChoice::core(const std::optional<std::string>& bits) const {
  rtl::CoreOptions made = options;
  if (bits) made.bits = rtl::parse_bits<hls::RayBits>(*bits);
  made.stack_bits = 0;
  while (1 << made.stack_bits < places) ++made.stack_bits;
  if (1 << made.stack_bits != places)
    throw std::runtime_error(fmt::format("--stack {}: allowed is a power of two", places));
  return made;
}

std::vector<std::string> add_core_options(CLI::App& command, CoreChoice& choice) {
  add_count_option(command, "--stack", choice.places, {2, 64},
                   "Of a core: places of a ray's stack, a power of two")
      ->capture_default_str();
  add_count_option(command, "--levels", choice.options.levels, {2, rtl::CoreOptions::most_levels},
                   "Of a core: records on a path through the image")
      ->capture_default_str();
  constexpr const char* serial = "serial";
  command
      .add_option_function<std::string>(
          "--triangle-ii",
          [&choice](const std::string& text) {
            choice.options.triangle_interval = text == serial ? 0 : std::stoi(text);
          },
          fmt::format("Of a core: cycles from one triangle test to the next ({} to 64); or `{}`: a machine "
                      "with one multiplier takes some hundred cycles for one",
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
  add_choice_option(command, "--door", choice.options.door, doors,
                    "Of a core: rays come as integers of the unit int_ray, or as floats, and this unit is in "
                    "the core");
  command.add_flag("--barycentrics", choice.options.weights,
                   "Of a core: answers say where in its triangle a ray hits");
  return {"--stack", "--levels", "--triangle-ii", "--door", "--barycentrics"};
}

std::vector<std::string> add_one_core_options(CLI::App& command, CoreChoice& choice) {
  add_count_option(command, "--rays", choice.options.rays, {1, rtl::CoreOptions::most_rays},
                   "Of a core: rays in flight")
      ->capture_default_str();
  std::vector<std::string> names = add_core_options(command, choice);
  names.emplace_back("--rays");
  return names;
}

std::vector<std::string> add_core_bus_options(CLI::App& command, CoreChoice& choice) {
  rtl::CoreOptions& options = choice.options;
  Choices<int> widths;
  for (const int width : {64, 128, 256, 512}) widths.emplace_back(fmt::format("{}", width), width);
  add_choice_option(command, "--data-bits", options.data_bits, widths,
                    "Of a core: width of the AXI bus to memory; a block has 256 bits");
  command.add_flag("--in-order", options.in_order,
                   "Of a core: all AXI requests have one identifier, so memory answers in their order; else "
                   "each ray has its own. A bus that has not 256 bits is always so");
  return {"--data-bits", "--in-order"};
}

std::vector<std::string> add_core_port_options(CLI::App& command, CoreChoice& choice) {
  rtl::CoreOptions& options = choice.options;
  add_count_option(command, "--block-bits", options.address_bits, {4, 32},
                   "Of a core: bits of a block's number in the image; a block has 32 bytes")
      ->capture_default_str();
  add_count_option(command, "--address-bits", options.byte_bits, {9, 64},
                   "Of a core: bits of an address, at least 5 more than of a block's number")
      ->capture_default_str();
  add_count_option(command, "--tag-bits", options.tag_bits, {1, 64}, "Of a core: bits of a ray's tag")
      ->capture_default_str();
  add_count_option(command, "--block-rams", options.block_rams, {0, rtl::CoreOptions::most_block_rams},
                   "Of a core: mark memories for so many block RAMs of 16 bits, as iCE40 has them, where "
                   "Yosys takes registers")
      ->capture_default_str();
  return {"--block-bits", "--address-bits", "--tag-bits", "--block-rams"};
}

}  // namespace hitpipe::cli
