// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A time zone by the nearest place of the time-zone database.
#pragma once

#include <optional>
#include <string>

namespace sunload {

struct ZoneGuess {
  std::string name;  ///< IANA, e.g. Europe/Amsterdam
  /// Of the place that the database gives the zone; nothing of an offset, which has none.
  std::optional<double> away_m = {};
};

/// The zone whose place (`zone.tab`: one for each zone and country) is nearest; of those with that
/// standard offset from UTC [s], where one is given and any has it; of those of the
/// country that `area` is of (area_of_use_words), where it is of one and any zone is left. A guess:
/// zones end at borders, which the database does not have. Nothing where the system has no such
/// table.
std::optional<ZoneGuess> guessed_zone(double latitude_deg, double longitude_deg,
                                      std::optional<double> standard_offset_s = {},
                                      const std::string& area = {});

}  // namespace sunload
