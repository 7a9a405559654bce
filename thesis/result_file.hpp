// A result in a file, with all that the page of judged statements needs, so that machines can share the
// tables (docs/choosing.md).
#pragma once

#include "thesis/result_text.hpp"

namespace hitpipe::thesis {

/// Numbers that JSON does not have are "inf", "-inf" and "nan".
[[nodiscard]] Row kept_result(const ResultTable& table);

/// The same table again. Throws nlohmann's exceptions for another form.
[[nodiscard]] ResultTable parse_result(const Row& row);

}  // namespace hitpipe::thesis
