#include "rtl_gen/graph/trace.hpp"

#include <stdexcept>

namespace hitpipe::rtl {

thread_local Graph* Tracer::current_ = nullptr;

Graph& Tracer::graph() {
  if (current_ == nullptr) throw std::logic_error("a Signal was used while no Tracer is in scope");
  return *current_;
}

SourceLine source_line(std::string_view path, unsigned line) {
  const std::size_t hls = path.rfind("hls/");
  return {std::string(hls == std::string_view::npos ? path : path.substr(hls)), line};
}

}  // namespace hitpipe::rtl
