#include "sw_ref/judge/adversary/case.hpp"

#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "rays/exact/box_referee.hpp"

namespace hitpipe::ref::adversary {

std::string to_text(const Ray& ray) {
  return fmt::format("origin {:a} {:a} {:a} direction {:a} {:a} {:a} length {:a}", ray.origin.x, ray.origin.y,
                     ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z, ray.length);
}

std::string to_text(const Case& c) {
  return to_text(c.ray) + fmt::format(" box {:a} {:a} {:a} to {:a} {:a} {:a}", c.box.min.x, c.box.min.y,
                                      c.box.min.z, c.box.max.x, c.box.max.y, c.box.max.z);
}

namespace {

constexpr std::string_view form = "origin X Y Z direction X Y Z length L box X Y Z to X Y Z";

class Words {
 public:
  explicit Words(std::string_view text) : words_(std::string(text)) {}

  void expect(std::string_view keyword) {
    const std::string word = next();
    if (word != keyword) fail(word, fmt::format("\"{}\"", keyword));
  }
  float number() {
    const std::string word = next();
    char* end = nullptr;
    const float value = std::strtof(word.c_str(), &end);
    if (word.empty() || *end != '\0') fail(word, "a number");
    return value;
  }
  glm::vec3 vector() {
    glm::vec3 v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = number();
    return v;
  }
  void expect_end() {
    const std::string word = next();
    if (!word.empty()) fail(word, "the end");
  }

 private:
  std::string next() {
    std::string word;
    words_ >> word;
    return word;
  }
  [[noreturn]] static void fail(const std::string& word, const std::string& wanted) {
    throw std::runtime_error(
        fmt::format("case: \"{}\" where {} is wanted; the form is: {}", word, wanted, form));
  }

  std::istringstream words_;
};

}  // namespace

Case parse_case(std::string_view text) {
  Words words(text);
  Case c;
  words.expect("origin");
  c.ray.origin = words.vector();
  words.expect("direction");
  c.ray.direction = words.vector();
  words.expect("length");
  c.ray.length = words.number();
  words.expect("box");
  c.box.min = words.vector();
  words.expect("to");
  c.box.max = words.vector();
  words.expect_end();
  if (!acceptable(c.ray)) {
    throw std::runtime_error(
        "case: the ray is refused; its origin must lie in [-1, 1]^3, its direction be finite and not 0, its "
        "length "
        ">= 0 or inf");
  }
  if (!acceptable(c.box)) {
    throw std::runtime_error(
        "case: the box is refused; it must lie in [-1, 1]^3 with min <= max on each axis");
  }
  return c;
}

}  // namespace hitpipe::ref::adversary
