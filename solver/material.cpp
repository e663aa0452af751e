#include "solver/material.h"

#include "geo/check.h"

namespace sunload {

namespace {
// Reflectances that were given as decimals may exceed 1 by their rounding.
constexpr double rounding = 1e-12;
}  // namespace

void expect_valid(const Scene& scene) {
  SUNLOAD_EXPECT(scene.material.size() == scene.mesh.triangle_count(), "one material per triangle");
  for (const auto& m : scene.materials) {
    SUNLOAD_EXPECT(m.diffuse >= 0 && m.mirror >= 0 && m.diffuse + m.mirror <= 1 + rounding,
                   "reflectances of " + m.name);
    SUNLOAD_EXPECT(m.emission_w_m2 >= 0, "emission of " + m.name);
  }
  for (const auto id : scene.material)
    SUNLOAD_EXPECT(id.exists() && id.index() < scene.materials.size(), "material of a triangle");
}

}  // namespace sunload
