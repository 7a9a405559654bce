// What a design takes of cells or of a chip.
#include "area_model/price.hpp"

#include "library/choice.hpp"
#include "library/failure.hpp"
#include "rtl_gen/component/library.hpp"

using namespace hitpipe::library;  // NOLINT(google-build-using-namespace): what follows is this namespace's,
                                   // in C

hitpipe_status hitpipe_price(const char* design, const char* format, const char* library,
                             hitpipe_price_info* out) {
  return guarded([&] {
    const Choice choice = chosen(design, format);
    hitpipe_price_info& place = given(out, "out");
    const bool is_default = library == nullptr || *library == '\0';
    place = or_refuse(HITPIPE_BAD_LIBRARY, [&]() -> hitpipe_price_info {
      const auto cells = hitpipe::rtl::library_called(is_default ? hitpipe::rtl::default_library : library);
      const auto price =
          hitpipe::area::price(*choice.design, choice.format, cells, hitpipe::area::Account::built);
      return {.stages = price.stages,
              .stage_delay_ps = price.stage_delay_ps,
              .is_chip = cells.chip() == nullptr ? 0 : 1,
              .area_um2 = price.area_um2,
              .lookup_tables = price.taken.luts,
              .registers = price.taken.registers,
              .multiplier_blocks = price.taken.blocks};
    });
  });
}
