#include "rays/files/json_place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/files.hpp"
#include "host/reject.hpp"
#include "host/text.hpp"

namespace hitpipe::ref {
namespace {

using nlohmann::json;

/// Refuses what the library lets pass: it keeps the last of several equal keys and says nothing. Its parser
/// with a callback could do so too, but takes a time that grows with the square of an array's length.
class JsonCheck : public nlohmann::json_sax<json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(std::int64_t) override { return true; }
  bool number_unsigned(std::uint64_t) override { return true; }
  bool number_float(double, const std::string&) override { return true; }
  bool string(std::string&) override { return true; }
  bool binary(json::binary_t&) override { return true; }
  bool start_array(std::size_t) override { return start(); }
  bool end_array() override { return end(); }
  bool start_object(std::size_t) override { return start(); }
  bool end_object() override { return end(); }
  bool key(std::string& key) override {
    if (!keys_.back().insert(key).second)
      reject(fmt::format("the key \"{}\" stands twice in one object", host::shortened(key)));
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override {
    return false;  // the parser that follows says it
  }

 private:
  bool start() {
    constexpr std::size_t deepest = 1000;
    if (keys_.size() == deepest)
      reject(fmt::format("arrays and objects lie more than {} deep in one another", deepest));
    keys_.emplace_back();
    return true;
  }
  bool end() {
    keys_.pop_back();
    return true;
  }

  std::vector<std::set<std::string>> keys_;
};

}  // namespace

nlohmann::json parse_json(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) reject("no such file");
  if (!std::filesystem::is_regular_file(file, error)) reject("is not a regular file");
  const std::optional<std::string> text = host::contents_of(file);
  if (!text) reject("cannot be opened");
  return parse_json_text(*text);
}

nlohmann::json parse_json_text(std::string_view text) {
  JsonCheck check;
  try {
    json::sax_parse(text, &check);
    return json::parse(text);
  } catch (const json::exception& problem) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    std::string_view what = problem.what();
    const std::size_t after = what.find("] ");
    if (after != std::string_view::npos) what.remove_prefix(after + 2);
    constexpr std::size_t longest = 300;  // it quotes what it read last, which may be megabytes
    reject("is no JSON: " + (what.size() > longest ? host::shortened(what) : std::string(what)));
  }
}

void Place::fail(const std::string& reason) const {
  reject(way_.empty() ? reason : way_ + ": " + reason);
}

void Place::expect_object(std::initializer_list<const char*> keys) const {
  if (!value_->is_object()) fail(fmt::format("must be an object with keys of: {}", fmt::join(keys, ", ")));
  for (const auto& [key, value] : value_->items()) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      fail(fmt::format("unknown key \"{}\"; allowed are: {}", host::shortened(key), fmt::join(keys, ", ")));
  }
}

Place Place::at(const std::string& key) const {
  if (!value_->contains(key)) fail(fmt::format("needs the key \"{}\"", key));
  return Place(value_->at(key), way_.empty() ? host::shortened(key) : way_ + "." + host::shortened(key));
}

std::vector<std::pair<std::string, Place>> Place::members() const {
  if (!value_->is_object()) fail("must be an object");
  std::vector<std::pair<std::string, Place>> all;
  for (const auto& [key, value] : value_->items()) all.emplace_back(key, at(key));
  return all;
}

std::vector<Place> Place::elements() const {
  const std::size_t count = size();
  std::vector<Place> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(element(i));
  return all;
}

std::size_t Place::size() const {
  if (!value_->is_array()) fail("must be an array");
  return value_->size();
}

Place Place::element(std::size_t i) const {
  return Place((*value_)[i], fmt::format("{}[{}]", way_, i));
}

std::string Place::word() const {
  if (!value_->is_string()) fail("must be a string");
  return value_->get<std::string>();
}

std::uint64_t Place::count(std::uint64_t most) const {
  if (!value_->is_number_unsigned() || value_->get<std::uint64_t>() > most)
    fail(fmt::format("must be a whole number of 0 to {}", most));
  return value_->get<std::uint64_t>();
}

bool Place::is_number() const {
  return value_->is_number() && std::isfinite(value_->get<double>());
}

double Place::number() const {
  if (!is_number()) fail("must be a number that is finite");
  return value_->get<double>();
}

std::vector<double> Place::numbers(std::size_t size) const {
  if (!value_->is_array() || value_->size() != size)
    fail(fmt::format("must be an array of {} numbers", size));
  std::vector<double> all;
  for (const Place& part : elements()) all.push_back(part.number());
  return all;
}

bool Place::truth() const {
  if (!value_->is_boolean()) fail("must be true or false");
  return value_->get<bool>();
}

glm::dvec3 Place::vector() const {
  if (!value_->is_array() || value_->size() != 3) fail("must be an array of three numbers");
  const std::vector<Place> parts = elements();
  return {parts[0].number(), parts[1].number(), parts[2].number()};
}

glm::dvec3 Place::colour(double most) const {
  const std::string allowed = most < std::numeric_limits<double>::infinity()
                                  ? fmt::format("each in 0 to {}", most)
                                  : std::string("none below 0");
  if (!is_number() && !(value_->is_array() && value_->size() == 3))
    fail(fmt::format("must be one number or an array of three, {}", allowed));
  const glm::dvec3 parts = is_number() ? glm::dvec3(number()) : vector();
  for (int k = 0; k < 3; ++k) {
    if (!(parts[k] >= 0.0 && parts[k] <= most))
      fail(fmt::format("{} is out of range; numbers must be {}", parts[k], allowed));
  }
  return parts;
}

}  // namespace hitpipe::ref
