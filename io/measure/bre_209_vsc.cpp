// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The vertical sky component of British practice; on other slopes the sky component outdoors.
#include "geo/base/units.h"
#include "io/measure/all_rules.h"
#include "solver/measure/sky_component.h"

namespace sunload::rules {

namespace {

class SkyComponent : public Measure {
 public:
  explicit SkyComponent(const MeasuredScene& scene) : scene_(scene) {}
  MeasureValues values() override {
    const Rotation enu = scene_from_enu(scene_.site).inverse();
    const Horizon& hills = scene_.site.horizon;
    const auto is_open = [&](Vec3 w) {
      return hills.is_open() || hills.is_above(horizontal(enu(w)));
    };
    constexpr double percent = 100;
    MeasureValues found{overcast_sky_components(scene_.points, scene_.caster, is_open)};
    for (double& value : found.value) value *= percent;
    return found;
  }

 private:
  const MeasuredScene& scene_;
};

}  // namespace

MeasureRule bre_209_vsc() {
  constexpr double least_percent = 27;
  return {.word = "bre_209_vsc",
          .definition =
              "sky component: light straight from the CIE overcast sky, as a share of "
              "that on open level ground; on a wall the vertical sky component, 27 % pass",
          .source = "BRE 209 (Littlefair 2022), 2.2; sky: CIE S 011, type 16",
          .units = "percent",
          .keys = {{"least_percent", least_percent}},
          .needs = MeasureRule::Needs::geometry,
          .levels =
              [](const MeasureParameters& of) {
                return std::vector<MeasureLevel>{{"pass", of.number("least_percent")}};
              },
          .start = [](const MeasureParameters&, const MeasuredScene& scene)
              -> std::unique_ptr<Measure> { return std::make_unique<SkyComponent>(scene); }};
}

}  // namespace sunload::rules
