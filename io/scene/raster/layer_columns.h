// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Columns of a layer of plan data, and what is written in them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/file_text.h"
#include "io/base/gdal.h"
#include "io/scene/raster/written_length.h"

namespace sunload {

/// Counts what should be a number and is none.
class LayerColumns {
 public:
  /// Of columns, the more telling first; lower case.
  using UsualNames = std::span<const std::string_view>;

  /// `unit_m`: of lengths without one.
  LayerColumns(const std::string& path, OGRLayerH layer, double unit_m);

  /// The number of the column of that name; throws InputError, which lists the columns, where there
  /// is none.
  int named(const std::string& name) const;
  /// That of the first of these that there is; -1: none.
  int usual(UsualNames names) const;
  /// That of the wanted name, or where it is empty of the first usual one, which is noted: "heights
  /// of footprints".
  int found(const std::string& wanted, UsualNames usual_names, const std::string& what,
            NoteCounter& notes) const;
  const std::string& name(int column) const { return names_[static_cast<std::size_t>(column)]; }
  std::string in_words() const;

  /// Empty where nothing is written; as below of the column -1.
  std::string text(OGRFeatureH feature, int column) const;
  /// A number that is no length: with a comma it may be a list.
  std::optional<double> number(OGRFeatureH feature, int column);
  /// In the unit that stands behind it, as OpenStreetMap has it (`12 m`, `40'`), or in the layer's.
  std::optional<double> length_m(OGRFeatureH feature, int column);

  /// Begins to look for what is no number in a feature.
  void look_anew() { last_unread_.clear(); }
  /// The last such text since then; empty: none.
  const std::string& last_unread() const { return last_unread_; }
  std::size_t unread() const { return unread_; }
  const std::string& first_unread() const { return first_unread_; }

 private:
  /// Of a text, read as `readable`.
  std::optional<WrittenLength> written(const std::string& text, const std::string& readable);
  void count_unread(const std::string& text);

  std::string path_;
  double unit_m_;
  std::vector<std::string> names_;
  std::size_t unread_ = 0;
  std::string first_unread_, last_unread_;
};

}  // namespace sunload
