#include "cli/report/label_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hitpipe::cli {

namespace {

constexpr double letter_width = 7.0;  // in 12-pixel sans-serif, rounded up
constexpr double line_height = 15.0;
constexpr double gap = 9.0;        // between mark and label
constexpr double line_step = 4.0;  // between points of a line that are looked at
constexpr int steps_off = 24;      // how many lines above and below are tried
constexpr std::array<double, 5> steps_out{0, 20, 50, 90, 140};

struct Rectangle {
  double left, right, low, high;

  [[nodiscard]] bool meets(const Rectangle& other) const {
    return left < other.right && other.left < right && low < other.high && other.low < high;
  }
};

}  // namespace

std::vector<LabelPlace> place_labels(std::span<const Mark> marks, std::span<const std::string> texts,
                                     Mark plot_size) {
  std::vector<Rectangle> taken;
  for (const Mark& m : marks)
    taken.push_back({m.x - mark_radius, m.x + mark_radius, m.y - mark_radius, m.y + mark_radius});
  const auto free = [&](const Rectangle& r) {
    return r.left >= 0 && r.right <= plot_size.x && r.low >= 0 && r.high <= plot_size.y &&
           std::none_of(taken.begin(), taken.end(), [&](const Rectangle& t) { return r.meets(t); });
  };
  // Points on the line between mark and label, without its ends.
  const auto along = [](const Mark& from, const LabelPlace& to) {
    std::vector<Rectangle> points;
    const double length = std::hypot(to.line_x - from.x, to.middle - from.y);
    for (double at = 1.5 * mark_radius; at < length - line_height / 2; at += line_step) {
      const double share = at / length;
      const double x = std::lerp(from.x, to.line_x, share);
      const double y = std::lerp(from.y, to.middle, share);
      points.push_back({x - 1, x + 1, y - 1, y + 1});
    }
    return points;
  };
  const auto clear = [&](const Mark& from, const LabelPlace& to) {
    const auto points = along(from, to);
    return std::none_of(points.begin(), points.end(), [&](const Rectangle& point) {
      const bool at_mark = std::abs((point.left + point.right) / 2 - from.x) <= 1.5 * mark_radius &&
                           std::abs((point.low + point.high) / 2 - from.y) <= 1.5 * mark_radius;
      return !at_mark && !free(point);
    });
  };
  std::vector<LabelPlace> places;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const Mark& m = marks[i];
    const double width = letter_width * static_cast<double>(texts[i].size());
    const auto at = [&](bool to_right, int lines_up, double farther) {
      const double left = to_right ? m.x + gap + farther : m.x - gap - farther - width;
      return LabelPlace{left, m.y + line_height * lines_up, lines_up != 0 || farther > 0,
                        to_right ? left - 2 : left + width};
    };
    // Above or below the mark, in its middle.
    const auto over = [&](int lines_up) {
      return LabelPlace{m.x - width / 2, m.y + line_height * lines_up, std::abs(lines_up) > 1, m.x};
    };
    const auto box = [&](const LabelPlace& p) {
      return Rectangle{p.left, p.left + width, p.middle - line_height / 2, p.middle + line_height / 2};
    };
    // First beside the mark, on the right, then on the left; then higher or lower, and farther away.
    const auto find = [&](bool with_clear_line) {
      for (int step = 0; step <= 2 * steps_off; ++step) {
        const int up = step % 2 == 1 ? (step + 1) / 2 : -step / 2;
        if (up != 0 && free(box(over(up))) && (!with_clear_line || std::abs(up) == 1 || clear(m, over(up))))
          return std::optional(over(up));
        for (const double farther : steps_out) {
          for (const bool to_right : {true, false}) {
            const LabelPlace place = at(to_right, up, up == 0 ? farther : farther + line_height);
            if (free(box(place)) && (!with_clear_line || !place.line || clear(m, place)))
              return std::optional(place);
          }
        }
      }
      return std::optional<LabelPlace>();
    };
    std::optional<LabelPlace> found = find(true);
    if (!found) found = find(false);
    const LabelPlace chosen = found.value_or(at(true, 0, 0));
    taken.push_back(box(chosen));
    if (chosen.line) {
      const auto points = along(m, chosen);
      taken.insert(taken.end(), points.begin(), points.end());
    }
    places.push_back(chosen);
  }
  return places;
}

}  // namespace hitpipe::cli
