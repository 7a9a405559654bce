#include "rtl_gen/schedule/kept_searches.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

/// All that is in a graph: its text does not say what the C++ names of a value.
std::string whole_text(const Graph& graph) {
  std::string text = to_text(graph);
  for (NodeId id = 0; id < graph.size(); ++id)
    for (const NamedPart& part : graph[id].parts)
      text += fmt::format("%{} [{}:{}] {} @ {}:{}\n", id, part.high, part.low, part.name, part.source.file,
                          part.source.line);
  for (const auto& unit : graph.submodules())
    text += fmt::format("{}:{}\n{}", unit->component, unit->bits, whole_text(unit->body));
  return text;
}

}  // namespace

SharedGraph KeptSearches::share(const Graph& graph, const Library& library, int interval,
                                std::optional<int> clock_ps) {
  std::string text = whole_text(graph);
  {
    const std::lock_guard lock(mutex_);
    const auto same = std::find_if(kept_.begin(), kept_.end(), [&](const Search& each) {
      return each.interval == interval && each.clock_ps == clock_ps && each.graph == text &&
             each.library == library;
    });
    if (same != kept_.end()) return same->found;
    ++searches_;
  }
  SharedGraph found = share_widened(graph, library, interval, clock_ps);
  const std::lock_guard lock(mutex_);
  if (kept_.size() == most_) kept_.pop_front();
  kept_.push_back({std::move(text), library, interval, clock_ps, found});
  return found;
}

}  // namespace hitpipe::rtl
