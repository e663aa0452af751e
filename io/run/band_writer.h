// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Totals of every band as a result has them, side by side.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/base/bands.h"
#include "io/result/writer.h"

namespace sunload {

inline std::vector<double> scaled(std::vector<double> values, double factor) {
  for (auto& v : values) v *= factor;
  return values;
}

/// Writes what follows from the totals of every band.
class BandWriter {
 public:
  BandWriter(ResultWriter& writer, Bands bands)
      : writer_(writer), prefixes_(band_prefixes(bands)) {}

  /// `of_band(prefix)` gives the values of one band, [rows, n].
  template <class OfBand>
  void write(const std::string& name, std::size_t rows, OfBand&& of_band) {
    writer_.write({name, all_bands(rows, of_band)});
  }
  /// The same of one part of the period.
  template <class OfBand>
  void write_part(const std::string& name, std::size_t part, std::size_t rows, OfBand&& of_band) {
    writer_.write_part({name, all_bands(rows, of_band)}, part);
  }
  /// What is the same in all bands.
  void write_once(const std::string& name, std::vector<double> values) {
    writer_.write({name, std::move(values)});
  }
  void write_part_once(const std::string& name, std::size_t part, std::vector<double> values) {
    writer_.write_part({name, std::move(values)}, part);
  }
  const std::string& first() const { return prefixes_.front(); }

 private:
  template <class OfBand>
  std::vector<double> all_bands(std::size_t rows, const OfBand& of_band) const {
    std::vector<std::vector<double>> bands;
    for (const auto& prefix : prefixes_) bands.push_back(of_band(prefix));
    return side_by_side(std::move(bands), rows);
  }

  ResultWriter& writer_;
  std::vector<std::string> prefixes_;
};

}  // namespace sunload
