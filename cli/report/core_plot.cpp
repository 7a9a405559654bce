#include "cli/report/core_plot.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/world_options.hpp"
#include "cli/report/plot.hpp"
#include "cli/report/unit_marks.hpp"
#include "rtl_gen/catalogue/format.hpp"

namespace hitpipe::cli {

namespace {

double rate_of(const CoreResult& result) {
  return result.trace.mrays_s();
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

/// What a picture has for all of them, in their order.
struct DrawnLines {
  explicit DrawnLines(const std::vector<PointLine>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const DesignStyle style = design_style(i);
      keys.push_back(lines[i].title);
      blocks += data_block(fmt::format("line{}", i), lines[i].points);
      plots += fmt::format("{} $line{} using 1:2 with linespoints lc rgb '{}' pt {} ps {:g} lw 1.5 title {}",
                           i == 0 ? "plot" : ",", i, style.colour, style.shape, style.size,
                           gnuplot_string(lines[i].title));
    }
  }
  std::vector<std::string> keys;
  std::string blocks, plots;
};

/// The sizes of caches, in KiB, at 0, 1, ...
std::string cache_tics(const std::vector<int>& sizes) {
  std::string tics;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    tics += fmt::format("{}'{}' {}", i == 0 ? "" : ", ",
                        sizes[i] == 0 ? "none" : fmt::format("{} KiB", sizes[i]), i);
  return tics;
}

Picture rate_plot(const std::string& scene, const CoreFacts& facts, const PictureForm& form) {
  const bool on_chip = facts.results.front().price.taken.luts > 0;
  std::vector<double> areas, rates;
  std::vector<std::string> cores, keys;  // of each mark, and each once
  for (const std::size_t i : facts.rates) {
    const CoreResult& result = facts.results[i];
    areas.push_back(on_chip ? static_cast<double>(result.price.taken.luts)
                            : static_cast<double>(result.price.area_um2) * 1e-6);
    rates.push_back(rate_of(result));
    cores.push_back("core of " + rtl::to_string(rtl::Format(usual_ray_format(result.setting.world))));
    if (std::find(keys.begin(), keys.end(), cores.back()) == keys.end()) keys.push_back(cores.back());
  }
  const LogAxis x(areas);
  const LogAxis y(rates);
  const PlotFrame frame = plot_frame(form, on_chip ? "lookup tables of the core" : "logic of the core, mm²",
                                     "rays a second, millions", keys);
  std::vector<PlotMark> marks;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const CoreSetting& setting = facts.results[facts.rates[i]].setting;
    const auto key = static_cast<std::size_t>(std::find(keys.begin(), keys.end(), cores[i]) - keys.begin());
    marks.push_back({cores[i],
                     fmt::format("II {}, {} rays", setting.triangle_interval, setting.rays),
                     design_style(key),
                     areas[i],
                     rates[i],
                     {x.share(areas[i]) * frame.size.x, y.share(rates[i]) * frame.size.y}});
  }
  enlarge_hidden(marks);
  const PlacedLabels labels = place_mark_labels(name_labels(marks), marks, {}, frame.size);
  std::string plots = "plot " + marks_plot();
  for (std::size_t i = 0; i < keys.size(); ++i) plots += ", " + mark_key(design_style(i), keys[i]);
  return {"core_rate",
          scene + ": rays a second and area of a core",
          frame.picture_height,
          frame.settings + axes_settings(x, y, frame.size) + labels.settings + marks_data(marks),
          plots + "\n",
          labels.left_out};
}

Picture busy_plot(const std::string& scene, const CoreFacts& facts, const PictureForm& form) {
  std::vector<PointLine> lines;
  std::set<int> rays;
  for (const std::size_t i : facts.busy) {
    const CoreResult& result = facts.results[i];
    rays.insert(result.setting.rays);
    points_of(lines, fmt::format("latency of {} cycles", result.setting.latency)) +=
        fmt::format("{} {:.6g}\n", result.setting.rays, result.trace.port_busy_pct());
  }
  const DrawnLines drawn(lines);
  const PlotFrame frame = plot_frame(form, "rays in flight", "cycles with a request, %", drawn.keys);
  return {"core_busy", scene + ": the memory port of a core and rays in flight", frame.picture_height,
          frame.settings +
              fmt::format("set logscale x 2\nset xrange [{}:{}]\nset yrange [0:101]\nset xtics ({})\n",
                          0.95 * *rays.begin(), 1.05 * *rays.rbegin(), fmt::join(rays, ",")) +
              drawn.blocks,
          drawn.plots + "\n"};
}

Picture cache_plot(const std::string& scene, const CoreFacts& facts, const PictureForm& form) {
  std::string points;
  std::vector<int> sizes;
  double most = 0;
  for (std::size_t i = 0; i < facts.cache.size(); ++i) {
    const CoreResult& result = facts.results[facts.cache[i]];
    const double bytes = result.trace.bytes_a_ray();
    most = std::max(most, bytes);
    sizes.push_back(result.setting.cache_kib);
    points += fmt::format("{} {:.6g} {:.4g}\n", i, bytes, bytes);
  }
  const DesignStyle style = design_style(0);
  const PlotFrame frame = plot_frame(form, "cache", "bytes that a ray reads from memory", {});
  return {"core_cache", scene + ": what a cache saves", frame.picture_height,
          frame.settings +
              fmt::format("set xrange [-0.3:{}]\nset yrange [0:{:.6g}]\nset xtics ({})\n",
                          static_cast<double>(facts.cache.size()) - 0.7, 1.1 * most, cache_tics(sizes)) +
              data_block("cache", points),
          fmt::format("plot $cache using 1:2 with linespoints lc rgb '{}' pt {} ps {:g} lw 1.5 notitle, "
                      "$cache using 1:2:3 with labels offset 0,1 notitle\n",
                      style.colour, style.shape, style.size)};
}

/// A line for each memory, by cache.
Picture memory_plot(const std::string& scene, const CoreFacts& facts, const PictureForm& form) {
  std::vector<PointLine> lines;
  std::vector<int> sizes;
  double most = 0;
  for (const std::size_t i : facts.memories) {
    const CoreResult& result = facts.results[i];
    const int kib = result.setting.cache_kib;
    auto size = std::find(sizes.begin(), sizes.end(), kib);
    if (size == sizes.end()) size = sizes.insert(sizes.end(), kib);
    const double rate = rate_of(result);
    most = std::max(most, rate);
    points_of(lines, result.setting.memory) += fmt::format("{} {:.6g}\n", size - sizes.begin(), rate);
  }
  const DrawnLines drawn(lines);
  const PlotFrame frame = plot_frame(form, "cache", "rays a second, millions", drawn.keys);
  return {"core_memory", scene + ": rays a second of a core by cache and memory", frame.picture_height,
          frame.settings +
              fmt::format("set xrange [-0.3:{}]\nset yrange [0:{:.6g}]\nset xtics ({})\n",
                          static_cast<double>(sizes.size()) - 0.7, 1.1 * most, cache_tics(sizes)) +
              drawn.blocks,
          drawn.plots + "\n"};
}

}  // namespace

std::vector<Diagrammed> draw_core(const std::string& scene, const CoreFacts& facts, const PictureForm& form) {
  if (facts.results.empty()) return {};
  const CoreSetting& usual = facts.results[facts.cache.front()].setting;
  const std::string core =
      fmt::format("{} with a triangle test every {} cycles",
                  rtl::to_string(rtl::Format(usual_ray_format(usual.world))), usual.triangle_interval);
  return {
      {draw_picture("report", rate_plot(scene, facts, form), form),
       fmt::format("At each mark: cycles from one triangle test to the next (II), and rays in flight. Memory "
                   "answers after {} cycles. Columns mrays_s and area_mm2 of core.csv, on a chip luts. "
                   "Bits of memories are apart: memory_bits.",
                   usual.latency)},
      {draw_picture("report", busy_plot(scene, facts, form), form),
       fmt::format(
           "A core of {}, by latency of the memory. Column port_busy_pct of core.csv. The last rays of "
           "a picture leave few in flight, so a small picture cannot keep the port busy to the end.",
           core)},
      {draw_picture("report", cache_plot(scene, facts, form), form),
       fmt::format("A core of {}, {} rays in flight. Lines of 64 bytes, 8 ways. In a larger picture more "
                   "rays share what they read. Column bytes_a_ray of "
                   "core.csv.",
                   core, usual.rays)},
      {draw_picture("report", memory_plot(scene, facts, form), form),
       fmt::format("A core of {}, {} rays in flight, behind memories as they are: `hitpipe help core trace` "
                   "says what each is. Column mrays_s of core.csv.",
                   core, facts.results[facts.memories.front()].setting.rays)}};
}

}  // namespace hitpipe::cli
