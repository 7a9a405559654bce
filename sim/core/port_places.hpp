// The place of each port of a core among its inputs or its outputs.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "hls/machines/record.hpp"
#include "rtl_gen/core/core.hpp"

namespace hitpipe::sim {

/// `Fields` are those of hls/machines/channels.hpp, or of machines. The core need not have them all.
template <class Fields>
class PortPlaces {
 public:
  explicit PortPlaces(const rtl::Core& core) : PortPlaces(core, typename Fields::Items()) {}
  template <class Field>
  std::size_t operator[](Field) const {
    return places_[place_in<Field>(typename Fields::Items())];
  }
  template <class Field>
  [[nodiscard]] bool has(Field field) const {
    return (*this)[field] != none;
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};  ///< the core does not have it
  template <auto... F>
  PortPlaces(const rtl::Core& core, hls::List<F...>) : places_{core.place_of(F).value_or(none)...} {}
  template <class Field, auto... F>
  static constexpr std::size_t place_in(hls::List<F...>) {
    static_assert((std::is_same_v<std::remove_const_t<decltype(F)>, Field> || ...));
    std::size_t place = 0;
    static_cast<void>(((std::is_same_v<std::remove_const_t<decltype(F)>, Field> || (++place, false)) || ...));
    return place;
  }
  std::array<std::size_t, Fields::Items::count> places_;
};

}  // namespace hitpipe::sim
