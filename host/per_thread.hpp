// An object for each thread. It is made when the thread first asks for it.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace hitpipe::host {

template <class T>
class PerThread {
 public:
  explicit PerThread(std::function<T()> make) : make_(std::move(make)) {}

  /// The calling thread's. It stays where it is.
  [[nodiscard]] T& local() {
    const std::thread::id thread = std::this_thread::get_id();
    {
      const std::scoped_lock lock(sharing_);
      if (const auto found = all_.find(thread); found != all_.end()) return found->second;
    }
    T made = make_();
    const std::scoped_lock lock(sharing_);
    return all_.try_emplace(thread, std::move(made)).first->second;
  }

  /// Calls visit(item) for each, while no thread is at work.
  template <class Visit>
  void for_each(const Visit& visit) const {
    const std::scoped_lock lock(sharing_);
    for (const auto& [thread, item] : all_) visit(item);
  }

 private:
  std::function<T()> make_;
  mutable std::mutex sharing_;
  std::map<std::thread::id, T> all_;
};

}  // namespace hitpipe::host
