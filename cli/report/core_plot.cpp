#include "cli/report/core_plot.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/world_options.hpp"
#include "cli/report/plot.hpp"
#include "cli/report/sweep_plot.hpp"
#include "rtl_gen/catalogue/format.hpp"

namespace hitpipe::cli {

namespace {

double rate_of(const CoreResult& result) {
  return result.trace.mrays_s(result.clock_ps);
}

/// Points "x y" that share a style.
struct PointLine {
  std::string title;
  std::string points;
};

std::string& points_of(std::vector<PointLine>& lines, const std::string& title) {
  auto line =
      std::find_if(lines.begin(), lines.end(), [&](const PointLine& each) { return each.title == title; });
  if (line == lines.end()) line = lines.insert(lines.end(), {title, ""});
  return line->points;
}

std::string plot_lines(const std::vector<PointLine>& lines, const char* with) {
  std::string blocks, plot;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const DesignStyle style = design_style(i);
    blocks += data_block(fmt::format("line{}", i), lines[i].points);
    plot += fmt::format("{} $line{} using 1:2 with {} lc rgb '{}' pt {} ps {:g} lw 1.5 title {}",
                        i == 0 ? "plot" : ",", i, with, style.colour, style.shape, style.size,
                        gnuplot_string(lines[i].title));
  }
  return blocks + plot + "\n";
}

std::string rate_plot(const std::string& scene, const CoreFacts& facts) {
  const bool on_chip = facts.results.front().price.taken.luts > 0;
  const auto area = [&](const CoreResult& result) {
    return on_chip ? static_cast<double>(result.price.taken.luts)
                   : static_cast<double>(result.price.area_um2) * 1e-6;
  };
  std::vector<double> areas, rates;
  for (const std::size_t i : facts.rates) {
    areas.push_back(area(facts.results[i]));
    rates.push_back(rate_of(facts.results[i]));
  }
  const LogAxis x(areas);
  const LogAxis y(rates);
  const Mark size = plot_size();
  std::vector<UnitMark> marks;
  std::vector<PointLine> lines;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const CoreSetting& setting = facts.results[facts.rates[i]].setting;
    points_of(lines, "core of " + rtl::to_string(rtl::Format(usual_ray_format(setting.world)))) +=
        fmt::format("{:.6g} {:.6g}\n", areas[i], rates[i]);
    marks.push_back({"",
                     fmt::format("II {}, {} rays", setting.triangle_interval, setting.rays),
                     {x.share(areas[i]) * size.x, y.share(rates[i]) * size.y}});
  }
  std::string text = plot_head(scene + ": rays a second and area of a core", lines.size());
  text += fmt::format(
      "set logscale xy\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\nset xtics ({})\n"
      "set ytics ({})\nset xlabel {}\nset ylabel 'rays a second, millions'\n",
      x.least(), x.most(), y.least(), y.most(), x.tics(), y.tics(),
      gnuplot_string(on_chip ? "lookup tables of the core" : "logic of the core, mm²"));
  return text + mark_labels(marks, size) + plot_lines(lines, "points");
}

std::string busy_plot(const std::string& scene, const CoreFacts& facts) {
  std::vector<PointLine> lines;
  std::set<int> rays;
  for (const std::size_t i : facts.busy) {
    const CoreResult& result = facts.results[i];
    rays.insert(result.setting.rays);
    points_of(lines, fmt::format("latency of {} cycles", result.setting.latency)) +=
        fmt::format("{} {:.6g}\n", result.setting.rays, result.trace.port_busy_pct());
  }
  return plot_head(scene + ": the memory port of a core and rays in flight", lines.size()) +
         fmt::format(
             "set logscale x 2\nset xrange [{}:{}]\nset yrange [0:101]\nset xtics ({})\n"
             "set xlabel 'rays in flight'\nset ylabel 'cycles with a request, %'\n",
             0.95 * *rays.begin(), 1.05 * *rays.rbegin(), fmt::join(rays, ",")) +
         plot_lines(lines, "linespoints");
}

std::string cache_plot(const std::string& scene, const CoreFacts& facts) {
  std::string points, tics;
  double most = 0;
  for (std::size_t i = 0; i < facts.cache.size(); ++i) {
    const CoreResult& result = facts.results[facts.cache[i]];
    const int kib = result.setting.cache_kib;
    const double bytes = result.trace.bytes_a_ray();
    most = std::max(most, bytes);
    tics += fmt::format("{}'{}' {}", i == 0 ? "" : ", ", kib == 0 ? "none" : fmt::format("{} KiB", kib), i);
    points += fmt::format("{} {:.6g} {:.4g}\n", i, bytes, bytes);
  }
  const DesignStyle style = design_style(0);
  return plot_head(scene + ": what a cache saves", 0) +
         fmt::format(
             "unset key\nset xrange [-0.3:{}]\nset yrange [0:{:.6g}]\nset xtics ({})\nset xlabel 'cache'\n"
             "set ylabel 'bytes that a ray reads from memory'\n{}"
             "plot $cache using 1:2 with linespoints lc rgb '{}' pt {} ps {:g} lw 1.5, "
             "$cache using 1:2:3 with labels offset 0,1\n",
             static_cast<double>(facts.cache.size()) - 0.7, 1.1 * most, tics, data_block("cache", points),
             style.colour, style.shape, style.size);
}

}  // namespace

std::vector<Drawing> draw_core(const std::string& scene, const CoreFacts& facts) {
  if (facts.results.empty()) return {};
  const CoreSetting& usual = facts.results[facts.cache.front()].setting;
  const std::string core =
      fmt::format("{} with a triangle test every {} cycles",
                  rtl::to_string(rtl::Format(usual_ray_format(usual.world))), usual.triangle_interval);
  return {
      {"core_rate.svg", run_gnuplot("report", rate_plot(scene, facts)),
       "Rays a second of each core against its area",
       fmt::format("At each mark: cycles from one triangle test to the next (II), and rays in flight. Memory "
                   "answers after {} cycles. Columns mrays_s and area_mm2 of core.csv, on a chip luts. "
                   "Bits of memories are apart: memory_bits.",
                   usual.latency)},
      {"core_busy.svg", run_gnuplot("report", busy_plot(scene, facts)),
       "How busy the memory port of a core is against rays in flight, by latency of the memory",
       fmt::format("A core of {}. Column port_busy_pct of core.csv. The last rays of a picture leave few "
                   "in flight, so a small picture cannot keep the port busy to the end.",
                   core)},
      {"core_cache.svg", run_gnuplot("report", cache_plot(scene, facts)),
       "Bytes that a ray reads from memory, by the size of a cache",
       fmt::format("A core of {}, {} rays in flight. Lines of 64 bytes, 8 ways. In a larger picture more "
                   "rays share what they read. Column bytes_a_ray of "
                   "core.csv.",
                   core, usual.rays)}};
}

}  // namespace hitpipe::cli
