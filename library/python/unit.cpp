// A design at a format, and what it answers.
#include <memory>
#include <mutex>
#include <string>

#include <pybind11/stl.h>

#include "hitpipe/ref.hpp"
#include "library/python/arrays.hpp"
#include "library/python/module.hpp"
#include "library/python/names.hpp"
#include "library/python/working.hpp"

namespace hitpipe::python {

namespace {

/// Rows of so many columns.
template <class T>
py::array_t<T> table(std::size_t rows, std::size_t columns) {
  return py::array_t<T>({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)});
}

/// What test_pairs() gives. What was not asked for is None.
struct Arrays {
  py::array_t<bool> hit;
  py::object exact = py::none();
  py::object operands = py::none();
  py::object results = py::none();
};

struct Asked {
  bool exact, operands, results;
};

/// The library's unit is for one thread at a time, and Python's threads may share one of Python's.
class PythonUnit {
 public:
  PythonUnit(const std::string& design, const std::string& format) : own_(design, format) {}

  [[nodiscard]] const Unit& own() const { return own_; }

  Arrays test_pairs(const py::object& rays, const py::object& boxes, const Asked& asked) {
    const auto own_rays = rays_of(rays);
    const std::size_t tests = own_rays.count;
    const auto own_boxes = boxes_of(boxes, tests, own_.boxes_per_test());
    Arrays all;
    all.hit = flags(tests);
    hitpipe_answers out{bytes(all.hit), nullptr, nullptr, nullptr};
    if (asked.exact) {
      auto exact = flags(tests);
      out.exact = bytes(exact);
      all.exact = exact;
    }
    if (asked.operands) {
      auto operands = table<std::int64_t>(tests, own_.ports().size());
      out.operands = operands.mutable_data();
      all.operands = operands;
    }
    if (asked.results) {
      auto results = table<std::int64_t>(tests, own_.results().size());
      out.results = results.mutable_data();
      all.results = results;
    }
    const Working others_run;
    const std::scoped_lock alone(one_thread_);
    check(hitpipe_test_pairs(own_.handle(), own_rays.first, own_boxes.first, tests, &out));
    return all;
  }

  py::array_t<std::int64_t> test_operands(const py::object& operands) {
    const auto given = operands_of(operands, own_.ports().size());
    auto results = table<std::int64_t>(given.count, own_.results().size());
    std::int64_t* const out = results.mutable_data();
    const Working others_run;
    const std::scoped_lock alone(one_thread_);
    check(hitpipe_test_operands(own_.handle(), given.first, given.count, out));
    return results;
  }

  [[nodiscard]] py::array_t<std::uint64_t> port_bits(const py::object& operands) const {
    const auto ports = own_.ports();
    const auto given = operands_of(operands, ports.size());
    auto bits = table<std::uint64_t>(given.count, ports.size());
    std::uint64_t* out = bits.mutable_data();
    for (std::size_t i = 0; i < given.count * ports.size(); ++i)
      *out++ = hitpipe_bits(given.first[i], ports[i % ports.size()].width);
    return bits;
  }

 private:
  /// One for each box of each test.
  [[nodiscard]] py::array_t<bool> flags(std::size_t tests) const {
    if (own_.boxes_per_test() != 1) return table<bool>(tests, own_.boxes_per_test());
    return py::array_t<bool>(static_cast<py::ssize_t>(tests));
  }
  static std::uint8_t* bytes(py::array_t<bool>& array) {
    return reinterpret_cast<std::uint8_t*>(array.mutable_data());
  }

  Unit own_;
  std::recursive_mutex one_thread_;  ///< a signal's handler may use it, too, in the thread that has it
};

/// A port outlives its unit, which owns the name that C gives.
template <class Info>
struct Named : Info {
  explicit Named(const Info& info) : Info(info), own_name(info.name) {}
  std::string own_name;
};
using Port = Named<PortInfo>;
using Result = Named<ResultInfo>;

template <class Info>
std::string port_text(const Named<Info>& port) {
  return std::string("<") + (port.is_signed != 0 ? "signed " : "") + port.own_name + ", " +
         std::to_string(port.width) + " bits>";
}

void add_ports(py::module_& m) {
  py::class_<Port>(m, "Port", "A port for an operand, named as in the Verilog.")
      .def_readonly("name", &Port::own_name)
      .def_readonly("width", &Port::width, "In bits.")
      .def_property_readonly("signed", [](const Port& port) { return port.is_signed != 0; })
      .def_property_readonly(
          "kind", [](const Port& port) { return name_of(port.kind); },
          "\"integer\", \"natural\", \"real\", the pattern of a float, or \"flag\".")
      .def_property_readonly(
          "role", [](const Port& port) { return name_of(port.role); },
          "What it tells the unit, as in <hitpipe/ref.h>: \"plane_low\".")
      .def_readonly("axis", &Port::axis, "0, 1, 2, or -1 if it has none.")
      .def_readonly("box", &Port::box, "Of which box a plane is.")
      .def_readonly("min", &Port::min, "The set-up gives numbers from min to max.")
      .def_readonly("max", &Port::max)
      .def("__repr__", port_text<PortInfo>);
  py::class_<Result>(m, "Result", "A port for a result, named as in the Verilog.")
      .def_readonly("name", &Result::own_name)
      .def_readonly("width", &Result::width, "In bits.")
      .def_property_readonly("signed", [](const Result& result) { return result.is_signed != 0; })
      .def_property_readonly(
          "meaning", [](const Result& result) { return name_of(result.meaning); },
          "As in <hitpipe/ref.h>: \"hit\".")
      .def_readonly("box", &Result::box, "For which box it answers.")
      .def("__repr__", port_text<ResultInfo>);
}

}  // namespace

void add_unit(py::module_& m) {
  add_ports(m);
  py::class_<Arrays>(m, "Answers", "What Unit.test_pairs() gives. What was not asked for is None.")
      .def_readonly("hit", &Arrays::hit, "bool, (N,), or (N, 2) of two boxes a test: HIT, as the Verilog's.")
      .def_readonly("exact", &Arrays::exact, "bool, of the same shape: whether ray and box meet.")
      .def_readonly("operands", &Arrays::operands, "int64, (N, ports), in the order of Unit.ports.")
      .def_readonly("results", &Arrays::results, "int64, (N, results), in the order of Unit.results.");

  py::class_<PythonUnit>(m, "Unit", "A design at a format, \"\" for the default one. Threads may share it.")
      .def(py::init<const std::string&, const std::string&>(), py::arg("design"), py::arg("format") = "")
      .def_property_readonly("design", [](const PythonUnit& unit) { return unit.own().design(); })
      .def_property_readonly("format", [](const PythonUnit& unit) { return unit.own().format(); })
      .def_property_readonly("conservative", [](const PythonUnit& unit) { return unit.own().conservative(); })
      .def_property_readonly("boxes_per_test",
                             [](const PythonUnit& unit) { return unit.own().boxes_per_test(); })
      .def_property_readonly(
          "ports",
          [](const PythonUnit& unit) {
            return std::vector<Port>(unit.own().ports().begin(), unit.own().ports().end());
          },
          "A list of hitpipe.Port.")
      .def_property_readonly(
          "results",
          [](const PythonUnit& unit) {
            return std::vector<Result>(unit.own().results().begin(), unit.own().results().end());
          },
          "A list of hitpipe.Result.")
      .def(
          "test_pairs",
          [](PythonUnit& unit, const py::object& rays, const py::object& boxes, bool exact, bool operands,
             bool results) {
            return unit.test_pairs(rays, boxes, {exact, operands, results});
          },
          py::arg("rays"), py::arg("boxes"), py::kw_only(), py::arg("exact") = true,
          py::arg("operands") = true, py::arg("results") = true,
          "Tests each ray against its box, or its two boxes: hitpipe.Answers. Boxes are (N, 2, 3); of a unit "
          "with\n"
          "two boxes a test they are (N, 2, 2, 3), the children of a parent, which is tested first. What is "
          "not\n"
          "asked for takes no time.")
      .def("test_operands", &PythonUnit::test_operands, py::arg("operands"),
           "The results, int64 (N, results), of operands of your own, int64 (N, ports).")
      .def("port_bits", &PythonUnit::port_bits, py::arg("operands"),
           "Operands as the ports of the Verilog take them: uint64, cut to the widths of the ports.")
      .def(
          "price",
          [](const PythonUnit& unit, const std::string& library) {
            return price(std::string(unit.own().design()), std::string(unit.own().format()), library);
          },
          py::arg("library") = "", "As hitpipe.price() of this design and format.")
      .def("__repr__", [](const PythonUnit& unit) {
        return "<hitpipe.Unit " + std::string(unit.own().design()) + " " + std::string(unit.own().format()) +
               ">";
      });
}

}  // namespace hitpipe::python
