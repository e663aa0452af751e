/// Uniformly distributed lines: traced once, they carry the light of every sun
/// position and of every Jacobi iteration.
///
/// A line leaves patch i at a uniform point in a cosine-distributed direction,
/// hence first meets patch j with probability F_ij (Bekaert 1999, 4.2). What is
/// kept of a line are its links: where it takes radiosity from, and with which
/// weight. Along a chain of mirrors a line takes ρ_s-weighted radiosity from
/// every surface it meets; where it leaves the scene it sees a cell of the sky
/// or the far ground. Irradiance is then linear in what lies at the links' ends:
///
///     E_i = Σ_links w B_target + Σ_sky links w π L_cell + w_ground B_ground
#pragma once

#include <cstdint>
#include <vector>

#include "geo/sky.h"
#include "solver/hierarchy.h"
#include "solver/ray_caster.h"
#include "solver/watch.h"

namespace sunload {

/// Weighted links of patches to targets (elements of the mesh, cells of the sky), compressed rows in blocks.
class LinkTable {
 public:
  static constexpr std::size_t rows_per_block = 1024;
  struct Block {
    std::vector<std::uint32_t> begin{0};  ///< rows + 1
    std::vector<std::uint32_t> target;
    std::vector<float> weight;
  };
  struct Link {
    std::uint32_t target;
    float weight;
  };
  explicit LinkTable(std::size_t rows = 0);
  std::vector<Block> blocks;
  std::size_t link_count() const;
  std::size_t memory_bytes() const;
  /// Appends the next row of a block: sorted by target, equal targets merged.
  static void append_row(Block& block, std::vector<Link>& links, float scale);
};

/// What a patch's lines end in, as shares of its lines.
struct LineEnds {
  float sky = 0;               ///< straight to the sky: the sky view factor
  float ground = 0;            ///< straight to the far ground
  float ground_by_mirror = 0;  ///< to the far ground after mirrors
  float escaped = 0;           ///< left the scene, straight or by mirrors
  float backs = 0;             ///< met the back of a one-sided surface
  float cut = 0;               ///< chain cut at the mirror depth
};

/// Fate of first light (sky, ground) after it was mirrored by the patch that it
/// met first: power per π·radiance of its source [m2].
struct MirroredFirstLight {
  std::vector<double> escaped, backs, cut;  ///< per sky cell, then the far ground
};

/// The lines of one realization, or of all of them pooled.
struct LineSet {
  LinkTable patches, sky, sky_by_mirror;
  std::vector<LineEnds> ends;
  MirroredFirstLight first_light;
};

/// Room for the lines of so many patches or sensors.
LineSet empty_line_set(std::size_t rows);

struct LineRules {
  int lines_per_patch = 256;  ///< over all realizations together
  int realizations = 8;
  int mirror_depth = 8;
  std::uint64_t seed = 1;
  /// Links lead to the largest element of the tree whose form factor cannot exceed this.
  double largest_link = 0;
};

struct Lines {
  std::vector<LineSet> realizations;
  LineSet pooled;
  std::uint64_t rays = 0;  ///< cast, chains included
};

/// Traces all lines. Cost: patches × lines_per_patch rays. Throws Interrupted.
Lines trace_lines(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                  const SkyGrid& grid, const LineRules& rules, Watch& watch);

}  // namespace sunload
