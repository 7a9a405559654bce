// Reads JSON through Places. A Place is a value and the path to it; errors name that path. All errors are
// std::runtime_error with one line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace hitpipe::ref {

/// Parses a whole file; no object may have a key twice.
[[nodiscard]] nlohmann::json parse_json(const std::filesystem::path& file);

/// The same of a text. Arrays and objects may lie at most 1,000 deep in one another.
[[nodiscard]] nlohmann::json parse_json_text(std::string_view text);

class Place {
 public:
  /// `way` is a path such as "lights[0].position"; empty for the top of the file. `value` must outlive the
  /// place.
  explicit Place(const nlohmann::json& value, std::string way = "") : value_(&value), way_(std::move(way)) {}

  [[noreturn]] void fail(const std::string& reason) const;
  /// Fails unless this is an object and each of its keys is in the list.
  void expect_object(std::initializer_list<const char*> keys) const;
  [[nodiscard]] bool is_object() const { return value_->is_object(); }
  [[nodiscard]] bool has(const char* key) const { return value_->contains(key); }
  [[nodiscard]] Place at(const std::string& key) const;
  /// The members of an object whose keys the user chooses.
  [[nodiscard]] std::vector<std::pair<std::string, Place>> members() const;
  [[nodiscard]] std::vector<Place> elements() const;
  /// The length of an array; its elements are element(0) and so on.
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] Place element(std::size_t i) const;
  [[nodiscard]] std::string word() const;
  /// A whole number, 0 to `most`.
  [[nodiscard]] std::uint64_t count(std::uint64_t most) const;
  [[nodiscard]] double number() const;
  /// An array of `size` numbers that are finite.
  [[nodiscard]] std::vector<double> numbers(std::size_t size) const;
  [[nodiscard]] bool truth() const;
  [[nodiscard]] glm::dvec3 vector() const;
  /// One number for all three components, or three numbers; each from 0 to `most`, which may be infinite.
  [[nodiscard]] glm::dvec3 colour(double most) const;

 private:
  [[nodiscard]] bool is_number() const;

  const nlohmann::json* value_;
  std::string way_;
};

}  // namespace hitpipe::ref
