// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The light of few sources (nodes), solved once; the light of every interval is made up of it.
///
/// Every interval has its own rays of the sun. All other light is linear in the sources: the sky,
/// the far ground, the lamps, and the sun as a source of reflected light. With skies and suns as
/// nodes (solver/year) the light of interval k is
///
///     E_k = E_direct + E_mirror + Σ_m c_km E_m(sky) + g_k E(ground) + E(lamps)
///           + DNI_k Σ_j w_kj E_j(reflected sun)
///
/// and its ledger is made up alike. Interpolated reflection is scaled so that the power of the
/// first diffuse reflection is the one that the interval's own rays bring. Each term is what
/// gathering on the pooled lines gives for that source.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "solver/base/chunks.h"
#include "solver/gather/time_sums.h"
#include "solver/transport/light_transport.h"
#include "solver/year/sky_nodes.h"
#include "solver/year/sun_nodes.h"

namespace sunload {

/// The weight of each source of a NodeBlock in the light of each interval of a block,
/// [source][interval].
struct NodeWeights {
  alignas(64) std::array<float, block_width * block_width> of{};
  bool any = false;
  void add(std::size_t source, std::size_t interval, double weight);
};

/// The number of nodes, rounded up to whole blocks: a block that is not full costs the same.
constexpr std::size_t in_whole_blocks(std::size_t nodes) {
  return chunk_count(nodes, block_width) * block_width;
}

/// Seconds that each source of a block shines, all intervals together.
using NodeSeconds = std::array<double, block_width>;

/// Nodes of one band, solved as they are taken, and what they make up.
class NodeLight {
 public:
  /// Ranks the period's skies and suns but for `left_out` (ascending); lamps and far ground are
  /// solved at once. `period` must have the light of the band alone. `traced` and `period` must
  /// outlive it.
  NodeLight(const TracedScene& traced, std::size_t band, const LitPeriod& period,
            const std::vector<std::size_t>& left_out, WorkDone& work);
  /// The same with nodes that are solved already, of an equal scene and period.
  NodeLight(const TracedScene& traced, std::size_t band, const LitPeriod& period,
            const std::vector<std::size_t>& left_out, SolvedNodes ready);

  /// Solves nodes until there are so many skies and suns, rounded up to whole blocks; never fewer
  /// than before. Cost: gathering one block of suns for 16 of them. `advance` is called with the
  /// share of these nodes that is done.
  void take(std::size_t skies, std::size_t suns, WorkDone& work,
            const std::function<void(double)>& advance);
  const SkyNodes& skies() const { return skies_; }
  const SunNodes& suns() const { return suns_; }
  const SolvedNodes& solved() const { return solved_; }
  /// Keeps what was measured with the nodes that are taken.
  void set_reduction(const Reduction& reduction) { solved_.reduction = reduction; }

  /// Lamps, ground, skies, suns.
  std::vector<const NodeBlock*> blocks() const;
  /// One for each of `blocks`. `by_rays`: ledger_of_rays of these suns.
  std::vector<NodeWeights> weights(std::span<const IntervalLight> suns,
                                   const std::vector<Ledger>& by_rays) const;

  /// All light of a block on patches or sensors, whichever `of_receivers` names: what the
  /// intervals' own `rays` bring, whose columns are used up, and what the nodes make up. Where the
  /// latter falls below 0, in corners that are nearly dark, it is 0.
  BlockLight light(const Receivers& receivers, NodeBlock::Received NodeBlock::*of_receivers,
                   const std::vector<NodeWeights>& weights, RayLight& rays) const;
  /// Adds the samples of the sky about the sun in realization r, [N][block].
  void add_circumsolar(const std::vector<NodeWeights>& weights, std::size_t r,
                       Columns& light) const;
  /// Puts the circumsolar sky, as the nodes have it, into `sums` and takes it from the sky of the
  /// lines.
  void split_circumsolar(const std::vector<NodeSeconds>& seconds, TimeSums& sums) const;
  /// Ledger of an interval of the block but for first light of the sun's rays [W].
  Ledger ledger(const std::vector<NodeWeights>& weights, std::size_t interval) const;

 private:
  enum class Keep { all, reflected };
  const PatchOptics& optics() const { return traced_.optics_of_band[band_]; }
  NodeBlock solve(std::span<const IntervalLight> sources, Keep keep, WorkDone& work) const;
  NodeBlock::Received packed(BlockLight light, const PackedColumns& of_lamps, std::size_t sources,
                             Keep keep) const;
  NodeBlock solve_skies(std::size_t first, std::size_t count, WorkDone& work) const;
  NodeBlock solve_suns(std::size_t first, std::size_t count, WorkDone& work) const;
  std::size_t first_sky() const { return 2; }  ///< among `blocks`
  std::size_t first_sun() const { return first_sky() + solved_.skies.size(); }

  const TracedScene& traced_;
  std::size_t band_;
  const LitPeriod& period_;
  SkyNodes skies_;
  SunNodes suns_;
  SolvedNodes solved_;
};

/// What the first light of the sun's rays brings to the ledger, for each sun of a block [W].
std::vector<Ledger> ledger_of_rays(const TracedScene& traced, const PatchOptics& optics,
                                   const Columns& direct, const Columns& mirror, std::size_t suns);

}  // namespace sunload
