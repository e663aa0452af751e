// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/json_text.h"

#include "io/base/file_text.h"

namespace sunload {

namespace {

/// City models need 10 levels; attributes of extensions may add some.
constexpr int deepest_nesting = 200;

/// The library's message without its own number and place.
std::string reason(const std::string& library_message) {
  const auto place = library_message.find("column ");
  const auto colon = library_message.find(": ", place == std::string::npos ? 0 : place);
  if (colon != std::string::npos && place != std::string::npos) {
    return library_message.substr(colon + 2);
  }
  const auto bracket = library_message.find("] ");
  return bracket == std::string::npos ? library_message : library_message.substr(bracket + 2);
}

/// Byte of the number that the library's message quotes last.
std::size_t byte_of_quoted(std::string_view text, const std::string& library_message) {
  const auto end = library_message.rfind('\'');
  if (end == std::string::npos || end == 0) return 0;
  const auto begin = library_message.rfind('\'', end - 1);
  if (begin == std::string::npos) return 0;
  const auto found = text.find(library_message.substr(begin + 1, end - begin - 1));
  return found == text.npos ? 0 : found;
}

}  // namespace

std::size_t first_json_value_end(const std::string& file, std::string_view text) {
  int depth = 0;
  auto first_end = text.npos;
  for (std::size_t i = 0; i < text.size(); ++i) {
    switch (text[i]) {
      case '"':
        for (++i; i < text.size() && text[i] != '"'; ++i) {
          if (text[i] == '\\') ++i;
        }
        break;
      case '[':
      case '{':
        if (++depth > deepest_nesting) {
          throw InputError(place_in_text(file, text, i), "values are nested too deeply",
                           "more than " + std::to_string(deepest_nesting) + " levels");
        }
        break;
      case ']':
      case '}':
        if (--depth == 0 && first_end == text.npos) first_end = i + 1;
        break;
      default:
        break;
    }
  }
  return first_end;
}

nlohmann::json parse_json(const std::string& file, std::string_view text, int first_line) {
  try {
    return nlohmann::json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::parse_error& error) {
    const auto byte = error.byte > 0 ? error.byte - 1 : 0;
    throw InputError(place_in_text(file, text, byte, first_line), "is no valid JSON",
                     reason(error.what()), byte >= text.size() ? "is the file cut off?" : "");
  } catch (const nlohmann::json::exception& error) {
    throw InputError(place_in_text(file, text, byte_of_quoted(text, error.what()), first_line),
                     "is no valid JSON", reason(error.what()));
  }
}

}  // namespace sunload
