// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/layer_columns.h"

#include <fmt/format.h>

#include <algorithm>

#include "geo/base/check.h"

namespace sunload {

namespace {

std::vector<std::string> columns_of(OGRLayerH layer) {
  std::vector<std::string> all;
  OGRFeatureDefnH definition = gdal::OGR_L_GetLayerDefn(layer);
  const int count = gdal::OGR_FD_GetFieldCount(definition);
  all.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    all.emplace_back(gdal::OGR_Fld_GetNameRef(gdal::OGR_FD_GetFieldDefn(definition, k)));
  return all;
}

}  // namespace

LayerColumns::LayerColumns(const std::string& path, OGRLayerH layer, double unit_m)
    : path_(path), unit_m_(unit_m), names_(columns_of(layer)) {}

std::string LayerColumns::in_words() const {
  return names_.empty() ? "it has no columns"
                        : fmt::format("its columns: {}", fmt::join(names_, ", "));
}

int LayerColumns::named(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end())
    throw InputError({path_}, fmt::format("has no column '{}'", name), in_words());
  return static_cast<int>(found - names_.begin());
}

int LayerColumns::usual(UsualNames names) const {
  for (const auto name : names)
    for (std::size_t k = 0; k < names_.size(); ++k)
      if (lower_case(names_[k]) == name) return static_cast<int>(k);
  return -1;
}

int LayerColumns::found(const std::string& wanted, UsualNames usual_names, const std::string& what,
                        NoteCounter& notes) const {
  if (!wanted.empty()) return named(wanted);
  const int column = usual(usual_names);
  if (column >= 0) notes.say(fmt::format("{} from column {}", what, name(column)));
  return column;
}

std::string LayerColumns::text(OGRFeatureH feature, int column) const {
  if (column < 0 || gdal::OGR_F_IsFieldSetAndNotNull(feature, column) == 0) return {};
  return gdal::OGR_F_GetFieldAsString(feature, column);
}

std::optional<WrittenLength> LayerColumns::written(const std::string& text,
                                                   const std::string& readable) {
  if (text.empty()) return {};
  auto found = written_length(readable);
  if (!found) count_unread(text);
  return found;
}

void LayerColumns::count_unread(const std::string& text) {
  constexpr std::size_t enough = 20;
  last_unread_ = text.substr(0, enough);
  if (unread_++ == 0) first_unread_ = last_unread_;
}

std::optional<double> LayerColumns::number(OGRFeatureH feature, int column) {
  const std::string as_it_is(trimmed(text(feature, column)));
  const auto found = written(as_it_is, as_it_is);
  if (!found || found->unit.empty()) return found ? std::optional(found->value) : std::nullopt;
  count_unread(fmt::format("{:g} {}", found->value, found->unit));
  return {};
}

std::optional<double> LayerColumns::length_m(OGRFeatureH feature, int column) {
  constexpr double international_foot_m = 0.3048;
  const std::string as_it_is(trimmed(text(feature, column)));
  const auto found = written(as_it_is, with_decimal_point(as_it_is));
  if (!found) return {};
  return found->value * (found->unit.empty()   ? unit_m_
                         : found->is_in_feet() ? international_foot_m
                                               : 1);
}

}  // namespace sunload
