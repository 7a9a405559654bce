#include "bench/slab_forms/form_verilog.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "hls/experiment/slab_forms.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/trace.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module.hpp"

namespace hitpipe::bench {

namespace {

using rtl::Trace;
using Word = Trace::uint;

/// A call has three operands at most, so some ports hold two of the form's.
Word distance(std::string_view form, const hls::FpBits& format, rtl::Graph& body) {
  namespace forms = hls::slab_forms;
  namespace logic = hls::fp_logic;
  const int m = format.fraction;
  const int magnitude = format.exponent + m;
  const int number = magnitude + 1;
  const auto in = [&](const char* name, int width) { return Word(body.input(name, width, false)); };
  const auto low = [](const Word& x, int width) { return slice(x, width - 1, 0); };
  const Word plane = in("plane", number);
  if (form == "separate" || form == "separate_fused") {
    const Word both = in("inverses", 2 * magnitude);
    const Word offset_and_bound = in("offset_and_bound", number + 1);
    const forms::Inverses<Word> inverses{slice(both, 2 * magnitude - 1, magnitude), low(both, magnitude)};
    const forms::Bound<Word> bound{slice(offset_and_bound, number, number)};
    const Word offset = low(offset_and_bound, number);
    return form == "separate" ? forms::separate<Trace>(format, plane, inverses, offset, bound)
                              : forms::separate_fused<Trace>(format, plane, inverses, offset, bound);
  }
  const Word origin = in("origin", number);
  if (form == "fused") {
    const Word inverse_and_bound = in("inverse_and_bound", magnitude + 1);
    const forms::Bound<Word> bound{slice(inverse_and_bound, magnitude, magnitude)};
    return forms::fused<Trace>(format, plane, origin, low(inverse_and_bound, magnitude), bound);
  }
  const Word inverse = in("inverse", magnitude);
  const Word d = form == "exact" ? forms::subtract_exact<Trace>(format, plane, origin)
                                 : logic::subtract_rz<Trace>(format, plane, origin);
  const int cut = std::max(0, m - (m + 1) / 2 - 2);
  const Word t = form == "short_product"
                     ? forms::multiply_short<Trace>(format, low(d, magnitude), inverse, cut)
                     : logic::multiply_rz<Trace>(format, low(d, magnitude), inverse);
  return cat(hls::sign(d), t);
}

/// The distance stands for a float product, which has these stages.
rtl::Library library(int stages) {
  std::string components;
  for (const char* name : {"latch", "mux2", "int_subtract", "int_multiply", "int_compare", "fp_multiply"})
    components += fmt::format(
        R"({}"{}":{{"above":"same","area":"linear","cells":[{{"bits":64,"area_um2":1,"delay_ps":1,"stages":{}}}]}})",
        components.empty() ? "" : ",", name,
        std::string_view(name) == "fp_multiply" && stages > 1 ? stages : 0);
  return rtl::Library::from_json(
      fmt::format(R"({{"name":"one","source":"none","gate_delay_ps":1,"components":{{{}}}}})", components),
      "one");
}

}  // namespace

std::string form_verilog(std::string_view form, const hls::AnyFpBits& bits, int stages) {
  constexpr std::string_view known[] = {"plain", "exact",    "short_product",
                                        "fused", "separate", "separate_fused"};
  if (std::find(std::begin(known), std::end(known), form) == std::end(known))
    throw std::invalid_argument(
        fmt::format("there is no form \"{}\"; there are: {}", form, fmt::join(known, ", ")));
  rtl::Graph body("distance");
  {
    const rtl::Tracer tracer(body);
    body.output("distance", distance(form, bits, body).id());
  }
  rtl::Graph top("unit");
  std::vector<rtl::NodeId> operands;
  for (const rtl::NodeId input : body.inputs())
    operands.push_back(top.input(body[input].name, body[input].width, false));
  const auto unit =
      std::make_shared<const rtl::Unit>(rtl::Unit{"fp_multiply", bits.width(), rtl::canonical(body)});
  top.output("distance", top.call(unit, operands));
  const rtl::Library one = library(stages);
  return rtl::to_verilog(rtl::make_pipeline(top, one), one);
}

}  // namespace hitpipe::bench
