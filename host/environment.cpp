#include "host/environment.hpp"

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>

namespace hitpipe::host {

std::string environment(const char* name, const std::string& otherwise) {
  const char* const value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

std::vector<std::string> words_of(std::string_view text) {
  std::istringstream in{std::string(text)};
  return {std::istream_iterator<std::string>(in), {}};
}

std::vector<std::string> program_of(const char* variable, const std::string& otherwise) {
  const std::string value = environment(variable, otherwise);
  std::error_code ignored;
  if (value.find('/') != std::string::npos && std::filesystem::exists(value, ignored)) return {value};
  std::vector<std::string> words = words_of(value);
  return words.empty() ? std::vector{otherwise} : words;
}

}  // namespace hitpipe::host
