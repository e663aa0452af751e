// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a message names of many: the first few, `a, b, c, …`.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sunload {

class FirstOfMany {
 public:
  explicit FirstOfMany(std::size_t most = 5) : most_(most) {}
  void add(std::string_view text) {
    if (count_++ >= most_) return;
    if (!text_.empty()) text_ += ", ";
    text_ += text;
  }
  /// So many more, of which nobody asks for names.
  void add_unnamed(std::size_t count) { unnamed_ += count; }
  std::size_t count() const { return count_ + unnamed_; }
  std::string text() const {
    return count_ > most_ || unnamed_ > 0 ? text_ + (text_.empty() ? "…" : ", …") : text_;
  }

 private:
  std::size_t most_, count_ = 0, unnamed_ = 0;
  std::string text_;
};

}  // namespace sunload
