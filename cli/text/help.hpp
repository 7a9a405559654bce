// The layout of help: names on the left, descriptions on the right, no line wider than 80 columns.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace hitpipe::cli {

class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter();

  [[nodiscard]] std::string make_description(const CLI::App* app) const override;
  [[nodiscard]] std::string make_subcommand(const CLI::App* command) const override;
  [[nodiscard]] std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace hitpipe::cli
