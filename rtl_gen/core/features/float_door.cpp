// Rays come in floats: the unit int_ray, which makes integers of them, is in the core, in front of the door.
#include "hls/machines/channels.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl::features::float_door {

namespace {

using namespace hls::channels;

constexpr int door_interval = 8;  // cycles from ray to ray

/// A pin of the unit `ray`.
CorePin of_unit(auto field, const char* pin, bool is_input, std::string_view comment) {
  return {std::string(field.name()), is_input, "ray", std::string(comment), pin};
}

void change(CorePlan& plan, const CoreOptions& options) {
  plan.parts.push_back({"ray", "int_ray", options.bits, door_interval, FlowControl::stall, options.tag_bits});
  plan.carried.push_back({"ray", "any", 1});
  std::vector<CorePin> pins{
      of_unit(ray_valid, "in_valid", true, "a new ray, in floats"),
      of_unit(ray_ready, "in_ready", false, "it is taken at a clock edge with both high"),
      of_unit(ray_tag, "in_tag", true, "comes back with its answer"),
      of_unit(ray_any, "in_any", true, "1: any hit will do; 0: the nearest"),
  };
  for (const Port& operand : find_design("int_ray").ports(options.bits))
    pins.push_back({"ray_" + operand.name, true, "ray", description(operand), operand.name});
  plan.replace_pins([](const CorePin& pin) { return pin.name.starts_with("ray_"); }, std::move(pins));
  plan.wires.push_back({"door", std::string(ray_ready.name()), "ray", "out_ready"});
  plan.broadcasts.push_back({"ray",
                             "ray",
                             {{"out_valid", std::string(ray_valid.name())},
                              {"out_tag", std::string(ray_tag.name())},
                              {"out_any", std::string(ray_any.name())},
                              {"t_end", std::string(ray_length.name())}}});
}

}  // namespace

const Feature& feature() {
  static const Feature feature{
      .name = "float_door",
      .what = "floats at the door",
      .summary = "rays come in floats",
      .smallest = "--door float",
      .is_in = [](const CoreOptions& options) { return options.float_door; },
      .options =
          {{.group = CoreOption::Group::core,
            .name = "--door",
            .help = "Rays come as integers of the unit int_ray, or as floats, and this unit is in the core",
            .get = number_at<&CoreOptions::float_door>,
            .set = put_number<&CoreOptions::float_door>,
            .words = {{"integer", 0}, {"float", 1}},
            .json = "door"}},
      .change = change,
      .identify = [](CoreIdentity& identity,
                     const CoreOptions& options) { identity.put("floats", options.float_door ? 1 : 0); },
      .harness = "float_door",
      .harness_otherwise = "int_door",
      .promises = {{.what = "the core answers floats as it answers integers",
                    .test = "CoreWithFloats.AnswersAsWithIntegers"}}};
  return feature;
}

}  // namespace hitpipe::rtl::features::float_door
