#include "host/watch.hpp"

#include <utility>

namespace hitpipe::host {
namespace {

thread_local Watch* watch_of_thread = nullptr;

}  // namespace

Watch::Watch(std::function<void()> look) : look_(std::move(look)), before_(watch_of_thread) {
  watch_of_thread = this;
}

Watch::~Watch() {
  watch_of_thread = before_;
}

void look() {
  if (watch_of_thread != nullptr && watch_of_thread->look_) watch_of_thread->look_();
}

}  // namespace hitpipe::host
