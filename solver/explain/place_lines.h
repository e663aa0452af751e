// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Casts the lines of one patch or sensor again: the lines of the solution, by the same random
/// numbers, but without points on bright surfaces.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/lines/line_follower.h"
#include "solver/lines/patch_lines.h"
#include "solver/traced/traced_scene.h"

namespace sunload {

/// Patches, or sensors, with their shares of the place's mean load.
struct Place {
  std::vector<std::size_t> receivers;
  std::vector<double> weight;  ///< of each; add up to 1
  bool is_of_sensors = false;
};

/// Whether a number is that of a patch of the mesh or of a sensor of the scene.
enum class Receiver { patch, sensor };

/// A line as far as its first hit.
struct CastLine {
  Vec3 origin, w;  ///< w: unit
  Hit hit;
  RandomKey key;  ///< for the surfaces that it meets
};

/// Casts these lines realization by realization. `traced` must outlive it, and needs no lines of
/// its own.
class PlaceLines {
 public:
  explicit PlaceLines(const TracedScene& traced)
      : traced_(traced), rules_(line_rules(traced.rules)) {}

  std::size_t realizations() const { return static_cast<std::size_t>(rules_.realizations); }
  /// Lines of one realization; all count alike.
  std::size_t count(std::size_t receiver, Receiver kind) const {
    const int all = kind == Receiver::sensor ? rules_.lines_per_patch : rules_.lines_of(receiver);
    return static_cast<std::size_t>(all) / realizations();
  }
  /// `meet(CastLine)` for each line of a realization.
  template <class Meet>
  void cast(std::size_t receiver, Receiver kind, std::size_t realization, Meet&& meet) const {
    if (kind == Receiver::sensor)
      cast_sensor(receiver, realization, meet);
    else
      cast_patch(receiver, realization, meet);
  }

 private:
  RandomKey key_of(std::uint64_t element, std::size_t realization, std::size_t line) const {
    return {.seed = rules_.seed,
            .purpose = Purpose::glossy,
            .realization = static_cast<std::uint32_t>(realization),
            .element = element,
            .sun = static_cast<std::uint32_t>(line)};
  }

  template <class Meet>
  void cast_patch(std::size_t patch, std::size_t r, Meet& meet) const {
    const std::size_t each = count(patch, Receiver::patch);
    const PatchLines lines(*traced_.mesh, patch, traced_.caster.offset_m(),
                           line_seeds(*traced_.mesh, patch, r, rules_.seed));
    for (std::size_t first = 0; first < each; first += packet_size) {
      const LinePacket packet(lines, first, each);
      const auto hits = packet.first_hits(traced_.caster);
      for (std::size_t l = 0; l < packet.count; ++l)
        meet(CastLine{packet.line[l].origin, packet.line[l].w, hits[l],
                      key_of(traced_.mesh->key()[patch], r, first + l)});
    }
  }

  template <class Meet>
  void cast_sensor(std::size_t number, std::size_t r, Meet& meet) const {
    const Sensor& sensor = traced_.scene.sensors[number];
    const Vec3 origin = sensor.position + sensor.normal * traced_.caster.offset_m();
    const Tangents axes = tangents(sensor.normal);
    RandomKey of_all = key_of(sensor.key, r, 0);
    of_all.purpose = Purpose::lines;
    const auto seeds = random_words(of_all);
    const std::size_t each = count(number, Receiver::sensor);
    for (std::size_t l = 0; l < each; ++l) {
      const auto index = static_cast<std::uint32_t>(l);
      const Vec3 local =
          sample_cosine(scrambled_sobol(index, 0, seeds), scrambled_sobol(index, 1, seeds));
      const Vec3 w = axes.tangent * local.x + axes.bitangent * local.y + sensor.normal * local.z;
      meet(CastLine{origin, w, traced_.caster.first_hit(origin, w), key_of(sensor.key, r, l)});
    }
  }

  const TracedScene& traced_;
  LineRules rules_;
};

}  // namespace sunload
