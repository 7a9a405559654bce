#include "cli/report/unit_marks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::cli {

namespace {

constexpr double hidden = 0.75 * mark_radius;  // so near, one mark hides another of its size
constexpr double larger_below = 0.45;          // for each mark above

double distance(const Mark& a, const Mark& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

bool hide(const PlotMark& a, const PlotMark& b) {
  return a.design != b.design && distance(a.place, b.place) < hidden;
}

/// "24/24", "24/28" and "16/16" become "24/24,28 16/16".
std::string joined(const std::vector<std::string>& formats) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_head;
  for (const std::string& format : formats) {
    const std::size_t slash = format.find('/');
    const std::string head = slash == std::string::npos ? format : format.substr(0, slash + 1);
    if (by_head.empty() || by_head.back().first != head || slash == std::string::npos)
      by_head.emplace_back(head, std::vector<std::string>());
    if (slash != std::string::npos) by_head.back().second.push_back(format.substr(slash + 1));
  }
  std::vector<std::string> texts;
  for (const auto& [head, tails] : by_head) texts.push_back(head + fmt::format("{}", fmt::join(tails, ",")));
  return fmt::format("{}", fmt::join(texts, " "));
}

/// Some marks of a design.
struct Cluster {
  std::vector<std::size_t> marks;
  Mark sum{0, 0};

  [[nodiscard]] Mark middle() const {
    const auto count = static_cast<double>(marks.size());
    return {sum.x / count, sum.y / count};
  }
  void add(const Cluster& other) {
    marks.insert(marks.end(), other.marks.begin(), other.marks.end());
    sum = {sum.x + other.sum.x, sum.y + other.sum.y};
  }
};

/// Joins marks of one design that cover one another.
std::vector<Cluster> clusters_of(std::span<const PlotMark> marks) {
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < marks.size(); ++i) clusters.push_back({{i}, marks[i].place});
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    for (std::size_t j = i + 1; j < clusters.size(); ++j) {
      if (marks[clusters[i].marks[0]].design != marks[clusters[j].marks[0]].design ||
          !cover(clusters[i].middle(), clusters[j].middle()))
        continue;
      clusters[i].add(clusters[j]);
      clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(j));
      i = static_cast<std::size_t>(-1);  // the middle has moved: look at all again
      break;
    }
  }
  return clusters;
}

const char* gnuplot_name(Align align) {
  return align == Align::left ? "left" : align == Align::right ? "right" : "center";
}

}  // namespace

DesignStyle style_of(const std::string& design) {
  return design_style(rtl::place_of(rtl::find_design(design)).value());
}

void enlarge_hidden(std::vector<PlotMark>& marks) {
  std::vector<int> above(marks.size(), 0);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      if (hide(marks[i], marks[j])) above[i] = std::max(above[i], above[j] + 1);
    const double larger = 1 + larger_below * above[i];
    marks[i].style.size *= larger;
    marks[i].place.radius *= larger;
  }
}

std::string marks_data(std::span<const PlotMark> marks) {
  std::vector<const PlotMark*> order;
  for (const PlotMark& mark : marks) order.push_back(&mark);
  std::ranges::stable_sort(order, std::greater(), [](const PlotMark* mark) { return mark->place.radius; });
  std::string lines;
  for (const PlotMark* mark : order) {
    lines += fmt::format("{:.6g} {:.6g} {:.4g} {} 0x{} \"{}\" \"{}\"\n", mark->x, mark->y, mark->style.size,
                         mark->style.shape, mark->style.colour.substr(1), mark->design, mark->name);
  }
  return data_block("marks", lines);
}

std::string marks_plot() {
  return "$marks using 1:2:3:4:5 with points pt variable ps variable lc rgb variable lw 1.5 notitle";
}

std::string mark_key(const DesignStyle& style, const std::string& title) {
  return fmt::format("keyentry with points lc rgb '{}' pt {} ps {:g} lw 1.5 title {}", style.colour,
                     style.shape, style.size, gnuplot_string(title));
}

std::vector<MarkLabel> unit_labels(std::span<const PlotMark> marks) {
  std::vector<MarkLabel> labels;
  for (const Cluster& cluster : clusters_of(marks)) {
    const auto from_middle = [&](std::size_t mark) { return distance(marks[mark].place, cluster.middle()); };
    const std::size_t middle = *std::ranges::min_element(cluster.marks, {}, from_middle);
    const std::string& design = marks[middle].design;
    std::vector<std::string> formats;
    bool hidden_by_others = false;
    for (const std::size_t i : cluster.marks) {
      formats.push_back(marks[i].name);
      for (const PlotMark& other : marks) hidden_by_others = hidden_by_others || hide(marks[i], other);
    }
    const bool single = rtl::find_design(design).default_format.family().single;
    labels.push_back({single             ? design
                      : hidden_by_others ? design + " " + joined(formats)
                                         : joined(formats),
                      middle});
  }
  return labels;
}

std::vector<MarkLabel> name_labels(std::span<const PlotMark> marks) {
  std::vector<MarkLabel> labels;
  for (std::size_t i = 0; i < marks.size(); ++i) labels.push_back({marks[i].name, i});
  return labels;
}

PlacedLabels place_mark_labels(std::span<const MarkLabel> labels, std::span<const PlotMark> marks,
                               std::span<const PlotSegment> lines, const Mark& size) {
  std::vector<Mark> places;
  std::vector<std::string> texts;
  std::vector<bool> labelled(marks.size(), false);
  for (const MarkLabel& label : labels) {
    places.push_back(marks[label.mark].place);
    texts.push_back(label.text);
    labelled[label.mark] = true;
  }
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (!labelled[i]) places.push_back(marks[i].place);
  const std::vector<LabelPlace> found = place_labels(places, texts, size, lines);
  PlacedLabels placed;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const LabelPlace& p = found[i];
    if (!p.clear) {
      ++placed.left_out;
      continue;
    }
    placed.settings +=
        fmt::format("set label {} at graph {:.4f},{:.4f} {} front boxed\n", gnuplot_string(texts[i]),
                    p.anchor() / size.x, p.middle / size.y, gnuplot_name(p.align));
    if (p.line) {
      placed.settings +=
          fmt::format("set arrow from graph {:.4f},{:.4f} to graph {:.4f},{:.4f} nohead lc rgb '#666666'\n",
                      places[i].x / size.x, places[i].y / size.y, p.anchor() / size.x, p.middle / size.y);
    }
  }
  return placed;
}

}  // namespace hitpipe::cli
