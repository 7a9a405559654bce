// A logarithmic axis that ends where its data does.
#pragma once

#include <span>
#include <string>

namespace hitpipe::cli {

class LogAxis {
 public:
  /// Numbers that are not positive have a place of their own below the others, with the tic "≤ 0".
  explicit LogAxis(std::span<const double> values);

  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double most() const { return most_; }
  /// Where a value is drawn: a value of the axis.
  [[nodiscard]] double shown(double value) const { return value > 0 ? value : zero_; }
  /// The position of a value as a fraction of the length, and back.
  [[nodiscard]] double share(double value) const;
  [[nodiscard]] double at(double share) const;
  /// As gnuplot takes them: "'1' 1, '2' 2".
  [[nodiscard]] std::string tics() const;

 private:
  double least_ = 1;
  double most_ = 1;
  double zero_ = 0;  ///< 0: the axis has no place for it
};

}  // namespace hitpipe::cli
