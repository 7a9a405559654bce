#include "host/format.hpp"

#include <charconv>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/text.hpp"

namespace hitpipe {

namespace {

/// Reads a number from the front of the text; false when there is none.
bool take(std::string_view& text, int& number) {
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return true;
}

bool take(std::string_view& text, std::string_view start) {
  if (!text.starts_with(start)) return false;
  text.remove_prefix(start.size());
  return true;
}

/// "e8m23" also where the format has a name.
std::string spelled(const FormatFamily& family, const FormatNumbers& numbers) {
  std::string text;
  for (std::size_t i = 0; i < family.fields.size(); ++i)
    if (!family.fields[i].optional || numbers[i] != family.usual[i])
      text += fmt::format("{}{}", family.fields[i].before, numbers[i]);
  return text;
}

}  // namespace

std::string FormatFamily::allowed() const {
  if (single) return fmt::format("{}, which is {}", print(usual), spelled(*this, usual));
  std::string whole, without_optional;
  std::vector<std::string> limits;
  for (const hls::FormatField& field : fields) {
    const std::string part = std::string(field.before) + field.letter;
    whole += part;
    if (!field.optional) without_optional += part;
    const std::string most =
        field.most_in_words == nullptr ? std::to_string(field.most) : field.most_in_words;
    limits.push_back(fmt::format("{} in {}..{}", field.letter, field.least, most));
  }
  if (condition != nullptr) limits.emplace_back(condition);
  const std::string last = limits.back();
  limits.pop_back();
  return fmt::format("{}{} with {}{}{}", without_optional, whole == without_optional ? "" : " or " + whole,
                     fmt::join(limits, ", "), limits.empty() ? "" : " and ", last);
}

std::string FormatFamily::print(const FormatNumbers& numbers) const {
  return single && alias != nullptr && numbers == usual ? alias : spelled(*this, numbers);
}

// "20p1_13", "20p1_13fm2": p for plus, m for minus.
std::string FormatFamily::identifier(const FormatNumbers& numbers) const {
  std::string text = print(numbers);
  for (char& letter : text) letter = letter == '+' ? 'p' : letter == '-' ? 'm' : letter == '/' ? '_' : letter;
  return text;
}

std::optional<FormatNumbers> FormatFamily::parse(std::string_view text) const {
  if (text.size() > 1 && text[0] == 'n' && text[1] >= '0' && text[1] <= '9') text.remove_prefix(1);
  if (alias != nullptr && text == alias) return usual;
  FormatNumbers numbers{};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!take(text, fields[i].before)) {
      if (!fields[i].optional) return std::nullopt;
      numbers[i] = usual[i];
      continue;
    }
    if (!take(text, numbers[i])) return std::nullopt;
  }
  return text.empty() ? std::optional(numbers) : std::nullopt;
}

std::string FormatFamily::type(const FormatNumbers& numbers) const {
  if (type_name == nullptr)
    throw std::runtime_error(fmt::format("bits {}: no type that is known to a compiler", print(numbers)));
  auto count = std::ssize(fields);
  const auto is_default = [&](std::size_t i) { return fields[i].optional && numbers[i] == usual[i]; };
  while (count > 0 && is_default(static_cast<std::size_t>(count - 1))) --count;
  return fmt::format("{}<{}>", type_name, fmt::join(numbers.begin(), numbers.begin() + count, ", "));
}

bool FormatFamily::within_limits(const FormatNumbers& numbers) const {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].optional && numbers[i] == usual[i]) continue;
    if (numbers[i] < fields[i].least || numbers[i] > fields[i].most) return false;
  }
  return true;
}

Format parse_format(const FormatFamily& family, std::string_view text) {
  const auto numbers = family.parse(text);
  if (!numbers || !family.valid(*numbers))
    throw std::runtime_error(fmt::format("bits {}: allowed is {}, for example {}", host::shortened(text),
                                         family.allowed(), family.print(family.for_example)));
  return {family, *numbers};
}

}  // namespace hitpipe
