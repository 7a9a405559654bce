// 95 % intervals of figures that are measured on a sample.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hitpipe::ref {

struct Interval {
  double low;
  double high;
};

/// Wilson's score interval of a share, `part` of `whole` independent cases. 0..1 when `whole` is 0.
[[nodiscard]] Interval wilson_interval(std::uint64_t part, std::uint64_t whole);

/// Cases of which some are counted, each by itself.
struct Share {
  std::uint64_t part = 0, whole = 0;
  /// 0 of none.
  [[nodiscard]] double percent() const;
  /// Wilson's.
  [[nodiscard]] Interval percent_interval() const;
};

/// The median of measured values, and its interval by their order alone, which needs no law of their spread. It has 95
/// % or more; fewer than six values have none.
struct Middle {
  double median = 0;
  std::optional<Interval> interval{};
};
/// Of at least one value.
[[nodiscard]] Middle middle_of(std::vector<double> values);
/// Of times over other times, run by run. There are as many of both, at least one.
[[nodiscard]] Middle middle_ratio(std::span<const double> above, std::span<const double> below);

/// A sum over another sum, when cases come in groups that resemble each other: the boxes of one ray, the rays
/// of one tile. The groups are independent, the cases of a group are not.
class GroupedRatio {
 public:
  /// A group's share of both sums. A group with nothing in either says nothing and is not counted.
  void add(double above, double below);
  GroupedRatio& operator+=(const GroupedRatio& other);

  /// All that it knows, to be kept in a file: groups, both sums, the sums of both squares and of the
  /// products.
  using Sums = std::array<double, 6>;
  [[nodiscard]] Sums sums() const;
  [[nodiscard]] static GroupedRatio of(const Sums& sums);

  [[nodiscard]] std::uint64_t groups() const { return groups_; }
  /// 0 when there is no group.
  [[nodiscard]] double ratio() const;
  /// By the spread among the groups, linearised; symmetrical, so its ends may be less than 0. From minus to
  /// plus infinity with less than two groups.
  [[nodiscard]] Interval interval() const;
  /// The standard deviation of ratio(), linearised. With two groups or more.
  [[nodiscard]] double deviation() const;
  /// When the sum above counts some of what the sum below counts. Wilson's interval for as many independent
  /// cases as would spread as much as the groups do, at most all cases. When no case or every case is counted
  /// the spread says nothing, and each group is one case.
  [[nodiscard]] Interval share_interval() const;

 private:
  [[nodiscard]] double variance() const;

  // Whole numbers, exact up to 2^53, so the order of adding changes nothing.
  std::uint64_t groups_ = 0;
  double above_ = 0;
  double below_ = 0;
  double above_squared_ = 0;
  double below_squared_ = 0;
  double product_ = 0;
};

/// Work above that of a reference, in percent of the reference's. Cases come in groups, such as the rays of one pixel;
/// the groups are independent, the cases of a group are not.
class ExtraWork {
 public:
  /// What a group took, and what it takes in the reference.
  void add(std::uint64_t work, std::uint64_t reference);
  ExtraWork& operator+=(const ExtraWork& other);

  /// 0 when there is no group.
  [[nodiscard]] double percent() const;
  /// 95 %; nothing from less than two groups. While no group takes less than its reference, the spread grows with the
  /// extra work, as that of a count does. So it is a score interval, whose low end is not below 0. Without any extra
  /// work it goes from 0 to Wilson's bound on the share of groups with some, each as if its work doubled.
  [[nodiscard]] std::optional<Interval> percent_interval() const;

 private:
  GroupedRatio groups_;
  std::uint64_t with_more_ = 0, with_less_ = 0;  ///< groups
};

}  // namespace hitpipe::ref
