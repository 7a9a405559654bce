// Designs and units: what there is, and what its ports are.
#include <algorithm>

#include "library/choice.hpp"
#include "library/failure.hpp"
#include "library/unit.hpp"

namespace hitpipe::library {

namespace {

template <class Ours, class Theirs>
constexpr bool same(Ours ours, Theirs theirs) {
  return static_cast<int>(ours) == static_cast<int>(theirs);
}
static_assert(same(HITPIPE_ORIGIN, hls::Role::origin) && same(HITPIPE_ORIGIN_HIGH, hls::Role::origin_high) &&
              same(HITPIPE_ENDPOINT, hls::Role::endpoint) && same(HITPIPE_DIRECTION, hls::Role::direction) &&
              same(HITPIPE_INVERSE, hls::Role::inverse) &&
              same(HITPIPE_INVERSE_LOW, hls::Role::inverse_low) &&
              same(HITPIPE_INVERSE_HIGH, hls::Role::inverse_high) &&
              same(HITPIPE_LENGTH, hls::Role::length) && same(HITPIPE_ENDLESS, hls::Role::endless) &&
              same(HITPIPE_PLANE_LOW, hls::Role::plane_low) &&
              same(HITPIPE_PLANE_HIGH, hls::Role::plane_high) &&
              same(HITPIPE_EXPONENT, hls::Role::exponent) && same(HITPIPE_BACKWARD, hls::Role::backward) &&
              same(HITPIPE_ENTRY, hls::Role::entry) && same(HITPIPE_OWNER, hls::Role::owner) &&
              same(HITPIPE_MAJOR, hls::Role::major) && same(HITPIPE_OTHER, hls::Role::other) &&
              same(HITPIPE_CORNER, hls::Role::corner));
static_assert(same(HITPIPE_INTEGER, hls::Kind::integer) && same(HITPIPE_NATURAL, hls::Kind::natural) &&
              same(HITPIPE_REAL, hls::Kind::real) && same(HITPIPE_FLAG, hls::Kind::flag));
static_assert(same(HITPIPE_HIT, hls::Meaning::hit) && same(HITPIPE_ENTERS, hls::Meaning::entry) &&
              same(HITPIPE_LEAVES, hls::Meaning::exit) && same(HITPIPE_SECOND_FIRST, hls::Meaning::order) &&
              same(HITPIPE_DETERMINANT, hls::Meaning::determinant) &&
              same(HITPIPE_EDGE_V_LOW, hls::Meaning::edge_v_low) &&
              same(HITPIPE_ERROR, hls::Meaning::error) && same(HITPIPE_RAY_LENGTH, hls::Meaning::length) &&
              same(HITPIPE_TIE, hls::Meaning::tie) && same(HITPIPE_SIDE, hls::Meaning::side) &&
              same(HITPIPE_INNER, hls::Meaning::inner));

/// What does not change, as strings that C can read.
struct Facts {
  std::string name;
  std::string summary;
  std::string default_format;
  std::string formats;
};

const std::vector<Facts>& facts() {
  static const std::vector<Facts> all = [] {
    std::vector<Facts> each;
    for (const rtl::Design& design : rtl::designs())
      each.push_back({std::string(design.name), std::string(design.summary), to_string(design.default_format),
                      design.default_format.family().allowed()});
    return each;
  }();
  return all;
}

std::unique_ptr<hitpipe_unit> opened(const char* design_name, const char* format_text) {
  const auto [design, format] = chosen(design_name, format_text);
  return std::make_unique<hitpipe_unit>(*design, format);
}

/// What a function without a status answers: `none` for a null pointer, which hitpipe_error() then names.
template <class Answer, class Read>
Answer told(const hitpipe_unit* unit, Answer none, Read&& read) {
  static_cast<void>(guarded([&] { none = read(given(unit, "unit")); }));
  return none;
}

hitpipe_port_info described(const rtl::Port& port) {
  return {.name = port.name.c_str(),
          .width = port.width,
          .is_signed = port.is_signed ? 1 : 0,
          .kind = static_cast<hitpipe_kind>(*port.kind),
          .role = static_cast<hitpipe_role>(port.role),
          .axis = static_cast<int>(port.axis) - static_cast<int>(hls::Axis::x),
          .box = port.box,
          .min = port.range->low,
          .max = port.range->high};
}

}  // namespace
}  // namespace hitpipe::library

using namespace hitpipe::library;  // NOLINT(google-build-using-namespace): what follows is this namespace's,
                                   // in C

size_t hitpipe_design_count(void) {
  return hitpipe::rtl::designs().size();
}

hitpipe_status hitpipe_design(size_t index, hitpipe_design_info* out) {
  return guarded([&] {
    check_index(index, facts().size(), "design");
    const Facts& its = facts()[index];
    const hitpipe::rtl::Design& design = hitpipe::rtl::designs()[index];
    given(out, "out") = {.name = its.name.c_str(),
                         .summary = its.summary.c_str(),
                         .default_format = its.default_format.c_str(),
                         .formats = its.formats.c_str(),
                         .conservative = design.conservative ? 1 : 0,
                         .boxes_per_test = design.kind.objects};
  });
}

hitpipe_status hitpipe_check_format(const char* design, const char* format) {
  return guarded([&] { static_cast<void>(chosen(design, format)); });
}

hitpipe_status hitpipe_open(const char* design, const char* format, hitpipe_unit** out) {
  return guarded([&] {
    hitpipe_unit*& place = given(out, "out");
    place = opened(design, format).release();
  });
}

void hitpipe_close(hitpipe_unit* unit) {
  const std::unique_ptr<hitpipe_unit> owned(unit);
}

const char* hitpipe_unit_design(const hitpipe_unit* unit) {
  return told(unit, "", [](const hitpipe_unit& its) { return its.name.c_str(); });
}

const char* hitpipe_unit_format(const hitpipe_unit* unit) {
  return told(unit, "", [](const hitpipe_unit& its) { return its.format.c_str(); });
}

int hitpipe_unit_conservative(const hitpipe_unit* unit) {
  return told(unit, 0, [](const hitpipe_unit& its) { return its.design->conservative ? 1 : 0; });
}

size_t hitpipe_unit_boxes_per_test(const hitpipe_unit* unit) {
  return told(unit, std::size_t{0}, [](const hitpipe_unit& its) { return its.boxes_per_test; });
}

size_t hitpipe_port_count(const hitpipe_unit* unit) {
  return told(unit, std::size_t{0}, [](const hitpipe_unit& its) { return its.ports.size(); });
}

hitpipe_status hitpipe_port(const hitpipe_unit* unit, size_t index, hitpipe_port_info* out) {
  return guarded([&] {
    const auto& ports = given(unit, "unit").ports;
    check_index(index, ports.size(), "port");
    given(out, "out") = described(ports[index]);
  });
}

size_t hitpipe_result_count(const hitpipe_unit* unit) {
  return told(unit, std::size_t{0}, [](const hitpipe_unit& its) { return its.results.size(); });
}

hitpipe_status hitpipe_result(const hitpipe_unit* unit, size_t index, hitpipe_result_info* out) {
  return guarded([&] {
    const auto& results = given(unit, "unit").results;
    check_index(index, results.size(), "result");
    const hitpipe::hls::Result& result = results[index];
    given(out, "out") = {.name = result.name,
                         .width = result.width,
                         .is_signed = result.is_signed ? 1 : 0,
                         .meaning = static_cast<hitpipe_meaning>(result.meaning),
                         .box = result.box};
  });
}
