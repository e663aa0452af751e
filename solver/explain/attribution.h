// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which objects take light from a place and which give it light, over a whole period.
///
/// Rays look once along every way on which light may come to the place: the very sun samples and
/// lines (the same random numbers) that the solution casts from its patches. In the open such a way
/// brings the sun, a cell of the sky or the far ground. The surface that it meets first takes this
/// light, and gives what it sends along the way instead:
///
///     H = open − Σ_objects taken + Σ_objects given,
///     given = w (∫ B dt of the patch that is met)  +  what mirrors there send on
///
/// with ∫ B dt from a finished solution. So the objects add up to the light load of the place, but
/// for the spread of the lines and for light that is not looked for: the sun by glossy lobes, by
/// mirrors of too many orientations for beams, and parallel sources.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/explain/place_lines.h"
#include "solver/light/lit_period.h"
#include "solver/traced/traced_scene.h"

namespace sunload {

/// What an object does with the light of a place.
enum class Flow {
  takes_sun,
  takes_sky,
  takes_far_ground,
  reflects,  ///< diffusely, seen straight
  mirrors,   ///< all that is seen by way of it: sun, sky, far ground, other surfaces
  shines     ///< by itself, seen straight
};
inline constexpr std::size_t flow_count = 6;

/// To what light is attributed: to whole objects, or to each patch. A surface without patches
/// (floor, back) takes light as part of its object only, and gives nothing.
enum class Among { objects, patches };

/// Light that each object (or patch) takes and gives, of every realization [J m-2, or lx s], means
/// over the place.
class Attribution {
 public:
  /// Light of a way on which nothing stands.
  enum class Open { sun, sky, far_ground };
  static constexpr std::size_t open_count = 3;

  Attribution(std::size_t objects, std::size_t realizations)
      : realizations_(realizations),
        open_(open_count * realizations),
        flows_(objects * flow_count * realizations) {}
  std::size_t realizations() const { return realizations_; }
  std::size_t objects() const { return flows_.size() / flow_count / realizations_; }

  double open(Open source, std::size_t r) const { return open_[at(source, r)]; }
  double flow(std::size_t object, Flow flow, std::size_t r) const {
    return flows_[at(object, flow, r)];
  }
  /// What an object adds to the place: below 0 where it takes more than it gives.
  double net(std::size_t object, std::size_t r) const;
  /// What the place has of all that was looked for.
  double total(std::size_t r) const;

  void add_open(Open source, std::size_t r, double value) { open_[at(source, r)] += value; }
  void add_flow(std::size_t object, Flow flow, std::size_t r, double value) {
    flows_[at(object, flow, r)] += value;
  }

 private:
  std::size_t at(Open source, std::size_t r) const {
    return static_cast<std::size_t>(source) * realizations_ + r;
  }
  std::size_t at(std::size_t object, Flow flow, std::size_t r) const {
    return (object * flow_count + static_cast<std::size_t>(flow)) * realizations_ + r;
  }
  std::size_t realizations_;
  std::vector<double> open_, flows_;
};

/// Of each patch, over the period [J m-2, or lx s]: what it reflects and emits diffusely.
using SentLight = std::vector<double>;

/// `shares`: the share of each interval that is looked at; empty: all of it. `sent` must be of the
/// same part of the time. Sums over the patches of an object are the object's values, but for
/// surfaces without patches. `traced` needs no lines of its own. Objects are those of the scene's
/// mesh. The same bits for any number of threads. Cost: a ray for each sun sample and line of the
/// place, and as many for each mirror orientation that may show it the sun. Throws Interrupted.
Attribution attribute_light(const TracedScene& traced, const LitPeriod& period,
                            const SentLight& sent, const Place& place,
                            const std::vector<double>& shares = {}, Among among = Among::objects);

}  // namespace sunload
