// Designs, formats and prices.
#include <optional>
#include <string>

#include <pybind11/stl.h>

#include "hitpipe/ref.hpp"
#include "library/python/module.hpp"
#include "library/python/working.hpp"

namespace hitpipe::python {

namespace py = pybind11;

namespace {

/// What a library of the other kind does not say is None.
std::optional<std::int64_t> where(bool said, std::int64_t number) {
  return said ? std::optional(number) : std::nullopt;
}

std::string design_text(const DesignInfo& design) {
  return std::string("<hitpipe.Design ") + design.name + ": " + design.formats + ">";
}

std::string price_text(const PriceInfo& price) {
  const std::string time = "<hitpipe.Price: " + std::to_string(price.stages) + " stages of " +
                           std::to_string(price.stage_delay_ps) + " ps, ";
  if (price.is_chip == 0) return time + std::to_string(price.area_um2) + " um2>";
  return time + std::to_string(price.lookup_tables) + " lookup tables, " + std::to_string(price.registers) +
         " registers, " + std::to_string(price.multiplier_blocks) + " multiplier blocks>";
}

PriceInfo priced(const std::string& design, const std::string& format, const std::string& library) {
  const Working others_run;
  return price(design, format, library);
}

}  // namespace

void add_catalogue(py::module_& m) {
  py::class_<DesignInfo>(m, "Design", "What there is to know of a design, whatever its format.")
      .def_readonly("name", &DesignInfo::name)
      .def_readonly("summary", &DesignInfo::summary, "One line.")
      .def_readonly("default_format", &DesignInfo::default_format)
      .def_readonly("formats", &DesignInfo::formats, "Which there are, in words.")
      .def_property_readonly(
          "conservative", [](const DesignInfo& design) { return design.conservative != 0; },
          "Whether HIT is set whenever the exact ray meets the box.")
      .def_readonly("boxes_per_test", &DesignInfo::boxes_per_test)
      .def("__repr__", design_text);
  m.def("designs", designs, "All designs, a list of hitpipe.Design.");
  m.def(
      "check_format",
      [](const std::string& design, const std::string& format) {
        check(hitpipe_check_format(design.c_str(), format.c_str()));
      },
      py::arg("design"), py::arg("format"), "Raises hitpipe.Error if the design has no such format.");

  py::class_<PriceInfo>(m, "Price",
                        "What a unit takes of a component library: without pruning, one test a cycle, as "
                        "`hitpipe area` says it.")
      .def_readonly("stages", &PriceInfo::stages, "Cycles from operands to results.")
      .def_readonly("stage_delay_ps", &PriceInfo::stage_delay_ps, "Of the slowest stage, in picoseconds.")
      .def_property_readonly(
          "area_um2", [](const PriceInfo& price) { return where(price.is_chip == 0, price.area_um2); },
          "Of the whole unit, in square micrometres; None on a chip.")
      .def_property_readonly(
          "lookup_tables",
          [](const PriceInfo& price) { return where(price.is_chip != 0, price.lookup_tables); },
          "None where the library is not a chip's, as with the two that follow.")
      .def_property_readonly(
          "registers", [](const PriceInfo& price) { return where(price.is_chip != 0, price.registers); })
      .def_property_readonly(
          "multiplier_blocks",
          [](const PriceInfo& price) { return where(price.is_chip != 0, price.multiplier_blocks); })
      .def("__repr__", price_text);
  m.def("price", priced, py::arg("design"), py::arg("format") = "", py::arg("library") = "",
        "The hitpipe.Price of a design at a format, \"\" for the default one. The library is a built-in one "
        "such as "
        "\"thesis_250nm\", which \"\" means, or \"xc7\", or a file NAME.json.");
}

}  // namespace hitpipe::python
