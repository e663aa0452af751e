// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/name_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "geo/base/check.h"
#include "io/base/first_of_many.h"
#include "io/base/key_names.h"

namespace sunload {
namespace {

// A third of the letters wrong is as far as a slip of the hand goes.
constexpr std::size_t letters_per_slip = 3;

std::string lower(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

std::string quoted(const std::vector<std::string>& names) {
  FirstOfMany quoted;
  for (const std::string& name : names) quoted.add(fmt::format("'{}'", name));
  return quoted.text();
}

void add_unknown(Problems& problems, const std::string& pattern,
                 const std::vector<std::string>& names, const std::string& kind,
                 const std::string& file) {
  const std::string what = pattern.find_first_of("*?") == std::string::npos
                               ? fmt::format("no {} '{}'", kind, pattern)
                               : fmt::format("no {} matches '{}'", kind, pattern);
  if (names.empty()) return problems.add({file}, what, "there are none");
  const auto near = near_names(pattern, names);
  problems.add({file}, what, fmt::format("there are {}", names.size()),
               near.empty() ? fmt::format("write one of {}; sunload info --{}s lists them",
                                          quoted(names), kind)
                            : fmt::format("did you mean {}?", quoted(near)));
}

}  // namespace

bool matches(const std::string& pattern, const std::string& text) {
  if (pattern.empty()) return true;
  // Greedy matching with one backtracking point: the last `*` seen.
  std::size_t p = 0, t = 0, star = std::string::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t]) && pattern[p] != '*') {
      ++p;
      ++t;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (star != std::string::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::vector<std::string> near_names(const std::string& word,
                                    const std::vector<std::string>& known) {
  const std::size_t wildcard = word.find_first_of("*?");
  const std::string wanted = lower(word.substr(0, wildcard));
  if (wanted.empty()) return {};
  const auto most = static_cast<int>(std::max<std::size_t>(1, wanted.size() / letters_per_slip));
  std::vector<std::pair<int, std::string>> near;
  for (const auto& name : known) {
    const std::string candidate = lower(name);
    const bool is_beginning = wildcard != std::string::npos;
    const int slips =
        candidate.find(wanted) != std::string::npos
            ? 0
            : edit_distance(wanted, is_beginning ? candidate.substr(0, wanted.size()) : candidate);
    if (slips <= most) near.emplace_back(slips, name);
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  names.reserve(near.size());
  for (auto& [slips, name] : near) names.push_back(std::move(name));
  return names;
}

std::vector<std::size_t> matching_names(const std::vector<std::string>& patterns,
                                        const std::vector<std::string>& names,
                                        const std::string& kind, const std::string& file) {
  std::vector<char> is_chosen(names.size(), patterns.empty() ? 1 : 0);
  Problems problems;
  for (const auto& pattern : patterns) {
    bool is_known = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      // A name may have a star of its own; an empty pattern is a slip, not everything.
      if (names[i] != pattern && (pattern.empty() || !matches(pattern, names[i]))) continue;
      is_chosen[i] = 1;
      is_known = true;
    }
    if (!is_known) add_unknown(problems, pattern, names, kind, file);
  }
  problems.throw_if_any();
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (is_chosen[i]) chosen.push_back(i);
  return chosen;
}

}  // namespace sunload
