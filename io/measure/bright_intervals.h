// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sun that weather leaves: of the intervals with a strong enough beam.
#pragma once

#include "io/measure/rule.h"

namespace sunload {

/// 120 W m-2: what the World Meteorological Organization calls sunshine.
inline constexpr double sunshine_w_m2 = 120;

/// Stretches of the intervals whose DNI while sunlit is at least so much; in winter: those alone
/// whose middle lies from 21 September up to 21 March by the site's clock, south of the equator
/// from 21 March up to 21 September: from the equinox of autumn to that of spring, both days
/// included.
enum class InSeason { year, winter };
std::vector<SunStretch> bright_stretches(const MeasuredScene& scene, double least_dni,
                                         InSeason season = InSeason::year);

}  // namespace sunload
