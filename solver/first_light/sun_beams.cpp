// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/sun_beams.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "solver/first_light/beam_section.h"

namespace sunload {

namespace {

// Light that grazes a mirror closer than this is not sent on by beams: their
// sections would be lines. It is less than that share of the mirror's light.
constexpr double least_cosine = 1e-6;

/// `before`, then the image in mirrors of normal n.
Rotation followed_by_image(const Rotation& before, Vec3 n) {
  const Vec3 along_n = n.x * before.rows[0] + n.y * before.rows[1] + n.z * before.rows[2];
  return {{before.rows[0] - 2 * n.x * along_n, before.rows[1] - 2 * n.y * along_n,
           before.rows[2] - 2 * n.z * along_n}};
}

}  // namespace

SunBeams::SunBeams(const MirrorGroups& groups, const IntervalLight& sun, const BeamRules& rules,
                   std::span<const std::uint8_t> dark)
    : groups_(&groups), rules_(rules), spread_(sun.disk_spread()) {
  if (!sun.has_sun() || sun.dni <= 0 || rules.mirror_depth < 1) return;
  follow(first_level(sun, dark));
}

void SunBeams::follow(std::vector<SunBeam> level) {
  while (!level.empty()) {
    if (beams_.size() + level.size() > static_cast<std::size_t>(rules_.most_beams)) {
      has_too_many_ = true;
      return;
    }
    const std::size_t begin = beams_.size();
    append(std::move(level));
    if (beams_.back().reflections == rules_.mirror_depth) return;
    level = next_level(begin);
  }
}

void SunBeams::follow_on(double faint_glint, int most_beams) {
  if (are_all(faint_glint)) return;
  SunBeams further(*groups_);
  further.rules_ = rules_;
  further.rules_.faint_glint = faint_glint;
  further.rules_.most_beams = most_beams;
  further.spread_ = spread_;
  std::vector<SunBeam> first;
  for (const SunBeam& beam : beams_)
    if (beam.reflections == 1) {
      first.push_back(beam);
      first.back().next.clear();
    }
  further.follow(std::move(first));
  // Levels are whole or left out: more beams may end earlier.
  if (further.size() > 0 && further.beams_.back().reflections >= beams_.back().reflections)
    *this = std::move(further);
}

std::int32_t SunBeams::next(std::int32_t beam, std::size_t group) const {
  const auto& list = beam < 0 ? first_ : beams_[static_cast<std::size_t>(beam)].next;
  for (const auto& [of_group, number] : list)
    if (of_group == group) return number;
  return -1;
}

std::vector<SunBeam> SunBeams::first_level(const IntervalLight& sun,
                                           std::span<const std::uint8_t> dark) {
  std::vector<SunBeam> level;
  const auto is_lit = [&](std::int32_t triangle) {
    return dark.empty() || dark[static_cast<std::size_t>(triangle)] == 0;
  };
  // Of mirrors; clear glass may reflect nothing.
  const auto strongest = [&](std::size_t g) {
    const double cos_theta = dot(sun.direction, (*groups_)[g].normal);
    const auto& triangles = (*groups_)[g].triangles;
    const bool any = std::any_of(triangles.begin(), triangles.end(), is_lit);
    return any && cos_theta > least_cosine ? groups_->strongest(g, cos_theta) : 0;
  };
  std::size_t facing = 0;
  for (std::size_t g = 0; g < groups_->size(); ++g)
    if (strongest(g) > 0 && ++facing > static_cast<std::size_t>(rules_.most_beams)) {
      has_too_many_ = true;
      return level;
    }
  for (std::size_t g = 0; g < groups_->size(); ++g) {
    const Vec3 n = (*groups_)[g].normal;
    const double reflected = strongest(g);
    if (reflected <= 0) continue;
    SunBeam beam{g, -1, 1, followed_by_image({}, n), {}, reflected, {}, {}, {}};
    beam.image = beam.image_of(sun.direction);
    for (const auto t : (*groups_)[g].triangles) {
      if (!is_lit(t)) continue;
      const Mesh& mesh = groups_->scene().mesh;
      const auto i = static_cast<std::size_t>(t);
      beam.section.push_back({mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)});
      beam.triangles.push_back(t);
    }
    level.push_back(std::move(beam));
  }
  return level;
}

std::vector<SunBeam> SunBeams::next_level(std::size_t begin) {
  std::vector<SunBeam> level;
  for (std::size_t b = begin; b < beams_.size(); ++b) {
    const SunBeam& beam = beams_[b];
    BeamSection section({(*groups_)[beam.group].normal, beam.image, spread_, rules_.margin_m},
                        beam.section);
    for (std::size_t g = 0; g < groups_->size(); ++g) {
      const Vec3 n = (*groups_)[g].normal;
      const double cos_theta = dot(beam.image, n);
      if (cos_theta <= least_cosine) continue;
      const double strongest = beam.strongest * groups_->strongest(g, cos_theta);
      if (strongest <= 0) continue;
      if (strongest < rules_.faint_glint) {
        has_fainter_ = true;
        continue;
      }
      auto lit = section.lit(*groups_, g);
      if (lit.empty()) continue;
      level.push_back({g,
                       static_cast<std::int32_t>(b),
                       beam.reflections + 1,
                       followed_by_image(beam.image_of, n),
                       image(beam.image, n),
                       strongest,
                       std::move(lit),
                       {},
                       {}});
      if (beams_.size() + level.size() > static_cast<std::size_t>(rules_.most_beams)) return level;
    }
  }
  return level;
}

void SunBeams::append(std::vector<SunBeam> level) {
  for (auto& beam : level) {
    auto& list = beam.before < 0 ? first_ : beams_[static_cast<std::size_t>(beam.before)].next;
    list.emplace_back(beam.group, static_cast<std::int32_t>(beams_.size()));
    beams_.push_back(std::move(beam));
  }
}

}  // namespace sunload
