// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Words and numbers of line-based text formats such as OBJ.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace sunload {

/// Words of one statement after another; `\` at the end of a line continues it.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  bool at_end() const { return at_ >= text_.size(); }

  /// The next word of the statement, empty at its end.
  std::string_view next() {
    skip_blanks();
    if (at_end() || text_[at_] == '\n' || text_[at_] == '#') return {};
    const auto begin = at_;
    while (!at_end() && !is_blank(text_[at_]) && text_[at_] != '\n' && continuation() == 0) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// What is left of the line, without blanks around it: names may hold blanks.
  std::string_view rest() {
    skip_blanks();
    const auto begin = at_;
    auto end = at_ = std::min(text_.find('\n', at_), text_.size());
    while (end > begin && is_blank(text_[end - 1])) --end;
    return text_.substr(begin, end - begin);
  }

  void go_to_next_line() { at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1; }

  std::size_t byte_of(std::string_view word) const {
    return word.empty() ? at_ : static_cast<std::size_t>(word.data() - text_.data());
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

  /// Length of the mark at the cursor that continues a line, 0 where there is none.
  std::size_t continuation() const {
    const auto ahead = text_.substr(at_, 3);
    return ahead.starts_with("\\\n") ? 2 : ahead.starts_with("\\\r\n") ? 3 : 0;
  }

  void skip_blanks() {
    while (!at_end()) {
      const auto length = is_blank(text_[at_]) ? 1 : continuation();
      if (length == 0) return;
      at_ += length;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// A decimal number, correctly rounded; nothing for NaN, infinity and anything else.
inline std::optional<double> finite_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool is_whole = end == word.data() + word.size();
  const bool underflows = error == std::errc::result_out_of_range &&
                          (word.find("e-") != word.npos || word.find("E-") != word.npos);
  if (underflows && is_whole) return 0.0;
  if (error != std::errc() || !is_whole || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// A word of a file for a message, cut where it is long.
inline std::string shortened(std::string_view word) {
  constexpr std::size_t longest = 40;  // characters: half a line of a terminal
  return std::string(word.substr(0, longest)) + (word.size() > longest ? "…" : "");
}

}  // namespace sunload
