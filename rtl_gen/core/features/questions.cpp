// Rays may want crossings: their count, and the next one behind a place (docs/integer_world.md, Exactly once). The
// triangle unit says what it is sure of, and the machine `ties` settles hits at edges and corners.
#include <array>

#include <fmt/format.h>

#include "hls/machines/best_hits.hpp"
#include "hls/machines/door.hpp"
#include "hls/machines/reader.hpp"
#include "hls/machines/replies.hpp"
#include "hls/machines/ties.hpp"
#include "hls/machines/weights.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl::features::questions {

namespace {

using namespace hls::channels;

constexpr int crossings = 3;  // of the format: count and next

constexpr std::array links{
    link<Compares>("divider", "best_hits"),
    link<Settled, hls::List<tested, hit, tester, again>>("ties", "reader"),
    link<Settled, Tested>("ties", "divider"),
    link<hls::ties::SettledNumbers, hls::ties::Numbers>("ties", "divider"),
    link<hls::ties::Next, Retests>("ties", "triangle_feed"),
};

/// What the triangle unit says again of each test: the name, an output of triangle_feed, an input of ties.
struct OfTest {
  std::string_view name, given, taken;
  int width;
};
constexpr std::array of_tests{
    OfTest{"is", test_is.name(), hls::ties::tested_is.name(), test_bits},
    OfTest{"once", test_once.name(), hls::ties::tested_once.name(), 1},
    OfTest{"down", test_down.name(), hls::ties::tested_down.name(), 1},
};

void ask(CorePlan& plan, const CoreOptions& options) {
  const std::vector<CorePin> pins{
      input(ray_once, "1: the next crossing, or with ray_any their count"),
      input(ray_from_t, "the next crossing has this T and number or later ones"),
      input(ray_from_number, ""),
  };
  plan.add_pins_behind(ray_any.name(), pins);
  if (!plan.has("ray")) return;
  // It passes on what a ray asks.
  const int widths[] = {1, options.bits.distance(), hls::triangle_number_bits};
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const std::string name = pins[i].name.substr(std::string_view("ray_").size());
    plan.carried.push_back({"ray", name, widths[i]});
    CorePin& pin = plan.pin(pins[i].name);
    pin.part = "ray";
    pin.of = "in_" + name;
    plan.broadcasts.back().renamed.emplace_back("out_" + name, pin.name);
  }
}

void change(CorePlan& plan, const CoreOptions& options) {
  const auto number = plan.bits<hls::BestBits>("best_hits").number;
  plan.change<hls::DoorBits>("door", [&](hls::DoorBits& bits) {
    bits.questions = 1;
    bits.number = number;
  });
  plan.change<hls::ReaderBits>("reader", [](hls::ReaderBits& bits) { bits.questions = 1; });
  for (const char* const machine : {"triangle_feed", "divider"})
    plan.change<hls::CoreBits>(machine, [](hls::CoreBits& bits) { bits.crossings = crossings; });
  plan.change<hls::BestBits>("best_hits", [](hls::BestBits& bits) { bits.questions = 1; });
  const int answer = plan.bits<hls::BestBits>("best_hits").answer_width();
  plan.change<hls::ReplyBits>("replies", [&](hls::ReplyBits& bits) {
    bits.questions = 1;
    bits.distance = answer;
  });
  if (plan.has("weights"))
    plan.change<hls::WeightBits>("weights", [&](hls::WeightBits& bits) { bits.distance = answer; });
  plan.change<hls::WorldBits>("triangle", [](hls::WorldBits& bits) { bits.crossings = crossings; });
  plan.add_behind("divider", {"ties", "ties", plan.part("divider").format});
  plan.add_links(links);
  plan.unit("triangle").takers = {"ties"};
  for (const OfTest& each : of_tests) {
    plan.carried.push_back({"triangle", std::string(each.name), each.width});
    plan.wires.push_back(
        {"triangle_feed", std::string(each.given), "triangle", fmt::format("in_{}", each.name)});
    plan.wires.push_back({"triangle", fmt::format("out_{}", each.name), "ties", std::string(each.taken)});
  }
  ask(plan, options);
}

CHeaderPart c_header(const Core& core) {
  return {.functions = fmt::format(R"(
/* Of a ray that counted: the sum of the sides of its crossings. */
static inline int64_t core_sides(const struct core_hit* hit) {{
  const uint64_t sign = (uint64_t)1 << {0};
  return (int64_t)((hit->t ^ sign) - sign);
}}
)",
                                   core.answer_bits() - 1)};
}

}  // namespace

const Feature& feature() {
  static const Feature feature{
      .name = "questions",
      .what = "questions count and next",
      .summary = "rays may ask for count and next crossings",
      .smallest = "--questions nearest,any,count,next",
      .is_in = [](const CoreOptions& options) { return options.questions; },
      .options =
          {{.group = CoreOption::Group::core,
            .name = "--questions",
            .help =
                "What a ray may ask: the nearest hit, any; the count of all crossings, the next one behind "
                "a place, so that all are met in order, each once",
            .get = number_at<&CoreOptions::questions>,
            .set = put_number<&CoreOptions::questions>,
            .words = {{"nearest,any", 0}, {"nearest,any,count,next", 1}}}},
      .excludes = {{"rings", "rays at pins"}, {"serial_triangle", "a triangle unit"}},
      .change = change,
      .identify = [](CoreIdentity& identity,
                     const CoreOptions& options) { identity.put("questions", options.questions ? 1 : 0); },
      .c_header = c_header,
      .harness = "questions",
      .promises = {{"a number is in one place, what a ray asks stays",
                    "door",
                    "t4i1q1",
                    {{"s/t_1_value_mux = ray_any ? ray_length/t_1_value_mux = ~ray_any ? ray_length/"}}},
                   {"one answer a ray, and no count is a miss",
                    "replies",
                    "t4g1i1q1u4",
                    {{R"(s/counting\[leaving_ray\]/counting[ray_1]/)"}}},
                   {"a leaf in turn, a triangle again if it ties",
                    "reader",
                    "a4i2q1",
                    {{"s/goes_on = .*;/goes_on = next_granted;/"}}},
                   {"an answer is the best hit, or count and sides",
                    "best_hits",
                    "t4c1d4i1q1u4",
                    {{"s/side_is_down_xor = .*;/side_is_down_xor = hit_back_1;/"}}},
                   {"a tie is settled by its moved tests",
                    "ties",
                    "8+0s8c3i1",
                    {{R"(s/still = meets_word \& zero_1/still = zero_1/)"}}},
                   {"a triangle once, with its moved ray",
                    "triangle_feed",
                    "8+0s8c3i1",
                    {{"s/along_b = .*;/along_b = tests_word[1];/"}}},
                   {.what = "the core with them",
                    .test = "CoreWithQuestions.CountsAndWalksThroughAllCrossings"}}};
  return feature;
}

}  // namespace hitpipe::rtl::features::questions
