// Prints the table of docs/measured/pruning.md: what demand sets save of each design's area, account built,
// thesis_250nm.
#include <fmt/format.h>

#include "area_model/price.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "tests/rtl_gen/prune/demand_sets.hpp"

namespace {

using namespace hitpipe;

double percent(std::int64_t part, std::int64_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::int64_t area_um2(const rtl::Pipeline& pipeline, const rtl::Design& design,
                      const hitpipe::Format& format) {
  return area::price(pipeline, design, format, rtl::Library::thesis()).area_um2;
}

void print_row(const std::string& name, std::int64_t area, const rtl::Pipeline& pipeline, std::int64_t whole,
               const rtl::PruneReport& report) {
  int port_bits = 0;
  for (const rtl::Port& port : rtl::input_ports(pipeline.graph)) port_bits += port.width;
  fmt::print("| {} | {:.4f} | {:.1f} | {} | {} | {} | {} |\n", name, static_cast<double>(area) / 1e6,
             percent(whole - area, whole), pipeline.latency(), pipeline.schedule.clock_ps, port_bits,
             report.after.nodes);
}

void print_design(const char* name, hitpipe::Format format, bool cuts) {
  const rtl::Design& design = rtl::find_design(name);
  const rtl::Graph traced = design.trace(format);
  const rtl::Pipeline plain = rtl::make_pipeline(traced, rtl::Library::thesis());
  const std::int64_t whole = area_um2(plain, design, format);
  fmt::print(
      "\n| {} {} | mm2 | saved % | stages | clock ps | port bits | nodes |\n|---|---|---|---|---|---|---|\n",
      name, to_string(format));
  print_row("unfitted", whole, plain, whole, {.before = {}, .after = rtl::size_of(plain.graph)});
  std::vector<rtl::DemandSet> sets = rtl::demand_sets(design, format);
  sets.insert(sets.begin(), {"the ports' own ranges", rtl::set_up_demands(design.ports(format))});
  for (const rtl::DemandSet& set : sets) {
    const rtl::Pruned pruned = rtl::prune(traced, set.demands, {.shares = cuts});
    const rtl::Pipeline pipeline = rtl::make_pipeline(pruned.graph, rtl::Library::thesis());
    print_row(set.name, area_um2(pipeline, design, format), pipeline, whole, pruned.report);
    if (!cuts) continue;
    for (const rtl::Cut& cut : pruned.report.cuts) fmt::print("  {}\n", rtl::cut_text(cut));
    for (const rtl::Share& share : pruned.report.shares)
      if (share.bits != 0 || share.nodes != 0)
        fmt::print("  share of {}: {} nodes, {} bits\n", share.demand, share.nodes, share.bits);
  }
}

}  // namespace

int main(int argc, char**) {
  const bool cuts = argc > 1;
  print_design("int_slabs", hls::IntBits{24, 24}, cuts);
  print_design("int_plucker", hls::IntBits{24, 24}, cuts);
  print_design("fp_slabs", hitpipe::Format(hls::Binary32{}), cuts);
  print_design("fp_plucker", hitpipe::Format(hls::Binary32{}), cuts);
}
