// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Hints for misspelt words: nearest name, and units at the end of a key.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunload {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn one
/// word into the other (Damerau 1964; each place is edited at most once).
int edit_distance(std::string_view a, std::string_view b);

/// `did you mean 'diffuse'?`, or the list of the known words if none is near. A key that
/// lacks its unit or carries another one is told the right key and its unit.
std::string key_hint(const std::string& unknown, const std::vector<std::string>& known);

/// "degrees" for `latitude_deg`; empty where the key ends in no unit.
std::string unit_of_key(std::string_view key);

/// What a number that is written with a unit is multiplied by to be in the unit of a key, as
/// unit_of_key names it: 0.01 for "cm" and "metres", -1 for "S" (south) and "degrees". Nothing
/// where the word is no unit of that kind.
std::optional<double> factor_to_unit(std::string_view word, std::string_view unit);
/// Whether it is a unit without a prefix: a number before it is one of that unit.
bool is_plain_unit(std::string_view word);

}  // namespace sunload
