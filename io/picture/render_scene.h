// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The patches of a result as a camera sees them: geometry, hits and pixels.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/base/colour_map.h"
#include "io/picture/camera.h"
#include "io/picture/colour_scale.h"
#include "io/picture/render.h"
#include "io/result/reader.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// What a picture needs to know of the patches.
class PatchScene {
 public:
  explicit PatchScene(const ResultReader& result);

  const Mesh& mesh() const { return mesh_; }  ///< triangle t is patch front_patch(t)
  std::size_t patch_count() const { return normal_.size(); }
  /// Patch met on the front or the back of a triangle; -1 for the back of a one-sided one.
  std::int32_t patch_met(std::int32_t triangle, bool front) const;
  const std::vector<double>& area() const { return area_; }
  /// Corners of a patch; a back has those of its front in another order.
  const std::array<std::int32_t, 3>& corners(std::size_t patch) const { return corners_[patch]; }
  /// Vertices of what a picture is of where nobody says: of objects that rise, without their
  /// ground; where none does of what is not ground; else of all.
  std::vector<Vec3> focus_points() const;
  /// Whether a line parts two triangles: other object or material, fold, or step.
  bool is_border(std::int32_t triangle, std::int32_t other) const;

 private:
  /// What decides lines, side by side in memory: millions of neighbours are compared.
  struct Facet {
    std::int32_t object, material, surface;
    std::array<float, 3> normal, centroid;
  };

  std::vector<Vec3> vertices_of(const std::vector<char>& is_wanted) const;

  Mesh mesh_;
  std::vector<Facet> facets_;               ///< of triangles
  std::vector<std::int32_t> front_, back_;  ///< patches of a triangle
  std::vector<std::int32_t> surface_;
  std::vector<double> area_;
  std::vector<Vec3> normal_;
  std::vector<std::array<std::int32_t, 3>> corners_;  ///< of patches, as stored
};

/// Colours of the picture that are not of the palette.
inline constexpr Colour plain_sky{0.91, 0.94, 0.97};
inline constexpr Colour far_ground{0.50, 0.50, 0.48};  ///< below the horizon of a coloured sky

/// The light that an encoded sRGB colour stands for.
Colour linear_light(Colour colour);

/// Values of the patches and the value of the last colour.
struct PatchColours {
  std::vector<double> values;  ///< per patch; NaN is drawn as a back
  double largest = 1;
  Palette palette = Palette::false_colour;
  MeshLines mesh = MeshLines::none;
  /// Values at the corners of every patch, to be interpolated; empty: constant patches.
  std::vector<std::array<double, 3>> corner_values = {};
  double least = 0;              ///< value of the first colour
  std::vector<Colour> own = {};  ///< per patch, linear light; where given, in place of a palette's
  ColourScale scale = ColourScale::linear;
  std::vector<char> marked = {};  ///< per patch, whether it has `mark_colour` instead; empty: none
};
/// sRGB; of no palette.
inline constexpr Colour mark_colour{0.20, 0.78, 0.58};

/// The sky behind the scene.
struct Background {
  SkyBackground kind = SkyBackground::plain;
  Vec3 sun{0, 0, 1};  ///< unit vector towards the sun
};

/// What rays do that meet the back of a surface that has one side: of closed rooms a camera outside
/// sees nothing else.
enum class Backs { stop, let_pass };

/// What a camera sees of the scene, 2 × 2 rays for each pixel: traced once, coloured for many suns.
class TracedPicture {
 public:
  /// Scene and caster must outlive this. `mesh`: whether patch lines will be wanted.
  TracedPicture(const PatchScene& scene, const RayCaster& caster, const Camera& camera, int width,
                int height, MeshLines mesh, Backs backs = Backs::stop);
  /// Whether any ray met a surface from the side that has values; of these patches alone.
  bool shows_anything() const;
  bool shows(const std::vector<std::size_t>& patches) const;
  /// Rows of pixels.
  std::vector<Colour> pixels(const PatchColours& colours, const Background& background) const;

  /// One ray: the triangle it met, where, from which side, and how much of a patch line.
  struct Sample {
    std::int32_t triangle = -1;
    float u = 0, v = 0;
    float mesh_line = 0;
    bool front = true;
    /// Whether a border (of an object, a material or a fold) is between this and the next sample.
    bool border_right = false, border_below = false;
  };

 private:
  void trace_tiles(std::size_t first_row);
  PacketHits first_hits(const Packet& from, const PacketDirections& directions,
                        std::uint32_t active) const;
  double mesh_line(std::size_t triangle, double u, double v, const CameraRay& ray) const;
  bool has_border(std::size_t sample, std::size_t other) const;
  bool is_border(std::size_t column, std::size_t row) const;

  const PatchScene& scene_;
  const RayCaster& caster_;
  Camera camera_;
  MeshLines mesh_;
  Backs backs_;
  std::size_t width_, height_, columns_, rows_;
  std::vector<Sample> samples_;
};

/// Both steps for one picture with a plain background.
std::vector<Colour> drawn_pixels(const PatchScene& scene, const RayCaster& caster,
                                 const Camera& camera, int width, int height,
                                 const PatchColours& colours);

}  // namespace sunload
