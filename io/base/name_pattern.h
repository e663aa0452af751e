// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Names that users give by pattern, and what to say where none fits.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sunload {

/// Whether `text` matches a pattern with `*` and `?`; the empty pattern matches everything.
bool matches(const std::string& pattern, const std::string& text);

/// Entries of `names` that are one of `patterns` or match one, in their own order; all where there
/// are no patterns. Throws InputError for every pattern that chooses none: `file: no facade
/// matches 'hause_1/*' (there are 323); did you mean 'house_1/north_1', …?`. `kind`: "facade".
std::vector<std::size_t> matching_names(const std::vector<std::string>& patterns,
                                        const std::vector<std::string>& names,
                                        const std::string& kind, const std::string& file);

/// Names of `known` that one may have meant, the nearest first: those that contain the word, or
/// differ in a third of its letters at most. Of a pattern its beginning, before `*` or `?`, counts.
std::vector<std::string> near_names(const std::string& word, const std::vector<std::string>& known);

}  // namespace sunload
