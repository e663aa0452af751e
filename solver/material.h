/// Optical properties of surfaces, and the scene that light is computed in.
#pragma once

#include <string>
#include <vector>

#include "geo/mesh.h"
#include "solver/sensor.h"

namespace sunload {

/// Diffuse, mirror, both together, or an emitter; diffuse + mirror ≤ 1.
struct Material {
  std::string name;
  double diffuse = 0;           ///< reflectance rho
  double mirror = 0;            ///< reflectance rho_s
  double emission_w_m2 = 0;     ///< diffuse exitance M of an emitter
  bool operator==(const Material&) const = default;
};

/// Share of power that an ideal mirror of this material returns at the angle
/// whose cosine is `cos_theta` (of incidence). Constant for plain mirrors.
inline double mirror_reflectance(const Material& material, double /*cos_theta*/) {
  return material.mirror;
}

/// A prepared mesh with one material per triangle.
struct Scene {
  Mesh mesh;
  std::vector<Material> materials;
  std::vector<MaterialId> material;  ///< per triangle, into `materials`
  std::vector<Sensor> sensors = {};  ///< receive light without disturbing the rest
};

/// Shares of a refused or degenerate material are errors of the caller: throws
/// std::logic_error unless sizes agree and every share lies in its range.
void expect_valid(const Scene& scene);

}  // namespace sunload
