#include "cli/options/picture_options.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

constexpr double least_mm = 40;
constexpr double most_mm = 400;
constexpr std::array<std::pair<std::string_view, double>, 3> mm_of{
    {{"mm", 1}, {"in", 25.4}, {"pt", 25.4 / 72}}};

std::optional<double> mm_in(std::string_view text) {
  for (const auto& [unit, mm] : mm_of) {
    if (!text.ends_with(unit)) continue;
    const auto number = host::number_in<double>(std::string(text.substr(0, text.size() - unit.size())));
    if (number && *number * mm >= least_mm && *number * mm <= most_mm) return *number * mm;
  }
  return {};
}

}  // namespace

CLI::Option* add_plot_width_option(CLI::App& command, std::optional<double>& width_mm,
                                   const std::string& when) {
  return command
      .add_option_function<std::string>(
          "--plot-width",
          [&width_mm](const std::string& text) {
            width_mm = mm_in(text);
            if (!width_mm)
              throw CLI::ValidationError(
                  "--plot-width",
                  fmt::format("{} is no width from {}mm to {}mm, such as 84mm, 3.3in or 240pt",
                              host::shortened(text), least_mm, most_mm));
          },
          fmt::format("{}Plots for a paper: this wide, in mm, in or pt, with letters of 8 pt ({}mm to {}mm)",
                      when, least_mm, most_mm))
      ->type_name("WIDTH");
}

}  // namespace hitpipe::cli
