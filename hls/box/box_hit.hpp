// The result of a unit that answers for one box.
#pragma once

#include "hls/box/operand.hpp"

namespace hitpipe {
namespace hls {

template <class Bit>
struct BoxHit {
  Bit hit;

  /// Calls visit(Result, field) for every result port. `Self` may be const.
  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& /*format*/, Self& self, Visit&& visit) {
    visit(Result{"hit", Meaning::hit, 0, 1, false}, self.hit);
  }
};

}  // namespace hls
}  // namespace hitpipe
