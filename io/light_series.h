/// Period, sun path and irradiance of a study: the light of every interval.
#pragma once

#include <vector>

#include "geo/irradiance.h"
#include "geo/site.h"
#include "geo/sun.h"
#include "io/study.h"
#include "solver/sun_block.h"

namespace sunload {

/// One interval of the period with its light; irradiances are means over it.
struct LitInterval {
  SunInterval when;
  Irradiance mean;        ///< over the whole interval
  Irradiance of_the_sky;  ///< while the sun is up: what the sky's shape follows from
};

struct LightSeries {
  std::vector<LitInterval> intervals;
  bool times_are_synthetic = false;   ///< `positions`: time counts from 2000-01-01T12:00Z
  std::vector<std::string> notes;     ///< what happened at clock changes, table ends, …
  std::size_t lit_count() const;
};

/// Sun path and irradiance of every interval (DESIGN 4).
/// Throws InputError for times that do not exist or do not increase.
LightSeries light_series(const Study& study, const Site& site);

/// Light for the solver, with the sky's radiance on `grid`, of interval `number`.
SunLight sun_light(const LitInterval& interval, std::uint32_t number, const LightStudy& light,
                   const SkyGrid& grid);

}  // namespace sunload
