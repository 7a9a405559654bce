// Small chips: a machine with one multiplier tests triangles, in place of the unit int_triangle, its feed and the
// divider (hls/machines/serial_triangle.hpp). A test takes some hundred cycles.
#include <array>

#include "hls/machines/channels.hpp"
#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl::features::serial_triangle {

namespace {

using namespace hls::channels;

constexpr std::array links{
    link<NewNumber>("door", "serial_triangle"),
    link<TriangleRead>("serial_triangle", "best_hits"),
    link<TriangleFlaw>("serial_triangle", "reader"),
    link<hls::List<tested, hit, asked>, Tested>("serial_triangle", "reader"),
    link<Divides>("serial_triangle", "best_hits"),
};

void change(CorePlan& plan, const CoreOptions& /*options*/) {
  const Format format = plan.part("triangle_feed").format;
  plan.add_behind("triangle_feed", {"serial_triangle", "serial_triangle", format});
  for (const char* const part : {"triangle_feed", "divider", "triangle"}) plan.remove(part);
  plan.add_links(links);
}

constexpr int serial = 0;  // what --triangle-ii has in place of cycles

int interval_of(const CoreOptions& options) {
  return options.serial_triangle ? serial : options.triangle_interval;
}

}  // namespace

const Feature& feature() {
  static const Feature feature{
      .name = "serial_triangle",
      .what = "the serial test",
      .summary = "a machine with one multiplier tests triangles",
      .smallest = "--triangle-ii serial",
      .is_in = [](const CoreOptions& options) { return options.serial_triangle; },
      .options = {{.group = CoreOption::Group::core,
                   .name = "--triangle-ii",
                   .help =
                       "Cycles from one triangle test to the next (3 to 64); or `serial`: a machine with one "
                       "multiplier takes some hundred cycles for one",
                   .get = interval_of,
                   .set =
                       [](CoreOptions& options, int interval) {
                         options.serial_triangle = interval == serial;
                         if (interval != serial) options.triangle_interval = interval;
                       },
                   .least = CoreOptions::least_triangle_interval,
                   .most = CoreOptions::most_triangle_interval,
                   .words = {{"serial", serial}},
                   .type = "N|serial",
                   .json = "triangle_ii"}},
      .change = change,
      .identify =
          [](CoreIdentity& identity, const CoreOptions& options) {
            identity.put("serial", options.serial_triangle ? 1 : 0);
            identity.put("triangle_ii", interval_of(options));
          },
      .promises = {{"a triangle once, in bounded time",
                    "serial_triangle",
                    "8+0s8i1",
                    {{R"(s/compares <= last/compares <= last \& best[0]/)"}}},
                   {.what = "its arithmetic", .test = "SerialTriangleIn.GivesExactAnswersInOrder"}}};
  return feature;
}

}  // namespace hitpipe::rtl::features::serial_triangle
