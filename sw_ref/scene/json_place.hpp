// JSON read with care: every value is reached through a Place, which knows the way to it and names it when it
// is not what is allowed. All that is wrong is thrown as std::runtime_error with one line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace hitpipe::ref {

/// Of a whole file; no object may have a key twice.
[[nodiscard]] nlohmann::json parse_json(const std::filesystem::path& file);

class Place {
 public:
  /// `way` as "lights[0].position"; empty: the file's top. `value` must outlive the place.
  explicit Place(const nlohmann::json& value, std::string way = "") : value_(&value), way_(std::move(way)) {}

  [[noreturn]] void fail(const std::string& reason) const;
  /// Fails unless this is an object all of whose keys are among these.
  void expect_object(std::initializer_list<const char*> keys) const;
  [[nodiscard]] bool has(const char* key) const { return value_->contains(key); }
  [[nodiscard]] Place at(const std::string& key) const;
  /// Of an object whose keys the user chooses.
  [[nodiscard]] std::vector<std::pair<std::string, Place>> members() const;
  [[nodiscard]] std::vector<Place> elements() const;
  [[nodiscard]] std::string word() const;
  /// A whole number, 0 to `most`.
  [[nodiscard]] std::uint64_t count(std::uint64_t most) const;
  [[nodiscard]] double number() const;
  [[nodiscard]] glm::dvec3 vector() const;
  /// One number for all three components, or three; each in 0 to `most`, which may be infinite.
  [[nodiscard]] glm::dvec3 colour(double most) const;

 private:
  [[nodiscard]] bool is_number() const;

  const nlohmann::json* value_;
  std::string way_;
};

}  // namespace hitpipe::ref
