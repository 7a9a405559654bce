// A logarithmic axis of a plot.
#pragma once

#include <span>
#include <string>

namespace hitpipe::cli {

/// A logarithmic axis that ends where its data does.
class LogAxis {
 public:
  /// Numbers that are not positive have a place of their own below the others, with the tic "≤ 0".
  explicit LogAxis(std::span<const double> values);

  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double most() const { return most_; }
  /// Where a value is drawn: a value of the axis.
  [[nodiscard]] double shown(double value) const { return value > 0 ? value : zero_; }
  /// The position of a value as a fraction of the length.
  [[nodiscard]] double share(double value) const;

  /// Tics as gnuplot takes them: "'1' 1, '2' 2". Their texts have room along an axis of this length.
  [[nodiscard]] std::string tics_across(double length) const;
  [[nodiscard]] std::string tics_upward(double length) const;

 private:
  struct Tic {
    std::string text;
    double value;
  };
  /// `room` is what a text takes along the axis.
  template <class Room>
  [[nodiscard]] std::string tics(double length, const Room& room) const;

  double least_ = 1;
  double most_ = 1;
  double zero_ = 0;  ///< 0: the axis has no place for it
};

}  // namespace hitpipe::cli
