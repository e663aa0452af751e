// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Uniformly distributed lines: traced once, they carry the light of every sun
/// position and of every Jacobi iteration.
///
/// A line leaves patch i at a uniform point in a cosine-distributed direction,
/// hence first meets patch j with probability F_ij (Sbert 1997; Bekaert 1999). What is
/// kept of a line are its links: where it takes radiosity from, and with which
/// weight. Along a chain of mirrors a line takes ρ_s-weighted radiosity from
/// every surface it meets; where it leaves the scene it sees a cell of the sky
/// or the far ground. Irradiance is then linear in what lies at the links' ends:
///
///     E_i = Σ_links w B_target + Σ_sky links w π L_cell + w_ground B_ground
///
/// with B the light that was reflected; that of emitters is constant in time and summed up once and
/// for all. Bright surfaces, which may be rare along lines, get links from points drawn on them
/// too (solver/lines/bright_view.h).
#pragma once

#include <cstdint>
#include <vector>

#include "geo/sky/sky.h"
#include "solver/base/watch.h"
#include "solver/light/fate.h"
#include "solver/lines/bright_view.h"
#include "solver/lines/link_table.h"
#include "solver/mesh/hierarchy.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// What a patch's lines end in, as shares of its lines.
struct LineEnds {
  float sky = 0;               ///< straight to the sky: the sky view factor
  float ground = 0;            ///< straight to the far ground
  float ground_by_mirror = 0;  ///< to the far ground after mirrors
  Fate<float> fate;  ///< straight or by mirrors; absorbed: where that depends on the angle
};

/// Fate of first light (sky, ground) after it was mirrored by the patch that it
/// met first: power per π·radiance of its source [m2], per sky cell, then of the far ground;
/// empty without mirrors. Absorbed: where that depends on the angle.
using MirroredFates = std::vector<Fate<double>>;

/// The lines of one realization, or of all of them pooled.
struct LineSet {
  LinkTable patches, sky, sky_by_mirror;
  std::vector<LineEnds> ends;
  /// Irradiance by emitters, straight or by mirrors [W m-2]; empty: none.
  std::vector<double> lamps;
  MirroredFates mirrored_fates;
  /// `patches` stands for all reflections at once, and not for one (solver/matrix).
  bool all_reflections = false;
};

/// Where a line met a glossy surface: any sun may be asked from there
/// (solver/first_light/glossy_sun.h).
struct Glimpse {
  std::uint32_t receiver = 0;  ///< patch or sensor that the line left
  std::uint32_t realization = 0;
  std::int32_t triangle = -1;    ///< of the glossy surface
  std::int32_t front = 1;        ///< 1: its front was met
  float at[3] = {};              ///< off the surface [m]
  float axis[3] = {};            ///< of the lobe: the line, mirrored
  float weight = 0;              ///< of the line so far, times rho_g
  std::int32_t reflections = 0;  ///< of the line before it
};

/// Room for the lines of so many patches or sensors to elements and cells of the sky, and for what
/// emitters send them.
LineSet empty_line_set(std::size_t rows, std::size_t elements, std::size_t cells, bool any_lamps);

/// How many lines are traced, how far each is followed, and to which elements links lead.
struct LineRules {
  int lines_per_patch = 256;  ///< over all realizations together
  /// Of each patch, if they differ; multiples of `realizations`.
  std::vector<int> lines_of_patch = {};
  int realizations = 8;
  int mirror_depth = 8;
  std::uint64_t seed = 1;
  /// A patch of `lines_per_patch` lines links to the largest element of the tree whose form factor
  /// cannot exceed this; a patch of more lines links to smaller ones, in inverse proportion.
  double largest_link = 0;

  int lines_of(std::size_t patch) const {
    return lines_of_patch.empty() ? lines_per_patch : lines_of_patch[patch];
  }
  double largest_link_of(std::size_t patch) const {
    return largest_link * lines_per_patch / lines_of(patch);
  }
};

/// All that tracing gives: links of each realization, and of all of them pooled.
struct Lines {
  std::vector<LineSet> realizations;
  LineSet pooled;
  std::vector<Glimpse> glimpses;  ///< by receiver
  std::uint64_t rays = 0;         ///< cast, chains included
};

/// Share of the hemisphere of each row's receiver that is sky, weighted by the cosine.
std::vector<double> sky_view_factors(const LineSet& lines);
/// The standard error of that by all lines, from the realizations.
std::vector<double> sky_view_errors(const Lines& lines);

/// Traces all lines. Cost: a ray for each line of every patch, and as many shadow rays where there
/// are bright surfaces. Throws Interrupted.
Lines trace_lines(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                  const SkyGrid& grid, const Guide& guide, const LineRules& rules, Watch& watch);

}  // namespace sunload
