// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/variant_texts.h"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace sunload {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// What a line is about: the word that it begins with.
std::string subject(const std::string& line) {
  std::istringstream words(line);
  std::string first;
  words >> first;
  return first;
}

template <class IsIt>
bool has_line(const std::vector<std::string>& lines, const IsIt& is_it) {
  return std::any_of(lines.begin(), lines.end(), is_it);
}

/// Lines of a section that are not in the first variant's.
std::string changed_lines(const std::string& first, const std::string& own) {
  const auto theirs = lines_of(first);
  std::string text;
  for (const auto& line : lines_of(own))
    if (!has_line(theirs, [&](const auto& other) { return other == line; })) text += line + "\n";
  return text;
}

/// Subjects that the first variant's section has alone.
std::string missing_subjects(const std::string& first, const std::string& own) {
  const auto mine = lines_of(own);
  std::string text;
  for (const auto& line : lines_of(first))
    if (!has_line(mine, [&](const auto& other) { return subject(other) == subject(line); }))
      text += "  without   " + subject(line) + "\n";
  return text;
}

const std::string& section_of(const CheckText& text, const std::string& heading) {
  static const std::string none;
  for (const auto& [name, words] : text.sections)
    if (name == heading) return words;
  return none;
}

std::string whole_text(const CheckText& text) {
  std::string words = text.head + "\n";
  for (const auto& [heading, lines] : text.sections) {
    if (!heading.empty() && !lines.empty()) words += heading + "\n";
    words += lines;
  }
  return words;
}

/// A later variant by what differs from the first one: what both have is told once.
std::string text_beside(const CheckText& first, const CheckText& text,
                        const std::string& first_name) {
  std::string words;
  for (const auto& [heading, own] : text.sections) {
    const auto& theirs = section_of(first, heading);
    auto apart = changed_lines(theirs, own);
    if (heading == "materials") apart += missing_subjects(theirs, own);
    if (heading == "seasons" && own.empty() && !theirs.empty()) apart = "  none\n";
    if (apart.empty()) continue;
    if (!heading.empty()) words += heading + "\n";
    words += apart;
  }
  return text.head + (words.empty() ? ": as " + first_name + "\n"
                                    : ": as " + first_name + ", but for\n" + words);
}

}  // namespace

void VariantTexts::print(const std::string& name, CheckText text) {
  if (!first_) {
    std::cout << whole_text(text);
    first_ = std::move(text);
    first_name_ = name;
    return;
  }
  std::cout << "\n" << text_beside(*first_, text, first_name_);
}

}  // namespace sunload
