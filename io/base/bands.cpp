// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/bands.h"

#include <algorithm>

#include "geo/base/check.h"

namespace sunload {

std::vector<std::string> band_prefixes(Bands bands) {
  if (bands == Bands::broadband) return {""};
  std::vector<std::string> prefixes;
  for (const std::string name : band_names) prefixes.push_back(name + "/");
  return prefixes;
}

BandArray band_array(const std::string& name) {
  const auto prefixes = band_prefixes(Bands::rgb);
  for (std::size_t b = 0; b < prefixes.size(); ++b)
    if (name.starts_with(prefixes[b])) return {b, name.substr(prefixes[b].size())};
  return {std::nullopt, name};
}

std::size_t band_by_name(const std::string& name) {
  const auto found = std::find(band_names.begin(), band_names.end(), name);
  if (found == band_names.end())
    throw InputError({}, "no band " + name, "", "choose one of: red, green, blue");
  return static_cast<std::size_t>(found - band_names.begin());
}

std::vector<double> side_by_side(std::vector<std::vector<double>> bands, std::size_t rows) {
  if (bands.size() == 1) return std::move(bands.front());
  std::vector<double> values;
  values.reserve(bands.size() * bands.front().size());
  const std::size_t n = rows > 0 ? bands.front().size() / rows : 0;
  for (std::size_t row = 0; row < rows; ++row)
    for (const auto& band : bands) {
      const auto begin = band.begin() + static_cast<std::ptrdiff_t>(row * n);
      values.insert(values.end(), begin, begin + static_cast<std::ptrdiff_t>(n));
    }
  return values;
}

}  // namespace sunload
