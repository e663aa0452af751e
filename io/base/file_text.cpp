// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/file_text.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace sunload {

namespace {

/// Readers keep the text and a tree of it in memory, and count in 32 bits.
constexpr std::uintmax_t largest_file_bytes = 2'000'000'000;

std::uintmax_t size_of_regular_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw InputError({path}, "cannot be read", "there is no such file");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError({path}, "cannot be read", "it is not a regular file");
  }
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw InputError({path}, "cannot be read", error.message());
  return size;
}

std::string read_bytes(const std::string& path, std::uintmax_t byte_count) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(byte_count), '\0');
  if (!file.read(bytes.data(), static_cast<std::streamsize>(byte_count)) && byte_count > 0) {
    throw InputError({path}, "cannot be read", "opening or reading it failed",
                     "may this user read it?");
  }
  return bytes;
}

}  // namespace

std::string read_whole_file(const std::string& path) {
  const auto size = size_of_regular_file(path);
  if (size > largest_file_bytes) {
    throw InputError({path}, "has " + std::to_string(size) + " bytes",
                     "at most " + std::to_string(largest_file_bytes) + " can be read",
                     "split it into tiles");
  }
  return read_bytes(path, size);
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

std::string read_text_file(const std::string& path) {
  std::string text = read_whole_file(path);
  text.erase(0, text.size() - without_byte_order_mark(text).size());
  return text;
}

std::string read_file_head(const std::string& path, std::size_t byte_count) {
  return read_bytes(path, std::min<std::uintmax_t>(size_of_regular_file(path), byte_count));
}

Where place_in_text(const std::string& file, std::string_view text, std::size_t byte,
                    int first_line) {
  const auto before = text.substr(0, std::min(byte, text.size()));
  const auto line_start = before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1;
  const auto line_breaks = std::count(before.begin(), before.end(), '\n');
  return {file, first_line + static_cast<int>(line_breaks),
          static_cast<int>(before.size() - line_start) + 1};
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\n\r\v\f";
  const auto first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower_extension(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

std::vector<std::string> NoteCounter::lines_of(const Counts& counts) {
  std::vector<std::string> notes;
  for (const auto& [what, times] : counts) {
    notes.push_back(times == 0 ? what : std::to_string(times) + " " + what);
  }
  return notes;
}

}  // namespace sunload
