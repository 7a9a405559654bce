#include "cli/options/trace_options.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "cli/options/values.hpp"
#include "hls/box/int_format.hpp"
#include "host/format.hpp"

namespace hitpipe::cli {

namespace {

using ref::Algorithm;
using ref::Arithmetic;

const Choices<Algorithm> algorithms{{"slabs", Algorithm::slabs},
                                    {"plu", Algorithm::plu},
                                    {"slabs-dist", Algorithm::slabs_dist},
                                    {"slabs-dsa", Algorithm::slabs_dsa},
                                    {"plu-dsa", Algorithm::plu_dsa}};
const Choices<Arithmetic> arithmetics{{"float", Arithmetic::binary32},
                                      {"double", Arithmetic::binary64},
                                      {"conservative", Arithmetic::conservative},
                                      {"integer", Arithmetic::integer}};

template <class Value>
std::string word_for(const Choices<Value>& choices, Value value) {
  const auto found =
      std::find_if(choices.begin(), choices.end(), [&](const auto& each) { return each.second == value; });
  return found == choices.end() ? "?" : found->first;
}

}  // namespace

std::string trace_options_text(const ref::TracerOptions& options) {
  const std::string bits =
      options.arithmetic == Arithmetic::integer ? " --bits " + to_string(Format(options.bits)) : "";
  return fmt::format("--traversal {} --arithmetic {}{}", word_for(algorithms, options.algorithm),
                     word_for(arithmetics, options.arithmetic), bits);
}

void add_light_options(CLI::App& command, ref::WhittedOptions& options) {
  add_count_option(command, "--bounces", options.bounces, {0, ref::WhittedOptions::most_bounces},
                   "How many times a ray may be mirrored, refracted or scattered")
      ->capture_default_str();
  add_count_option(
      command, "--diffuse", options.diffuse, {0, ref::WhittedOptions::most_samples},
      "Rays in random directions from each matt surface that the eye sees, for the light of other "
      "surfaces; later surfaces send one")
      ->capture_default_str();
  add_count_option(command, "--occlusion", options.occlusion, {0, ref::WhittedOptions::most_samples},
                   "Short shadow rays in random directions from the same surfaces, for ambient occlusion")
      ->capture_default_str();
  add_large_count_option(command, "--light-seed", options.seed, 0, std::numeric_limits<std::uint64_t>::max(),
                         "Seed of these directions; the same seed gives the same picture (0 to 2^64 - 1)");
}

void add_ray_list_options(CLI::App& command, RayListChoice& choice) {
  CLI::Option* const rays =
      as_input(command.add_option("--rays", choice.file,
                                  "The rays of this file in place of a picture's: .bin or .rays, or CSV with "
                                  "the columns ox,oy,oz,dx,dy,dz[,length,any]"))
          ->type_name("FILE");
  for (const char* const other :
       {"--width", "--height", "--bounces", "--diffuse", "--occlusion", "--light-seed"})
    if (const CLI::Option* const option = command.get_option_no_throw(other))
      exclude(rays, option, "the rays of a file make no picture");
  as_output(command.add_option("--answers", choice.answers,
                               "CSV file for a line a ray: triangle, distance and weights of the corners, "
                               "and the exact answer"))
      ->needs(rays);
}

void exclude_answers_of_pieces(CLI::App& command) {
  for (const char* const pieces : {"--pieces", "--piece", "--join"})
    exclude(command.get_option("--answers"), command.get_option(pieces), "pieces keep counts only");
}

ref::TracerOptions TraceChoice::options() const {
  ref::TracerOptions chosen = tracer;
  if (!bits) return chosen;
  if (chosen.arithmetic != ref::Arithmetic::integer)
    throw std::runtime_error("--bits " + *bits + ": only --arithmetic integer has them; leave --bits out");
  chosen.bits = parse_bits<hls::IntBits>(*bits);
  return chosen;
}

hls::WorldBits TraceChoice::world_bits() const {
  return bits ? parse_bits<hls::WorldBits>(*bits) : hls::WorldBits{};
}

void add_trace_options(CLI::App& command, TraceChoice& choice) {
  using ref::Encoding;
  using ref::TriangleTest;
  ref::TracerOptions& tracer = choice.tracer;
  add_choice_option<World>(
      command, "--world", choice.world, {{"float", World::floats}, {"integer", World::integers}},
      "integer: rays, boxes and triangles are integers, and nothing is lost after the door");
  add_choice_option<Algorithm>(
      command, "--traversal", tracer.algorithm, algorithms,
      "Box test and order of children: fixed, nearer box first (dist), or by direction and "
      "split axis (dsa)");
  add_choice_option<Arithmetic>(
      command, "--arithmetic", tracer.arithmetic, arithmetics,
      "Arithmetic of the box test. conservative: floats widened by a proven bound, never misses, slabs only");
  command
      .add_option(
          "--bits", choice.bits,
          "Number format of integer arithmetic (default: 24/24), or of the integer world (default: 20+1s20)")
      ->type_name("n/t|n+gsS");
  add_choice_option<Encoding>(
      command, "--encoding", tracer.encoding,
      {{"plain", Encoding::plain},
       {"h4", Encoding::hierarchical_4},
       {"h8", Encoding::hierarchical_8},
       {"h12", Encoding::hierarchical_12},
       {"h16", Encoding::hierarchical_16},
       {"wide4", Encoding::wide4},
       {"wide8", Encoding::wide8},
       {"wide4-float", Encoding::wide4_float},
       {"wide8-float", Encoding::wide8_float},
       {"pair6", Encoding::pair6},
       {"pair8", Encoding::pair8},
       {"pair10", Encoding::pair10}},
      "Encoding of the nodes. plain; h4, h8, h12, h16: so many bits relative to the "
      "parent; wide4, wide8: so many children, with 8-bit planes; wide4-float, "
      "wide8-float: with floats; pair6, pair8, pair10: two children in one record, so "
      "many bytes a child. wide takes --traversal slabs-dist")
      ->type_name("NAME");
  command.add_flag("--lut", tracer.look_up_table, "Decode h4 and h8 by table");
  add_choice_option<int>(command, "--bundle", tracer.bundle, {{"1", 1}, {"64", 64}, {"256", 256}},
                         "Maximum number of rays traced together");
  add_choice_option<TriangleTest>(
      command, "--triangle-test", tracer.triangle_test,
      {{"exact", TriangleTest::exact}, {"float", TriangleTest::binary32}, {"double", TriangleTest::binary64}},
      "exact: one answer for every traversal; others: Moeller and Trumbore's");
  for (const char* const other :
       {"--traversal", "--arithmetic", "--encoding", "--lut", "--bundle", "--triangle-test"}) {
    command.get_option(other)->check([&choice, other](const std::string&) {
      return choice.world == World::integers
                 ? fmt::format("{} excludes --world integer, which has one way to trace", other)
                 : std::string();
    });
  }
}

}  // namespace hitpipe::cli
