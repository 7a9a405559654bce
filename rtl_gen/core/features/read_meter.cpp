// Counts how long memory takes to answer (hls/machines/read_meter.hpp). The numbers are pins, for logic beside the
// core.
#include "hls/machines/read_meter.hpp"

#include <array>
#include <string>

#include "rtl_gen/core/axi_plan.hpp"
#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl::features::read_meter {

namespace {

namespace meter = hls::read_meter;
using namespace hls::channels;

constexpr std::array links{link<hls::List<request_valid, request_id>>("requests", "read_meter")};

// Its other inputs have the names of the core's, and so come from there.
void change(CorePlan& plan, const CoreOptions& options) {
  plan.add_behind("requests", {"read_meter", "read_meter", hls::MeterBits{.ray = options.ray_bits()}});
  plan.add_links(links);
  plan.pins.push_back(output(meter::reads, "read_meter", "blocks that memory has given"));
  plan.pins.push_back(output(meter::waited, "read_meter", "cycles that they took, added up"));
  plan.pins.push_back(output(meter::longest, "read_meter", "the most that one of them took"));
}

void axi(AxiPlan& plan) {
  for (const char* const pin : {meter::reads.name(), meter::waited.name(), meter::longest.name()})
    plan.add_output(pin, "core", pin);
}

}  // namespace

const Feature& feature() {
  static const Feature feature{
      .name = "read_meter",
      .what = "a meter of reads",
      .summary = "pins say how long memory takes",
      .smallest = "--read-meter",
      .is_in = [](const CoreOptions& options) { return options.read_meter; },
      .options = {{.group = CoreOption::Group::core,
                   .name = "--read-meter",
                   .help = "Count at pins how long memory takes for its blocks",
                   .get = number_at<&CoreOptions::read_meter>,
                   .set = put_number<&CoreOptions::read_meter>,
                   .is_flag = true,
                   .json = "read_meter"}},
      .excludes = {{"cache", "blocks from memory"}},
      .change = change,
      .axi = axi,
      .promises = {{"a read as long as it took",
                    "read_meter",
                    "i1c3n3",
                    {{"s/came <= read_valid/came <= read_valid | came/"}}},
                   {.what = "the core with it", .test = "PairedCore.PassesInAllTools"}}};
  return feature;
}

}  // namespace hitpipe::rtl::features::read_meter
