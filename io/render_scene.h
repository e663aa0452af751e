/// The patches of a result as a camera sees them: geometry, hits and pixels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/camera.h"
#include "io/colour_map.h"
#include "io/render.h"
#include "io/result_file.h"
#include "solver/ray_caster.h"

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
  /// Vertices of what is not ground (all, where there is nothing else).
  std::vector<Vec3> focus_points() const;
  /// Whether a line parts two triangles: other object or material, fold, or step.
  bool is_border(std::int32_t triangle, std::int32_t other) const;

 private:
  Mesh mesh_;
  std::vector<std::int32_t> front_, back_;  ///< patches of a triangle
  std::vector<std::int32_t> material_, surface_;
  std::vector<double> area_;
  std::vector<Vec3> normal_, centroid_;
};

/// Colours of the picture that are not of the palette.
inline constexpr Colour sky_colour{0.91, 0.94, 0.97};
inline constexpr Colour back_colour{0.72, 0.72, 0.72};

/// Values of the patches and the value of the last colour.
struct PatchColours {
  std::vector<double> values;  ///< per patch; NaN is drawn as a back
  double largest = 1;
  Palette palette = Palette::false_colour;
  MeshLines mesh = MeshLines::none;
  std::vector<Colour> own = {};  ///< per patch, linear light; where given, in place of a palette's
};

/// Rows of pixels, 2 × 2 samples each.
std::vector<Colour> drawn_pixels(const PatchScene& scene, const RayCaster& caster,
                                 const Camera& camera, int width, int height,
                                 const PatchColours& colours);

}  // namespace sunload
