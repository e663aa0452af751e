// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Text of files as readers need it: bytes, places in them, counted notes.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "geo/base/check.h"

namespace sunload {

/// The bytes of a regular file of at most 2 GB; throws InputError otherwise.
std::string read_whole_file(const std::string& path);

/// The same without the mark of UTF-8 that editors put before a text.
std::string read_text_file(const std::string& path);
std::string_view without_byte_order_mark(std::string_view text);

/// The first bytes of a file, enough to tell its format.
std::string read_file_head(const std::string& path, std::size_t byte_count);

/// Line and column (from 1) of a byte of a text.
Where place_in_text(const std::string& file, std::string_view text, std::size_t byte,
                    int first_line = 1);

std::string lower_case(std::string text);

/// Without blanks and ends of lines around it.
std::string_view trimmed(std::string_view text);

/// Extension in lower case with its dot, or nothing.
std::string lower_extension(const std::string& path);

/// Counts what happened; each kind becomes one note, `12 faces …`.
class NoteCounter {
 public:
  void count(const std::string& what, std::size_t times = 1) {
    if (times > 0) counts_[what] += times;
  }
  /// A note without a number, kept once.
  void say(const std::string& what) { counts_.try_emplace(what, 0); }
  /// What the user must know: something is lost that was meant to be there.
  void warn(const std::string& what, std::size_t times) {
    if (times > 0) warnings_[what] += times;
  }
  std::vector<std::string> lines() const { return lines_of(counts_); }
  std::vector<std::string> warnings() const { return lines_of(warnings_); }

 private:
  using Counts = std::map<std::string, std::size_t>;
  static std::vector<std::string> lines_of(const Counts& counts);

  Counts counts_, warnings_;
};

}  // namespace sunload
