// A design and a format as the caller names them.
#pragma once

#include <stdexcept>

#include "library/failure.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::library {

struct Choice {
  const rtl::Design* design;
  Format format;
};

/// Without a format the default one. Throws a Refusal if there is no such design or format.
[[nodiscard]] Choice chosen(const char* design, const char* format);

/// What `find` gives. What it throws becomes a Refusal with this status.
template <class Found>
auto or_refuse(hitpipe_status status, Found&& find) {
  try {
    return find();
  } catch (const std::runtime_error& refused) {
    throw Refusal(status, refused.what());
  }
}

}  // namespace hitpipe::library
