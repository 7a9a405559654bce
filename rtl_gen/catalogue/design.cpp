#include "rtl_gen/catalogue/design.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/text.hpp"

namespace hitpipe::rtl {

namespace {

std::deque<Design>& all() {
  static std::deque<Design> list = own_designs();
  return list;
}

std::atomic<bool> were_read = false;  ///< designs() was called

[[noreturn]] void no_such_format(const Design& design, std::string_view text) {
  const FormatFamily& family = design.default_format.family();
  throw std::runtime_error(fmt::format(
      "bits {}: no format of {}; allowed is {}{}", host::shortened(text), design.name, family.allowed(),
      family.single ? "" : ", for example " + family.print(family.for_example)));
}

void check(const Design& design, const Format& format) {
  if (&format.family() != &design.default_format.family() || !format.valid())
    no_such_format(design, to_string(format));
}

/// Of the first box.
std::optional<std::size_t> place_of(std::span<const hls::Result> results, hls::Meaning meaning) {
  const auto found = std::find_if(results.begin(), results.end(), [&](const hls::Result& result) {
    return result.meaning == meaning && result.box == 0;
  });
  if (found == results.end()) return std::nullopt;
  return static_cast<std::size_t>(found - results.begin());
}

}  // namespace

Format Design::parse_format(std::string_view text) const {
  const FormatFamily& family = default_format.family();
  const auto numbers = family.parse(text);
  if (!numbers || !family.valid(*numbers)) no_such_format(*this, text);
  return {family, *numbers};
}

std::vector<Port> Design::ports(const Format& format) const {
  check(*this, format);
  return ports_at(format);
}

std::vector<hls::Result> Design::results(const Format& format) const {
  check(*this, format);
  return results_at(format);
}

Graph Design::trace(const Format& format) const {
  check(*this, format);
  return trace_at(format);
}

Evaluate Design::evaluate(const Format& format) const {
  check(*this, format);
  return {run_at(format), format, results_at(format)};
}

std::optional<Evaluate> Design::evaluate_on_float_unit(const Format& format) const {
  check(*this, format);
  const Evaluate::Run run = float_unit_run_at == nullptr ? nullptr : float_unit_run_at(format);
  if (run == nullptr) return std::nullopt;
  return Evaluate(run, format, results_at(format));
}

std::string Design::name_at(const Format& format) const {
  return format.family().single ? std::string(name) : fmt::format("{} {}", name, to_string(format));
}

std::string Design::module_at(const Format& format) const {
  return format == default_format ? std::string(name) : fmt::format("{}_{}", name, format.identifier());
}

std::string Design::bits_option(const Format& format) const {
  return format.family().single ? "" : " --bits " + to_string(format);
}

std::size_t place_of_hit(std::span<const hls::Result> results) {
  if (const auto place = place_of(results, hls::Meaning::hit)) return *place;
  throw std::invalid_argument("none of a design's results is HIT of the first box");
}

Verdict verdict_of(std::span<const hls::Result> results) {
  if (const auto place = place_of(results, hls::Meaning::hit)) return {*place, true};
  if (const auto place = place_of(results, hls::Meaning::error)) return {*place, false};
  throw std::invalid_argument("none of a design's results is HIT of the first box, or an error");
}

Evaluate::Evaluate(Run run, const Format& format, std::span<const hls::Result> results)
    : run_(run), format_(format), verdict_(verdict_of(results)), result_count_(results.size()) {
  if (results.size() > most_results)
    throw std::invalid_argument(fmt::format("a design has 1 to {} results", most_results));
}

void Evaluate::throw_no_hit() {
  throw std::logic_error("a design without HIT was asked for it");
}

void check_kind(const Design& design) {
  const std::vector<hls::Result> results = design.results_at(design.default_format);
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument(
        fmt::format("design {} is of kind {}: {}", design.name, design.kind.name, why));
  };
  const auto require = [&](hls::Meanings wanted, int object) {
    for (const hls::Result& result : results)
      if (result.box == object) wanted &= ~hls::meanings(result.meaning);
    if (wanted == 0) return;
    const auto missing = meaning_names.at(static_cast<std::size_t>(std::countr_zero(wanted)));
    refuse(fmt::format("it needs the result {} of number {}", missing, object));
  };
  for (const hls::Result& result : results)
    if (result.box < 0 || result.box >= design.kind.objects)
      refuse(fmt::format("its result {} is of number {}, a test answers for {}", result.name, result.box,
                         design.kind.objects));
  for (int object = 0; object < design.kind.objects; ++object) require(design.kind.of_each, object);
  require(design.kind.of_the_test, 0);
}

const std::deque<Design>& designs() {
  were_read = true;
  return all();
}

void add_design(Design design) {
  for (const Design& known : all())
    if (known.name == design.name)
      throw std::invalid_argument(fmt::format("design {}: there is one of that name", design.name));
  if (were_read)
    throw std::invalid_argument(
        fmt::format("design {}: add it before the first use of the list of designs", design.name));
  all().push_back(std::move(design));
}

std::string design_names() {
  std::vector<std::string_view> names;
  for (const Design& d : designs()) names.push_back(d.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

const Design& find_design(std::string_view name) {
  for (const Design& d : designs())
    if (d.name == name) return d;
  throw std::runtime_error(
      fmt::format("design {}: unknown; there are: {}", host::shortened(name), design_names()));
}

std::optional<std::size_t> place_of(const Design& design) {
  const auto found = std::find_if(designs().begin(), designs().end(),
                                  [&](const Design& each) { return each.name == design.name; });
  if (found == designs().end()) return std::nullopt;
  return static_cast<std::size_t>(found - designs().begin());
}

}  // namespace hitpipe::rtl
