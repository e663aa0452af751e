// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/explain/importance.h"

#include <algorithm>
#include <numeric>

#include "geo/base/check.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

using Links = std::vector<LinkTable::Link>;

/// Rows that one thread casts at a time; also a list of links.
constexpr std::size_t rows_at_a_time = 256;
/// What is left of g counts as nothing: lines know it to some thousandths.
constexpr double least_left = 1e-6;
constexpr int most_reflections = 1000;

/// F of one realization, row by row.
struct Exchange {
  struct Rows {
    std::vector<std::uint32_t> ends;  ///< of each row, in `links`
    Links links;
  };
  std::vector<Rows> chunks;

  /// out += Fᵀ x
  void add_transposed(const std::vector<double>& x, std::vector<double>& out) const {
    std::size_t row = 0;
    for (const Rows& rows : chunks) {
      std::size_t k = 0;
      for (const std::uint32_t end : rows.ends) {
        const double of_row = x[row++];
        if (of_row == 0) {
          k = end;
          continue;
        }
        for (; k < end; ++k)
          out[rows.links[k].target] += of_row * static_cast<double>(rows.links[k].weight);
      }
    }
  }
};

class Exchanges {
 public:
  explicit Exchanges(const TracedScene& traced)
      : traced_(traced),
        lines_(traced),
        follower_(traced.scene, *traced.mesh, traced.caster, traced.grid,
                  traced.rules.mirror_depth) {}

  std::size_t realizations() const { return lines_.realizations(); }

  Exchange of_patches(std::size_t realization) const {
    const std::size_t n = traced_.mesh->patch_count();
    Exchange exchange;
    exchange.chunks.resize((n + rows_at_a_time - 1) / rows_at_a_time);
    parallel_chunks(n, rows_at_a_time, [&](std::size_t begin, std::size_t end) {
      Exchange::Rows& rows = exchange.chunks[begin / rows_at_a_time];
      for (std::size_t i = begin; i < end; ++i) {
        add_row(i, Receiver::patch, realization, rows.links);
        rows.ends.push_back(static_cast<std::uint32_t>(rows.links.size()));
      }
      rows.links.shrink_to_fit();
    });
    return exchange;
  }

  /// Of a sensor.
  Links of_sensor(std::size_t sensor, std::size_t realization) const {
    Links links;
    add_row(sensor, Receiver::sensor, realization, links);
    return links;
  }

 private:
  void add_row(std::size_t receiver, Receiver kind, std::size_t realization, Links& links) const {
    LineCollector met;
    met.links_all = true;  // what reflects nothing yet may be painted
    lines_.cast(receiver, kind, realization, [&](const CastLine& line) {
      if (line.hit.left_scene()) return;
      follower_.follow(line.origin, line.w, line.hit, line.key, met);
    });
    const auto share = static_cast<float>(1 / static_cast<double>(lines_.count(receiver, kind)));
    for (const auto& [patch, weight] : met.patches) links.push_back({patch, weight * share});
  }

  const TracedScene& traced_;
  PlaceLines lines_;
  LineFollower follower_;
};

/// Fᵀ w
std::vector<double> seen_straight(const Exchanges& exchanges, const Exchange& of_patches,
                                  const Place& place, std::size_t realization,
                                  std::size_t patches) {
  std::vector<double> seen(patches, 0);
  if (!place.is_of_sensors) {
    std::vector<double> w(patches, 0);
    for (std::size_t k = 0; k < place.receivers.size(); ++k)
      w[place.receivers[k]] += place.weight[k];
    of_patches.add_transposed(w, seen);
    return seen;
  }
  for (std::size_t k = 0; k < place.receivers.size(); ++k)
    for (const auto& link : exchanges.of_sensor(place.receivers[k], realization))
      seen[link.target] += place.weight[k] * static_cast<double>(link.weight);
  return seen;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// g = straight + Fᵀ ρ g
std::vector<double> followed_back(const Exchange& exchange, const std::vector<double>& straight,
                                  const std::vector<float>& reflectance) {
  std::vector<double> g = straight, step = straight, sent(straight.size());
  for (int b = 0; b < most_reflections && sum_of(step) > least_left * sum_of(g); ++b) {
    for (std::size_t j = 0; j < g.size(); ++j)
      sent[j] = static_cast<double>(reflectance[j]) * step[j];
    std::fill(step.begin(), step.end(), 0.0);
    exchange.add_transposed(sent, step);
    for (std::size_t j = 0; j < g.size(); ++j) g[j] += step[j];
  }
  return g;
}

}  // namespace

std::vector<Importance> importance(const TracedScene& traced, const Place& place,
                                   const std::vector<std::vector<float>>& reflectances) {
  const std::size_t n = traced.mesh->patch_count();
  for (const auto& of_band : reflectances)
    SUNLOAD_EXPECT(of_band.size() == n, "a reflectance of every patch");
  const Exchanges exchanges(traced);
  std::vector<Importance> of_bands(reflectances.size());
  for (std::size_t r = 0; r < exchanges.realizations(); ++r) {
    const Exchange exchange = exchanges.of_patches(r);
    const auto straight = seen_straight(exchanges, exchange, place, r, n);
    for (std::size_t b = 0; b < reflectances.size(); ++b)
      of_bands[b].push_back(followed_back(exchange, straight, reflectances[b]));
  }
  return of_bands;
}

}  // namespace sunload
