#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/values.hpp"
#include "cli/text/table.hpp"
#include "sw_ref/render/image_compare.hpp"

namespace hitpipe::cli {

namespace {

struct CompareCommand {
  std::string a;
  std::string b;
  double tolerance = 0.0;
  std::string out;
  Format format = Format::text;
};

int compare(const CompareCommand& command) {
  // One step of an 8-bit code is 0.0039, so the text needs more than two digits after the point.
  const auto difference_of = [&](double x) {
    return command.format == Format::text ? Row(fmt::format("{:.6g}", x)) : Row(x);
  };
  const ref::StoredImage a = ref::read_image(command.a);
  const ref::StoredImage b = ref::read_image(command.b);
  const ref::ImageDifference difference = ref::compare_images(a, b, command.tolerance);
  Row row{{"width", a.width},
          {"height", a.height},
          {"channels", a.channels},
          {"pixels", difference.pixels},
          {"different_pixels", difference.different_pixels},
          {"largest_difference", difference_of(difference.largest)},
          {"mean_difference", difference_of(difference.mean)},
          {"psnr_db", difference.psnr_db}};
  if (!command.out.empty()) {
    ref::write_map(command.out, a.width, a.height, difference.per_pixel,
                   {0.0F, ref::scale_of(difference.per_pixel).high});
    row["difference_image"] = command.out;
  }
  fmt::print("{}", record_text(row, command.format));
  return difference.different_pixels == 0 ? 0 : 1;
}

}  // namespace

void add_compare_command(CLI::App& program, int& exit_code) {
  CLI::App* const command = program.add_subcommand(
      "compare", "Compare two images; the exit code is 1 when a pixel differs by more than the tolerance");
  const auto options = std::make_shared<CompareCommand>();
  command->add_option("a", options->a, "An image")->required()->type_name("FILE");
  command->add_option("b", options->b, "Another image with the same size and channels")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--tolerance", options->tolerance,
                   "How far channels may be apart; values of a .png are 0 to 1")
      ->check(CLI::NonNegativeNumber.description(""))
      ->type_name("X")
      ->capture_default_str();
  command
      ->add_option("--out", options->out,
                   "Map of each pixel's largest difference: .exr holds the values, .png colours from 0 to "
                   "the maximum")
      ->type_name("FILE");
  add_format_option(*command, options->format);
  command->callback([options, &exit_code] { exit_code = compare(*options); });
}

}  // namespace hitpipe::cli
