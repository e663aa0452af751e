// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the result file (docs/result-file.md): HDF5 that netCDF-4 tools read.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geo/base/vec.h"
#include "io/base/light_quantity.h"
#include "io/result/period_choice.h"
#include "solver/light/band.h"

namespace sunload {

/// Whether files that are derived from results are opened, too: a comparison file
/// (docs/comparison-file.md) or the map of a place (docs/explain.md). They have the patches and
/// names of their base, no times, and as totals the datasets of `comparison_schema` or
/// `place_map_schema`.
enum class Opens { results, derived_too };

/// Reads a result of ours; throws InputError naming file and dataset. Of an opened file holds what
/// io/result/soundness.h asks for; values that are read are possible ones, or NaN.
///
/// A result of light in bands reads as one without: `band` chooses one of them, without it values
/// are the means of the bands, which is broadband light, and the largest ones those of the mean.
/// (Standard errors of the mean come from its realizations, where these are stored; otherwise the
/// mean of the bands' errors is an upper bound, since they share their lines.) Shapes have no
/// dimension `band` then.
class ResultReader {
 public:
  explicit ResultReader(const std::string& path, std::optional<std::size_t> band = {},
                        Opens opens = Opens::results);
  ~ResultReader();
  /// From now on totals of the period are those of a part of it; those that nobody knows of it are
  /// not there. Series, sun and times stay. Throws InputError where the result has nothing of it.
  void choose(const PeriodChoice& choice);
  const PeriodChoice& chosen() const;  ///< nothing: the whole period
  /// Share of every interval that is chosen.
  std::vector<double> chosen_shares() const;
  const std::string& path() const;
  bool has(const std::string& dataset) const;
  std::vector<std::size_t> shape(const std::string& dataset) const;
  std::vector<double> doubles(const std::string& dataset) const;  ///< whole, converted
  std::vector<std::int32_t> integers(const std::string& dataset) const;
  std::vector<std::string> strings(const std::string& dataset) const;
  /// One row of a [time, n] dataset.
  std::vector<double> row(const std::string& dataset, std::size_t time) const;
  /// `count` ≥ 1 rows from row `first` on, one after the other.
  std::vector<double> rows(const std::string& dataset, std::size_t first, std::size_t count) const;
  std::string units(const std::string& dataset) const;
  std::string text_attribute(const std::string& name) const;  ///< of the root; empty if absent
  /// What a result lacks that was merged before all of it was computed; empty of others.
  std::string lacking() const { return text_attribute("incomplete"); }
  double number_attribute(
      const std::string& name) const;  ///< of the root; NaN if absent or impossible
  bool is_comparison() const;
  /// The dataset of results that a comparison is of.
  std::string compared() const;
  bool is_place_map() const;
  /// One of both.
  bool is_derived() const { return is_comparison() || is_place_map(); }
  Quantity quantity() const;
  Bands bands() const;
  /// Absolute position that positions in the file are relative to [m]; zero if absent.
  Vec3 origin() const;
  std::optional<std::size_t> band() const;  ///< that was chosen
  /// Of a dataset; empty if absent.
  std::string text_attribute(const std::string& dataset, const std::string& name) const;
  std::vector<double> number_attributes(const std::string& dataset, const std::string& name) const;
  /// Of a dataset; NaN if absent.
  double number_attribute(const std::string& dataset, const std::string& name) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace sunload
