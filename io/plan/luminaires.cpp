// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/luminaires.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/plan/far_places.h"
#include "io/plan/row_places.h"
#include "io/scene/ies_file.h"
#include "solver/surface/sensor.h"

namespace sunload {

namespace {

constexpr double most_of_a_row = 10'000;

/// Of 1 cd within a cone about the axis; 360: all round.
IntensityWeb even_within(double beam_deg) { return {{0}, {0, beam_deg / 2}, {1, 1}}; }

class Placing {
 public:
  explicit Placing(Vec3 origin) : origin_(origin) {}

  void add(const LuminaireStudy& study) {
    const std::size_t web = web_of(study);
    double scale = study.intensity_cd.value_or(1);
    if (study.flux_lm) scale = *study.flux_lm / placed_.webs[web].flux();
    for (const Vec3 at : places_of(study)) {
      Luminaire luminaire(at - origin_, normalized(study.towards),
                          -study.turn_deg * radians_per_degree);
      luminaire.web = web;
      luminaire.scale = scale;
      luminaire.key = key_of_place(at, luminaire.axis);
      placed_.all.push_back(luminaire);
    }
  }
  Luminaires placed() && { return std::move(placed_); }

 private:
  std::size_t web_of(const LuminaireStudy& study) {
    const std::string name =
        study.file.empty() ? fmt::format("beam {}", study.beam_deg) : "file " + study.file;
    if (const auto known = web_by_name_.find(name); known != web_by_name_.end())
      return known->second;
    placed_.webs.push_back(study.file.empty() ? even_within(study.beam_deg)
                                              : read_ies_file(study.file));
    return web_by_name_[name] = placed_.webs.size() - 1;
  }

  static std::vector<Vec3> places_of(const LuminaireStudy& study) {
    if (!study.to) return {study.position};
    const Vec3 way = *study.to - study.position;
    if (norm(way) / study.every_m > most_of_a_row)
      throw InputError(study.where, "the row of luminaires is too long",
                       fmt::format("it has at most {} of them", most_of_a_row), "");
    std::vector<Vec3> places;
    for (const double share : row_shares(norm(way), study.every_m))
      places.push_back(study.position + way * share);
    return places;
  }

  Vec3 origin_;
  Luminaires placed_;
  std::map<std::string, std::size_t> web_by_name_;
};

}  // namespace

Luminaires place_luminaires(const std::vector<LuminaireStudy>& studies, const Mesh& mesh,
                            const Box& bounds, std::vector<std::string>& warnings) {
  Placing placing(mesh.origin);
  Problems problems;
  for (const LuminaireStudy& study : studies) {
    try {
      placing.add(study);
    } catch (const InputError& error) {
      problems.add(error);
    }
  }
  problems.throw_if_any();
  Luminaires luminaires = std::move(placing).placed();
  FarPlaces far(mesh.origin, bounds);
  for (const Luminaire& luminaire : luminaires.all) far.look_at(luminaire.position);
  if (far.any())
    warnings.push_back(message(studies.front().where, far.words("luminaires", "luminaire"),
                               "they light little of it", FarPlaces::hint));
  return luminaires;
}

}  // namespace sunload
