// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of facades, objects, their orientations, selections or sensors: what each receives.
#pragma once

#include <string>
#include <vector>

#include "io/result/named_parts.h"
#include "io/result/reader.h"

namespace sunload {

/// What the rows are. Orientations: of every object its walls and windows by eight compass points,
/// and its roofs: "house_3/south", "house_3/roof".
enum class TableOf { facades, objects, orientations, selections, sensors };

/// One column of numbers; NaN: there is none, or it is not known.
struct TableColumn {
  std::string key;          ///< with its unit: "light_load_kwh_m2"; "klx_h" of illuminance
  std::string word, units;  ///< for people: "light load", "kWh/m²"
  const char* format;       ///< of fmt, for people
  std::vector<double> values;
};

/// Rows by name, columns of numbers.
struct GroupTable {
  TableOf of = TableOf::facades;
  std::vector<std::string> names;
  std::vector<std::size_t> entries;  ///< index of each row in the file
  std::vector<TableColumn> columns;
};

/// A row for every facade, object, orientation (of the objects that are chosen), selection or
/// sensor that `parts` chooses and that has area, in the order of the file. Columns: azimuth_deg
/// (clockwise from north; of orientations the middle of their eighth; none of objects, selections
/// and roofs, and of sensors that look straight up or down), area_m2 (of an object both sides; none
/// of sensors), the area-weighted mean light load with its standard error, that of the mesh
/// (io/result/mesh_error; none of sensors), load and standard error times the area, sun_hours_h and
/// sky_view_factor (means), irradiance_max_w_m2 (largest of any patch at any instant); of sensors
/// also x_m, y_m, z_m, absolute. Loads of facades are those of the file; standard errors come from
/// the realizations. Throws InputError where the result has none of them or lacks what is named,
/// and for names of another kind.
GroupTable group_table(const ResultReader& result, TableOf of, const NamedParts& parts);

/// RFC 4180: `name` and the columns' keys, a row for each; what is not known is empty.
std::string group_table_csv(const GroupTable& table);

}  // namespace sunload
