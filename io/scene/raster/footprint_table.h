// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the columns of plan data tell of a footprint: its name, its height, where it begins.
#pragma once

#include <optional>
#include <string>

#include "io/base/file_text.h"
#include "io/base/first_of_many.h"
#include "io/base/gdal.h"
#include "io/scene/base/file_rules.h"
#include "io/scene/raster/layer_columns.h"

namespace sunload {

/// Counts what is not as it should be; tells it at the end.
class FootprintTable {
 public:
  /// Finds the columns; those that the rules do not name by their usual names, which is noted.
  /// `unit_m`: of lengths without one. `notes` must outlive it. Throws InputError, which lists the
  /// columns, where one is not there, or none of heights is known.
  FootprintTable(const std::string& path, OGRLayerH layer, FootprintRules rules, double unit_m,
                 NoteCounter& notes);

  std::string name_of(OGRFeatureH feature) const;
  /// Above its foot, as it is written, by storeys, or that of all [m]. Those without, and without
  /// a default, are counted under their name.
  std::optional<double> height_m(OGRFeatureH feature, const std::string& name);
  /// Where a part of a building begins above its foot [m]; 0: there.
  double lower_end_m(OGRFeatureH feature, double height_m, const std::string& name);
  /// Height of its foot, if it is written [m].
  std::optional<double> foot_m(OGRFeatureH feature);

  /// Throws InputError, which names the first, if any has no height. `others`: those that have.
  void refuse_without_height(std::size_t others) const;
  /// Notes on what was counted, of so many footprints.
  void note(std::size_t all) const;
  /// A warning of parts that begin no lower than they end; empty: there are none.
  std::string warning(std::size_t all) const;

 private:
  std::optional<double> known_height_m(OGRFeatureH feature);

  std::string path_;
  FootprintRules rules_;
  NoteCounter& notes_;
  LayerColumns columns_;
  int height_ = -1, storeys_ = -1, base_ = -1, name_ = -1, lower_end_ = -1, lower_level_ = -1;
  FirstOfMany without_height_, upside_down_;
  bool is_any_unread_ = false;  ///< of those without height
  std::size_t of_default_height_ = 0, raised_ = 0;
};

}  // namespace sunload
