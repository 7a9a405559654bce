#include "rtl_gen/graph/trace.hpp"

#include <stdexcept>

namespace hitpipe::rtl {

namespace {

/// The last `count` components of a path, without a slash before them.
std::string_view last_components(std::string_view path, int count) {
  std::size_t start = path.size();
  for (; start > 0; --start) {
    if (path[start - 1] == '/' && (--count == 0 || start == 1)) break;
  }
  return path.substr(start);
}

}  // namespace

thread_local Graph* Tracer::current_ = nullptr;

Graph& Tracer::graph() {
  if (current_ == nullptr) throw std::logic_error("a Signal was used while no Tracer is in scope");
  return *current_;
}

SourceLine source_line(std::string_view path, unsigned line) {
  const std::string_view of_project = last_components(path, 3);
  return {std::string(of_project.starts_with("hls/") ? of_project : last_components(path, 2)), line};
}

}  // namespace hitpipe::rtl
