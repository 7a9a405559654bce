#include "cli/text/core_fit_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "area_model/figure.hpp"
#include "host/format.hpp"
#include "rtl_gen/core/feature.hpp"

namespace hitpipe::cli {

namespace {

/// Of 80 columns: the share and its interval are one column.
Row with_share_in_text(Row row) {
  const auto pct = [&](const char* column) {
    return fmt::format("{:.2g}", row.at(std::string("other_triangles_pct") + column).get<double>());
  };
  const std::string share = fmt::format("{} ({} to {})", pct(""), pct("_low"), pct("_high"));
  for (const char* const column :
       {"other_triangles_pct", "other_triangles_pct_low", "other_triangles_pct_high"})
    row.erase(column);
  row["others, %"] = share;
  if (row.contains("different_pixels")) {
    row["pixels"] = row.at("different_pixels");
    row.erase("different_pixels");
  }
  return row;
}

}  // namespace

Row core_row(const rtl::CoreOptions& core, const area::CorePartPrice& price, const sim::CoreRate& rate,
             const rtl::Library& library) {
  const rtl::CoreOption& triangles = rtl::core_option("--triangle-ii");
  Row row{{"bits", to_string(Format(core.bits))},
          {"rays_in_flight", core.rays},
          {"triangle_ii", triangles.text(triangles.get(core))},
          {"stack", 1 << core.stack_bits},
          {"cache_kib", rtl::core_option("--cache").get(core)},
          {"levels", core.levels},
          {"block_bits", core.address_bits},
          {"address_bits", core.byte_bits},
          {"tag_bits", core.tag_bits},
          {"number_bits", core.number_bits},
          {"leaf_bits", core.leaf_bits},
          {"step_bits", core.step_bits}};
  if (library.chip() == nullptr) {
    row["area_mm2"] = area::area_mm2(price.area_um2);
  } else {
    row["lut"] = price.taken.luts;
    row["ff"] = price.taken.registers;
    row["dsp"] = price.taken.blocks;
  }
  row["memory_bits"] = price.memory_bits;
  row["clock_ps"] = rate.clock_ps;
  row["cycles_a_ray"] = *std::max_element(rate.cycles_a_ray.begin(), rate.cycles_a_ray.end());
  row["mrays_s"] = rate.rays_per_second() / 1e6;
  return row;
}

Row cut_row(const sim::CoreCut& cut, const area::CorePartPrice& fitted, const rtl::Library& library) {
  const std::int64_t with = sim::size_of(fitted, library), without = sim::size_of(cut.without, library);
  return {{"left_out", cut.what},
          {"share_pct", 100.0 * static_cast<double>(without - with) / static_cast<double>(without)},
          {"why", cut.why}};
}

void add_other_triangles(Row& row, const ref::Share& rays) {
  const ref::Interval interval = rays.percent_interval();
  row.update({{"compared", rays.whole},
              {"other_triangles_pct", rays.percent()},
              {"other_triangles_pct_low", interval.low},
              {"other_triangles_pct_high", interval.high}});
}

std::string shares_table(const std::vector<Row>& rows) {
  std::vector<Row> made;
  for (const Row& row : rows) made.push_back(with_share_in_text(row));
  return table_text(made, OutputFormat::text);
}

}  // namespace hitpipe::cli
