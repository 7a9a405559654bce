// A design at a format, as the C interface holds it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hitpipe/ref.h"
#include "rays/mesh/ray.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/software/box_software.hpp"

struct hitpipe_unit {
  /// Throws what make_box_test() throws of a design that tests boxes.
  hitpipe_unit(const hitpipe::rtl::Design& its_design, const hitpipe::Format& its_format)
      : design(&its_design),
        name(its_design.name),
        format(to_string(its_format)),
        ports(its_design.ports(its_format)),
        results(its_design.results(its_format)),
        boxes_per_test(static_cast<std::size_t>(its_design.kind.objects)),
        test(its_design.kind.of_boxes ? hitpipe::sim::make_box_test(its_design, its_format) : nullptr),
        evaluate(its_design.evaluate(its_format)) {}

  const hitpipe::rtl::Design* design;
  std::string name;
  std::string format;
  std::vector<hitpipe::rtl::Port> ports;
  std::vector<hitpipe::hls::Result> results;
  std::size_t boxes_per_test;
  std::unique_ptr<hitpipe::sim::BoxTest> test;  ///< null: the design tests no boxes
  hitpipe::rtl::Evaluate evaluate;
  std::optional<hitpipe::ref::Ray> ray{};  ///< nothing: none is set
};
