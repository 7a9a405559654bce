#include "sim/operands/test_text.hpp"

#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/emit/vectors.hpp"

namespace hitpipe::sim {

namespace {

/// Writes the values of a line: "1,2" as CSV, "\"a\":1,\"b\":2" as JSON.
template <class Columns>
class Values {
 public:
  Values(const Columns& columns, bool named, std::string& text)
      : columns_(columns), named_(named), text_(text) {}

  void add_nothing() {
    begin();
    if (named_) text_ += "null";
    ++place_;
  }
  void add(std::int64_t value) {
    begin();
    const int digits = columns_[place_].pattern_digits;
    const auto out = std::back_inserter(text_);
    if (digits == 0) {
      fmt::format_to(out, "{}", value);
    } else {
      const char* const quote = named_ ? "\"" : "";
      fmt::format_to(out, "{0}0x{1:0{2}x}{0}", quote, static_cast<std::uint64_t>(value), digits);
    }
    ++place_;
  }
  /// A binary32 in C's hexadecimal form, which is exact.
  void add(float value) {
    begin();
    const char* const quote = named_ ? "\"" : "";
    fmt::format_to(std::back_inserter(text_), "{0}{1:a}{0}", quote, value);
    ++place_;
  }

 private:
  void begin() {
    if (place_ > 0) text_ += ',';
    if (named_) fmt::format_to(std::back_inserter(text_), "\"{}\":", columns_[place_].name);
  }

  const Columns& columns_;
  bool named_;
  std::string& text_;
  std::size_t place_ = 0;
};

}  // namespace

TestLayout::TestLayout(const rtl::Design& design, const Format& format, const Placement& placement,
                       TestForm form, bool with_input)
    : design_(design.name),
      bits_(to_string(format)),
      placement_(placement),
      form_(form),
      with_input_(with_input),
      boxes_(static_cast<std::size_t>(design.kind.objects)),
      ports_(design.ports(format)),
      results_(design.results(format)) {
  columns_ = {{"ray"}, {"box"}};
  if (with_input_) {
    for (const char* const name : {"ox", "oy", "oz", "dx", "dy", "dz", "length"}) columns_.push_back({name});
    for (const std::string& name : box_columns(boxes_)) columns_.push_back({name});
  }
  if (boxes_ > 1) columns_.push_back({"of_parent"});
  add_columns();
  for (const hls::Result& result : results_)
    if (result.meaning == hls::Meaning::hit) columns_.push_back({fmt::format("exact_{}", result.name)});
}

TestLayout::TestLayout(const rtl::Design& design, const Format& format, TestForm form)
    : design_(design.name),
      bits_(to_string(format)),
      form_(form),
      boxes_(static_cast<std::size_t>(design.kind.objects)),
      ports_(design.ports(format)),
      results_(design.results(format)) {
  add_columns();
}

void TestLayout::add_columns() {
  for (const rtl::Port& port : ports_)
    columns_.push_back({port.name, port.kind == hls::Kind::real ? (port.width + 3) / 4 : 0});
  for (const hls::Result& result : results_) columns_.push_back({result.name});
}

std::string TestLayout::head() const {
  if (form_ == TestForm::csv) {
    std::vector<std::string_view> names;
    for (const Column& column : columns_) names.push_back(column.name);
    return fmt::format("{}\n", fmt::join(names, ","));
  }
  std::string about = form_ == TestForm::json
                          ? fmt::format("\"design\":\"{}\",\"bits\":\"{}\"", design_, bits_)
                          : fmt::format("{} {}", design_, bits_);
  if (placement_) {
    const ref::Normalisation& cube = placement_->transform();
    const glm::dvec3& offset = cube.offset;
    about +=
        form_ == TestForm::json
            ? fmt::format(",\"scale\":{},\"offset\":[{},{},{}]", cube.scale, offset.x, offset.y, offset.z)
            : fmt::format("; cube = (own - offset) * scale, offset {} {} {}, scale {}", offset.x, offset.y,
                          offset.z, cube.scale);
  }
  if (form_ == TestForm::json) return fmt::format("{{{}}}\n", about);
  std::vector<std::string> fields;
  for (const rtl::Port& port : ports_) fields.push_back(fmt::format("{}:{}", port.name, port.width));
  for (const hls::Result& result : results_)
    fields.push_back(fmt::format("{}:{}", result.name, result.width));
  return fmt::format("// {}\n// one test a line, name:width from the high bits down: {}\n", about,
                     fmt::join(fields, " "));
}

void TestLayout::append_values(const JudgedTest& test, std::string& text) const {
  Values values(columns_, form_ == TestForm::json, text);
  if (placement_) {
    values.add(static_cast<std::int64_t>(test.ray_number));
    values.add(static_cast<std::int64_t>(test.box_number));
  }
  if (with_input_) {
    for (int axis = 0; axis < 3; ++axis) values.add(test.ray.origin[axis]);
    for (int axis = 0; axis < 3; ++axis) values.add(test.ray.direction[axis]);
    values.add(test.ray.length);
    for (std::size_t box = 0; box < boxes_; ++box)
      for (unsigned face = 0; face < 6; ++face) values.add(test.boxes[box].plane(face));
  }
  if (placement_ && boxes_ > 1) values.add(std::int64_t{test.of_parent});
  for (const std::int64_t operand : test.operands) values.add(operand);
  for (std::size_t i = 0; i < results_.size(); ++i) {
    const bool of_second = results_[i].box > 0 || results_[i].meaning == hls::Meaning::order;
    if (test.of_parent && of_second) {
      values.add_nothing();
    } else {
      values.add(test.results[i]);
    }
  }
  if (!placement_) return;
  for (std::size_t box = 0; box < boxes_; ++box) values.add(std::int64_t{test.exact[box]});
}

void TestLayout::append(const JudgedTest& test, std::string& text) const {
  if (form_ == TestForm::json) text += '{';
  append_values(test, text);
  text += form_ == TestForm::json ? "}\n" : "\n";
}

std::string TestLayout::vectors(const std::vector<rtl::Vector>& tests) const {
  return rtl::vector_file(ports_, ports_, results_, tests);
}

bool TestLayout::reports(std::span<const std::int64_t> results, const std::array<bool, 2>& hits) const {
  for (std::size_t i = 0; i < results_.size(); ++i) {
    const hls::Result& result = results_[i];
    if (result.meaning == hls::Meaning::hit &&
        (results[i] != 0) != hits[static_cast<std::size_t>(result.box)])
      return false;
  }
  return true;
}

}  // namespace hitpipe::sim
