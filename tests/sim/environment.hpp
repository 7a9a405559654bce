// Sets an environment variable as long as the object exists.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace hitpipe::sim {

class EnvironmentValue {
 public:
  EnvironmentValue(const char* name, const std::optional<std::string>& value) : name_(name) {
    if (const char* const found = std::getenv(name)) before_ = found;
    set(value);
  }
  ~EnvironmentValue() { set(before_); }
  EnvironmentValue(const EnvironmentValue&) = delete;
  EnvironmentValue& operator=(const EnvironmentValue&) = delete;

 private:
  void set(const std::optional<std::string>& value) const {
    if (value) {
      setenv(name_, value->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }

  const char* name_;
  std::optional<std::string> before_;
};

}  // namespace hitpipe::sim
