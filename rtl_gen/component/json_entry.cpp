#include "rtl_gen/component/json_entry.hpp"

namespace hitpipe::rtl {

const FileJson& required(const FileJson& object, const std::string& key, std::string_view where) {
  if (!object.is_object()) throw std::runtime_error(fmt::format("{}: must be a JSON object", where));
  const auto found = object.find(key);
  if (found == object.end()) throw std::runtime_error(fmt::format("{}: \"{}\" is missing", where, key));
  return *found;
}

std::string text_of(const FileJson& object, const std::string& key, std::string_view where) {
  const FileJson& value = required(object, key, where);
  if (!value.is_string()) throw std::runtime_error(fmt::format("{}: \"{}\" must be a text", where, key));
  return value.get<std::string>();
}

int count_of(const FileJson& object, const std::string& key, std::string_view where, Limits allowed) {
  const FileJson& value = required(object, key, where);
  if (!value.is_number_integer() || value.get<std::int64_t>() < allowed.least ||
      value.get<std::int64_t>() > allowed.most) {
    // An array may be nested too deep to be printed.
    const std::string given = value.is_structured() ? value.type_name() : value.dump();
    throw std::runtime_error(fmt::format("{}: \"{}\" is {}, allowed are whole numbers from {} to {}", where,
                                         key, given, allowed.least, allowed.most));
  }
  return value.get<int>();
}

bool truth_of(const FileJson& object, const std::string& key, std::string_view where) {
  const FileJson& value = required(object, key, where);
  if (!value.is_boolean()) {
    throw std::runtime_error(fmt::format("{}: \"{}\" must be true or false", where, key));
  }
  return value.get<bool>();
}

std::string line_of_text(const FileJson& object, const std::string& key, std::string_view where) {
  std::string text = text_of(object, key, where);
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < ' '; })) {
    throw std::runtime_error(fmt::format("{}: \"{}\" must be one line", where, key));
  }
  return text;
}

}  // namespace hitpipe::rtl
