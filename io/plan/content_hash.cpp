// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Structured bindings name every member of what is hashed: a new member does not compile until it
// is put in or left out on purpose.
#include "io/plan/content_hash.h"

#include <map>

#include "io/base/hash.h"
#include "io/plan/part_totals.h"
#include "io/plan/stored_bits.h"
#include "io/study/words.h"

namespace sunload {

template <>
inline constexpr bool is_plain<Vec3> = sizeof(Vec3) == 3 * sizeof(double);
template <>
inline constexpr bool is_plain<BandShares> = sizeof(BandShares) == band_count * sizeof(double);

namespace {

void add_mesh(Digest& digest, const Mesh& mesh) {
  // What files say of materials, kinds and families of objects, have become materials of the scene
  // by now.
  const auto& [vertices, triangles, triangle_object, triangle_material, triangle_facade,
               triangle_surface, triangle_sides, triangle_covered, object_names, object_kinds,
               families, file_materials, facades, origin] = mesh;
  digest.add(origin);
  digest.add(vertices);
  digest.add(triangles);
  digest.add(triangle_object);
  digest.add(triangle_facade);
  // Numbers of surfaces and sides mean what their lists say, in that order.
  for (const char* name : surface_names) digest.add(std::string(name));
  static_assert(static_cast<int>(Sides::one) == 0 && static_cast<int>(Sides::two) == 1);
  digest.add(triangle_surface);
  digest.add(triangle_sides);
  digest.add(triangle_covered);
  digest.add(object_names);
  digest.add(facades.size());
  for (const Facade& facade : facades) {
    const auto& [name, object, area_m2, azimuth_deg] = facade;  // the rest follows from triangles
    digest.add(name);
  }
}

/// What selections and measures choose by. They may be asked for when all is computed: what they
/// look at must be known to have stayed, whether there are any or not.
void add_kinds_and_families(Digest& digest, const Mesh& mesh) {
  digest.add(mesh.object_kinds);
  const auto& [of_object, bare] = mesh.families;
  const auto add_owner = [&](const Owner& owner) {
    const auto& [object, bare_object] = owner;
    digest.add(object);
    digest.add(bare_object);
  };
  digest.add(of_object.size());
  for (const Owner& owner : of_object) add_owner(owner);
  digest.add(bare.size());
  for (const auto& [name, kind, owner] : bare) {
    digest.add(name);
    digest.add(kind);
    add_owner(owner);
  }
}

// Every kind begins with its word.
void add_smooth(Digest& digest, const ConstantShares& /*all are equal*/) {
  digest.add(std::string("constant"));
}
void add_smooth(Digest& digest, const Panes& panes) {
  const auto& [refractive_index, thickness_m, absorption_per_m, count] = panes;
  digest.add(std::string("panes"));
  digest.add(refractive_index);
  digest.add(thickness_m);
  digest.add(absorption_per_m);
  digest.add(count);
}
void add_smooth(Digest& digest, const ClearGlass& glass) {
  const auto& [normal_transmittance] = glass;
  digest.add(std::string("clear glass"));
  digest.add(normal_transmittance);
}
void add_smooth(Digest& digest, const Metal& metal) {
  const auto& [refractive_index, extinction_coefficient] = metal;
  digest.add(std::string("metal"));
  digest.add(refractive_index);
  digest.add(extinction_coefficient);
}

void add_material(Digest& digest, const Material& material) {
  const auto& [name, diffuse, mirror, emission_w_m2, smooth, glossy, glossy_exponent, transmittance,
               diffuse_in_band] = material;
  digest.add(name);
  for (const double property :
       {diffuse, mirror, emission_w_m2, glossy, glossy_exponent, transmittance})
    digest.add(property);
  std::visit([&](const auto& kind) { add_smooth(digest, kind); }, smooth);
  digest.add(diffuse_in_band.has_value());
  if (diffuse_in_band) digest.add(*diffuse_in_band);
}

void add_sensor(Digest& digest, const Sensor& sensor) {
  const auto& [position, normal, key, stands_at] = sensor;
  std::ignore = position;  // from where it stands, and the mesh
  digest.add(stands_at);
  digest.add(normal);
  digest.add(key);
}

/// Nothing where there are none: hashes of other studies stay.
void add_luminaires(Digest& digest, const Luminaires& luminaires) {
  const auto& [webs, all] = luminaires;
  if (all.empty()) return;
  for (const auto& [planes_deg, gammas_deg, intensities] : webs)
    for (const auto* values : {&planes_deg, &gammas_deg, &intensities}) digest.add(*values);
  for (const auto& [position, axis, plane_0, plane_90, web, scale, key] : all) {
    for (const Vec3& v : {position, axis, plane_0, plane_90}) digest.add(v);
    digest.add(web);
    digest.add(scale);
    digest.add(key);
  }
}

void add_scene(Digest& digest, const Scene& scene) {
  const auto& [mesh, materials, material, parallel_sources, luminaires, sensors] = scene;
  add_mesh(digest, mesh);
  digest.add(materials.size());
  for (const Material& each : materials) add_material(digest, each);
  digest.add(material);
  const auto& [sources, exitance] = parallel_sources;
  digest.add(sources.vertices);  // the rest of their mesh is empty
  digest.add(sources.triangles);
  digest.add(exitance);
  add_luminaires(digest, luminaires);
  digest.add(sensors.size());
  for (const Sensor& each : sensors) add_sensor(digest, each);
}

void add_site(Digest& digest, const Site& site) {
  // Times are hashed as instants; the horizon is part of the study's text.
  const auto& [latitude_deg, longitude_deg, elevation_m, north_deg, timezone, horizon] = site;
  for (const double value : {latitude_deg, longitude_deg, elevation_m, north_deg})
    digest.add(value);
}

std::string times_text(const LightSeries& light) {
  Digest digest;
  for (const auto& i : light.intervals) {
    digest.add(i.when.begin);
    digest.add(i.when.end);
    digest.add(i.when.sun_time);
  }
  return digest.hex();
}

/// Nothing where materials stay what they are: the hash is as it was.
void add_seasons(Digest& digest, const SceneSeasons& seasons) {
  const auto& [all, of_interval] = seasons;
  for (const auto& [name, materials, material] : all) {
    digest.add(materials.size());
    for (const Material& each : materials) add_material(digest, each);
    digest.add(material);
  }
  if (!of_interval.empty()) digest.add(of_interval);
}

/// Nothing where there are none, as most studies of one day have it: their hashes stay.
void add_totals(Digest& digest, const std::vector<PartTotals>& totals) {
  for (const auto& [division, with_errors] : totals) {
    digest.add(std::string(part_kind_names[static_cast<std::size_t>(division.kind)]));
    digest.add(with_errors);
    for (const auto& [label, bounds, duration_s, intervals] : division.parts) {
      digest.add(label);
      for (const auto& [interval, share] : intervals) {
        digest.add(interval);
        digest.add(share);
      }
    }
  }
}

/// Triangle by triangle what surfaces look like. Materials that look alike count as one, in the
/// order in which they come.
template <class LookOf>
void add_looks(Digest& digest, const Scene& scene, const LookOf& look_of) {
  std::map<std::string, std::uint32_t> number_of;
  std::vector<std::uint32_t> number(scene.materials.size()), of_triangle;
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    number[m] = number_of.try_emplace(look_of(scene.materials[m]), static_cast<std::uint32_t>(m))
                    .first->second;
  std::map<std::uint32_t, std::uint32_t> order;
  for (const MaterialId id : scene.material)
    of_triangle.push_back(
        order.try_emplace(number[id.index()], static_cast<std::uint32_t>(order.size()))
            .first->second);
  std::vector<std::string> looks(order.size());
  for (const auto& [look, first] : number_of)
    if (const auto place = order.find(first); place != order.end()) looks[place->second] = look;
  digest.add(looks);
  digest.add(of_triangle);
}

/// As rays take it. Whether a surface reflects diffusely at all decides whether lines lead to it.
std::string look_to_rays(const Material& material) {
  Material seen = material;
  seen.name.clear();
  if (!sends_on(material) && !is_fresnel(material)) seen.diffuse = material.diffuse > 0 ? 1 : 0;
  if (!sends_on(material)) seen.diffuse_in_band.reset();
  Digest digest;
  add_material(digest, seen);
  return digest.hex();
}

}  // namespace

std::string content_hash(const Study& study, const BuiltScene& built, const LightSeries& light,
                         const std::string& isa, const std::string& mesh_pilots,
                         const SceneSeasons& seasons) {
  Digest digest;
  digest.add(numerics_version);
  digest.add(canonical_text(study));
  digest.add(study.output.standard_error == StandardErrors::instants);
  // What rounds nothing leaves the hash as it was.
  if (const int bits = stored_bits(study); bits < float_mantissa_bits) {
    digest.add(std::string("significant bits"));
    digest.add(bits);
  }
  if (!study.output.series_step.is_interval()) {
    digest.add(std::string("series step"));
    digest.add(word_of(study.output.series_step));
  }
  digest.add(isa);
  digest.add(times_text(light));
  digest.add(light.weather_sha256);
  add_site(digest, built.site);
  add_scene(digest, built.scene);
  add_kinds_and_families(digest, built.scene.mesh);
  add_seasons(digest, seasons);
  add_totals(digest, part_totals(study, light, built.site.latitude_deg));
  if (!mesh_pilots.empty()) digest.add(mesh_pilots);
  return digest.hex();
}

std::string geometry_digest(const Mesh& mesh) {
  Digest digest;
  add_mesh(digest, mesh);
  return digest.hex();
}

std::string pilot_digest(const Scene& scene, const PeriodLight& light) {
  Digest digest;
  add_looks(digest, scene, [](const Material& material) {
    Digest seen;
    // The share that meets no glass of a coated pane lowers its mirror.
    seen.add(is_fresnel(material) ? material.diffuse : 0.0);
    for (const double property : {material.mirror, material.emission_w_m2, material.transmittance})
      seen.add(property);
    std::visit([&](const auto& kind) { add_smooth(seen, kind); }, material.smooth);
    return seen.hex();
  });
  add_luminaires(digest, scene.luminaires);
  const auto& [suns, samples, sky, ground, lamp_time_s] = light;
  for (const auto* list : {&suns, &samples[0], &samples[1]}) {
    digest.add(list->size());
    for (const auto& [direction, exposure] : *list) {
      digest.add(direction);
      digest.add(exposure);
    }
  }
  digest.add(sky);
  digest.add(ground);
  digest.add(lamp_time_s);
  return digest.hex();
}

std::string rays_digest(const Study& study, const BuiltScene& built, const LightSeries& light,
                        const std::string& isa, const std::string& mesh_pilots) {
  Study of_rays = study;
  of_rays.scene = {};  // as built
  Digest digest;
  digest.add(canonical_text(of_rays));
  digest.add(study.output.standard_error == StandardErrors::instants);
  digest.add(isa);
  digest.add(times_text(light));
  digest.add(light.weather_sha256);
  add_site(digest, built.site);
  add_mesh(digest, built.scene.mesh);
  add_looks(digest, built.scene, look_to_rays);
  digest.add(built.scene.sensors.size());
  for (const Sensor& each : built.scene.sensors) add_sensor(digest, each);
  add_totals(digest, part_totals(study, light, built.site.latitude_deg));
  digest.add(mesh_pilots);
  return digest.hex();
}

/// Its bytes stay what they were: by them results pair with those of earlier versions.
std::string pairing_id(const Study& study, const LightSeries& light) {
  constexpr std::size_t letters = 16;
  const auto& s = study.solver;
  Digest digest;
  digest.add(times_text(light));
  digest.add(s.seed);
  for (const int n : {s.realizations, s.lines_per_patch, s.direct_samples}) digest.add(n);
  digest.add(s.transport);
  return digest.hex().substr(0, letters);
}

}  // namespace sunload
