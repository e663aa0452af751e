// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/crew.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <thread>

namespace sunload {

namespace {

/// Looks whether it is so for as long as falling asleep and waking up would take.
template <class IsSo>
void look_a_while(const IsSo& is_so) {
  constexpr std::chrono::microseconds a_while{30};
  const auto end = std::chrono::steady_clock::now() + a_while;
  while (!is_so() && std::chrono::steady_clock::now() < end) {
  }
}

}  // namespace

Crew& Crew::of_process() {
  static Crew& crew = *new Crew;
  return crew;
}

void Crew::run(int team, const std::function<void()>& work) {
  Loop loop{work, team - 1};
  {
    const std::lock_guard lock(guard_);
    have_threads(team - 1);
    loops_.push_back(&loop);
    ++came_;
  }
  loop_came_.notify_all();
  work();
  {
    const std::lock_guard lock(guard_);
    loops_.erase(std::find(loops_.begin(), loops_.end(), &loop));
  }
  look_a_while([&] { return loop.busy == 0; });
  std::unique_lock lock(guard_);
  loop_left_.wait(lock, [&] { return loop.busy == 0; });
}

/// Fewer where the machine has no more.
void Crew::have_threads(int count) {
  try {
    for (; threads_ < count; ++threads_) std::thread(&Crew::help, this).detach();
  } catch (const std::system_error&) {
    return;
  }
}

Crew::Loop* Crew::loop_with_a_place() const {
  const auto found =
      std::find_if(loops_.begin(), loops_.end(), [](const Loop* loop) { return loop->places > 0; });
  return found == loops_.end() ? nullptr : *found;
}

void Crew::help() {
  std::unique_lock lock(guard_);
  for (;;) {
    Loop* const loop = loop_with_a_place();
    if (!loop) {
      const unsigned came = came_;
      lock.unlock();
      look_a_while([&] { return came_ != came; });
      lock.lock();
      loop_came_.wait(lock, [&] { return loop_with_a_place() != nullptr; });
      continue;
    }
    --loop->places;
    ++loop->busy;
    lock.unlock();
    loop->work();
    lock.lock();
    // Who waits may return as soon as nobody is busy: nothing of the loop is touched after this.
    if (--loop->busy == 0) loop_left_.notify_all();
  }
}

}  // namespace sunload
