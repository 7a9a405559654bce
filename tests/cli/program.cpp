#include "tests/cli/program.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/process.hpp"
#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

/// A slow machine may make any command write lines of progress.
std::string without_progress(const std::string& text) {
  static const std::regex progress("hitpipe: [^\n]*: [0-9]+ (s|min|h)[^\n]*\n");
  constexpr std::size_t longest = 1000;  // the library's matcher calls itself for each character
  std::string kept;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    if (line.size() > longest || !std::regex_match(line, progress)) kept += line;
    at = end;
  }
  return kept;
}

}  // namespace

Outcome run_hitpipe(const std::vector<std::string>& arguments, const Variables& variables) {
  std::vector<std::string> words{"env"};
  for (const auto& [name, value] : variables) words.push_back(name + "=" + value);
  words.emplace_back(HITPIPE_PROGRAM);
  words.insert(words.end(), arguments.begin(), arguments.end());
  const host::Outcome ended = host::run(words);
  return {ended.signal == 0 ? ended.exit_code : -1, ended.out, without_progress(ended.err)};
}

Outcome hitpipe(const std::string& words, const Variables& variables) {
  return run_hitpipe(host::words_of(words), variables);
}

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::string printed(const std::string& words) {
  const Outcome outcome = hitpipe(words);
  EXPECT_EQ(outcome.exit_code, 0) << words;
  EXPECT_EQ(outcome.err, "") << words;
  return outcome.out;
}

std::string always_missing_verilator(const sim::TemporaryFolder& folder) {
  return damaging_verilator(folder, "s/assign hit = .*;/assign hit = 0;/");
}

// Models are kept by the version that Verilator says.
std::string damaging_verilator(const sim::TemporaryFolder& folder, const std::string& sed) {
  const auto program = folder.write_program("verilator", fmt::format(R"script(#!/bin/sh
if [ "$1" = --version ]; then echo 'with {0}'; exit; fi
if [ "$1" = --cc ]; then
  for file; do :; done
  sed -i '{0}' "$file"
fi
exec verilator "$@"
)script",
                                                                     sed));
  return program.string();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  if (!text.empty() && text.back() != '\n') lines.push_back("(the last line has no end)");
  return lines;
}

std::size_t widest_line(const std::string& text) {
  std::size_t widest = 0;
  for (const std::string& line : lines_of(text)) {
    const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
    widest = std::max(widest, static_cast<std::size_t>(std::count_if(line.begin(), line.end(), begins)));
  }
  return widest;
}

std::vector<std::string> files_below(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) files.push_back(std::filesystem::relative(entry.path(), folder).string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string contents_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace hitpipe::cli
