#include "sim/software/triangle_software.hpp"

#include <stdexcept>

#include "sim/software/software.hpp"

namespace hitpipe::sim {

std::unique_ptr<TriangleTest> make_triangle_test(const rtl::Design& design, const Format& format) {
  const Software& software = software_of(design);
  if (software.triangle_test == nullptr) throw std::runtime_error(missing(design, triangle_part));
  return software.triangle_test(design, format);
}

}  // namespace hitpipe::sim
