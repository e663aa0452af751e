// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Files are written while the work goes on.
#pragma once

#include <functional>
#include <future>

namespace sunload {

/// One file at a time is written on a thread of its own; whoever has the next one waits for it.
class WritingBehind {
 public:
  using Write = std::function<void()>;

  WritingBehind() = default;
  /// Waits; what goes wrong then is lost: ask `finish` first.
  ~WritingBehind() = default;
  WritingBehind(const WritingBehind&) = delete;
  WritingBehind& operator=(const WritingBehind&) = delete;

  /// Waits for the file before, then begins with this one: at once, where no thread is to be had.
  /// Throws what the file before threw, and does not write this one then.
  void begin(const Write& write);
  /// Waits for the file in hand. Throws what it threw, once.
  void finish();

 private:
  std::future<void> written_;
};

}  // namespace sunload
