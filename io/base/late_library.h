// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions of a shared library that is loaded when the first of them is called.
///
/// A library with a hundred others behind it takes longer to load than small studies to compute,
/// and most commands never call it.
#pragma once

#include <atomic>
#include <utility>

namespace sunload {

/// The address of a function in a library of this file name (`libNAME.so.N`), which is loaded the
/// first time that it is asked for, from any thread, and stays. Throws MachineError: it cannot be
/// loaded, or lacks the function.
void* late_address(const char* library, const char* function);

/// A function of C as if it were linked: `F` is its type, decltype(::name). Calls cost what a call
/// of a pointer does, but for the first.
template <class F>
class LateFunction {
 public:
  constexpr LateFunction(const char* library, const char* name) : library_(library), name_(name) {}

  template <class... Arguments>
  auto operator()(Arguments&&... arguments) {
    F* function = address_.load(std::memory_order_relaxed);
    if (function == nullptr) {
      function = reinterpret_cast<F*>(late_address(library_, name_));
      address_.store(function, std::memory_order_relaxed);
    }
    return function(std::forward<Arguments>(arguments)...);
  }

 private:
  const char *library_, *name_;
  std::atomic<F*> address_ = nullptr;
};

}  // namespace sunload
