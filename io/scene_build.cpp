#include "io/scene_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "io/scene_builtin.h"
#include "io/scene_file.h"
#include "io/weather_light.h"

namespace sunload {

namespace {

/// Appends `from` to `into`; objects and materials of one name stay one.
void append(PolygonModel& into, const PolygonModel& from) {
  const auto vertex_base = static_cast<std::int32_t>(into.vertices.size());
  const auto ring_base = static_cast<std::int64_t>(into.ring_begin.size()) - 1;
  const auto corner_base = static_cast<std::int64_t>(into.ring_vertex.size());
  const auto object_base = static_cast<std::int32_t>(into.object_names.size());
  const auto material_base = static_cast<std::int32_t>(into.materials.size());
  into.vertices.insert(into.vertices.end(), from.vertices.begin(), from.vertices.end());
  for (const auto v : from.ring_vertex) into.ring_vertex.push_back(v + vertex_base);
  for (std::size_t r = 1; r < from.ring_begin.size(); ++r)
    into.ring_begin.push_back(from.ring_begin[r] + corner_base);
  for (std::size_t p = 1; p < from.polygon_ring.size(); ++p)
    into.polygon_ring.push_back(from.polygon_ring[p] + ring_base);
  for (auto facts : from.facts) {
    facts.object.value += object_base;
    if (facts.material.exists()) facts.material.value += material_base;
    into.facts.push_back(facts);
  }
  std::set<std::string> taken(into.object_names.begin(), into.object_names.end());
  for (auto name : from.object_names) {
    const std::string base = name;
    for (int n = 2; taken.contains(name); ++n) name = base + "_" + std::to_string(n);
    taken.insert(name);
    into.object_names.push_back(name);
  }
  into.object_kinds.insert(into.object_kinds.end(), from.object_kinds.begin(),
                           from.object_kinds.end());
  into.materials.insert(into.materials.end(), from.materials.begin(), from.materials.end());
  into.notes.insert(into.notes.end(), from.notes.begin(), from.notes.end());
  into.is_city_format = into.is_city_format || from.is_city_format;
  if (into.crs.empty()) into.crs = from.crs;
  into.source += (into.source.empty() ? "" : ", ") + from.source;
}

PolygonModel read_models(const SceneStudy& scene) {
  if (scene.builtin) {
    try {
      return builtin_scene({scene.builtin->name, scene.builtin->parameters});
    } catch (const InputError& error) {
      Problems problems;
      for (const auto& problem : error.problems()) problems.add(scene.builtin->where, problem);
      problems.throw_if_any();
      throw;
    }
  }
  PolygonModel model;
  Problems problems;
  for (const auto& file : scene.files) {
    try {
      auto part = read_scene_file(file, {scene.up, scene.unit_m, scene.lod, scene.vrml_colour,
                                                scene.emission_scale_w});
      if (!model.crs.empty() && !part.crs.empty() && model.crs != part.crs)
        problems.add({file}, "coordinates in " + part.crs,
                     "an earlier file of the scene has " + model.crs,
                     "bring all files of a scene into one CRS");
      if (model.source.empty()) model = std::move(part);  // tens of millions of faces are not copied
      else append(model, part);
    } catch (const InputError& error) {
      problems.add(error);
    }
  }
  problems.throw_if_any();
  return model;
}

/// Sensors in the mesh's frame; a warning where they stand far from the scene.
std::vector<Sensor> place_sensors(const SensorsStudy& study, const Mesh& mesh, const Box& bounds,
                                  std::vector<std::string>& warnings) {
  std::vector<Sensor> sensors;
  sensors.reserve(study.points.size());
  const double diagonal = norm(bounds.high - bounds.low);
  std::size_t far = 0, first_far = 0;
  for (const auto& point : study.points) {
    const Vec3 at = point.position - mesh.origin;
    sensors.push_back({at, normalized(point.normal), sensor_key(point.position, point.normal)});
    const double beyond = std::max({bounds.low.x - at.x, at.x - bounds.high.x, bounds.low.y - at.y,
                                    at.y - bounds.high.y, bounds.low.z - at.z, at.z - bounds.high.z});
    if (beyond > diagonal && far++ == 0) first_far = sensors.size() - 1;
  }
  if (far > 0) {
    const Vec3 p = study.points[first_far].position;
    warnings.push_back(message(
        study.where,
        fmt::format("{} of {} sensors stand farther from the scene than it is wide, the first of "
                    "them sensor {} at ({:.10g}, {:.10g}, {:.10g})",
                    far, sensors.size(), first_far, p.x, p.y, p.z),
        "they see little of it",
        "positions are metres in the scene's frame, z up, not relative to its local origin"));
  }
  return sensors;
}

PrepareRules prepare_rules(const Study& study, const PolygonModel& model, const Site& site) {
  PrepareRules rules;
  rules.north_deg = site.north_deg;
  rules.repair = study.scene.repair;
  const auto& ground = study.scene.ground;
  if (ground ? ground->wanted : model.is_city_format)
    rules.ground = GroundPlate{ground ? ground->margin_m : GroundPlate{}.margin_m};
  return rules;
}

Site resolve_site(const Study& study, const PolygonModel& model, std::string& source) {
  const SiteStudy& given = study.site;
  const std::string crs = given.crs.empty() ? model.crs : given.crs;
  Site site;
  if (!crs.empty() && !model.vertices.empty()) {
    const Box box = bounding_box(model.vertices);
    Vec3 middle = (box.low + box.high) / 2;
    middle.z = box.low.z;
    try {
      site = site_from_crs(crs, middle);
      source = "position and north from " + crs;
    } catch (const InputError&) {
      if (!given.latitude_deg) throw;
      source = crs + " could not be used";
    }
  } else if (const auto station = given.latitude_deg ? std::nullopt : weather_place(study)) {
    site.latitude_deg = station->latitude_deg;
    site.longitude_deg = station->longitude_deg;
    site.elevation_m = station->elevation_m;
    source = "position and elevation of the weather station " + station->name;
  } else if (!given.latitude_deg && !std::holds_alternative<PositionsPeriod>(study.period.kind)) {
    throw InputError(given.where, "site has no position",
                     "neither latitude_deg and longitude_deg nor a CRS is known",
                     "write site.latitude_deg and site.longitude_deg, or site.crs");
  }
  if (given.latitude_deg) {
    site.latitude_deg = *given.latitude_deg;
    site.longitude_deg = given.longitude_deg.value_or(0);
    source = crs.empty() ? "position from the study" : "position from the study, north from " + crs;
  }
  if (given.elevation_m) site.elevation_m = *given.elevation_m;
  if (given.north_deg) {
    site.north_deg = *given.north_deg;
    source += "; north_deg from the study";
  }
  site.timezone = given.timezone;
  site.horizon = given.horizon;
  return site;
}

/// Decides the material of every triangle: assign > study material of the
/// file's name > the file's reflectance > default.
class MaterialAssigner {
 public:
  MaterialAssigner(const Study& study, Scene& scene, BuiltScene& built)
      : study_(study), scene_(scene), built_(built), emission_(emission_per_area(study.scene, scene.mesh)) {
    for (const auto& m : study.scene.materials) by_name_[m.name] = m;
    for (const auto& m : scene.mesh.file_materials)
      if (!m.name.empty() && !by_name_.contains(m.name))
        of_files_.insert({m.name, of_file(m)});
    for (const auto& rule : study.scene.assign) expect_known(rule.material, rule.where);
    if (study.scene.ground && !study.scene.ground->material.empty())
      expect_known(study.scene.ground->material, study.scene.where);
    problems_.throw_if_any();
  }

  void run() {
    const Mesh& mesh = scene_.mesh;
    std::vector<bool> rule_used(study_.scene.assign.size(), false);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      scene_.material.push_back(id_of(material_of(t, rule_used), t));
    problems_.throw_if_any();
    for (std::size_t r = 0; r < rule_used.size(); ++r)
      if (!rule_used[r])
        built_.warnings.push_back(
            message(study_.scene.assign[r].where,
                    "this assignment of '" + study_.scene.assign[r].material + "' matches nothing",
                    "no surface gets its material from it"));
    if (defaulted_m2_ > 0)
      built_.warnings.push_back(fmt::format(
          "{:.0f} m2 have no material in file or study; diffuse reflectance {} is taken for them",
          defaulted_m2_, default_reflectance));
  }

 private:
  static MaterialStudy of_file(const FileMaterial& file) {
    MaterialStudy study;
    study.name = file.name;
    study.diffuse = file.diffuse;
    study.mirror = file.mirror;
    return study;
  }

  static std::vector<double> emission_per_area(const SceneStudy& study, const Mesh& mesh) {
    std::vector<double> area(mesh.file_materials.size(), 0), emission(area);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (mesh.triangle_material[t].exists() && mesh.triangle_surface[t] != Surface::floor &&
          mesh.file_materials[mesh.triangle_material[t].index()].emitted_power_w > 0) {
        // The two patches of a two-sided triangle emit both.
        const auto m = mesh.triangle_material[t].index();
        Sides sides = mesh.triangle_sides[t];
        for (const auto& named : study.materials)
          if (named.name == mesh.file_materials[m].name) sides = named.sides.value_or(sides);
        area[m] += (sides == Sides::two ? 2 : 1) * norm(mesh.area_vector2(t)) / 2;
      }
    for (std::size_t m = 0; m < area.size(); ++m)
      if (area[m] > 0) emission[m] = mesh.file_materials[m].emitted_power_w / area[m];
    return emission;
  }

  void expect_known(const std::string& name, const Where& where) {
    if (by_name_.contains(name) || of_files_.contains(name)) return;
    problems_.add(where, "material '" + name + "' is not known",
                  "neither scene.materials nor the scene files define it",
                  "define it under scene.materials");
  }

  const MaterialStudy& named(const std::string& name) const {
    const auto of_study = by_name_.find(name);
    return of_study != by_name_.end() ? of_study->second : of_files_.at(name);
  }

  Material material_of(std::size_t t, std::vector<bool>& rule_used) {
    const Mesh& mesh = scene_.mesh;
    const auto file_id = mesh.triangle_material[t];
    const FileMaterial* file = file_id.exists() ? &mesh.file_materials[file_id.index()] : nullptr;
    const MaterialStudy* chosen = nullptr;
    const auto& object = mesh.object_names[mesh.triangle_object[t].index()];
    const auto& kind = mesh.object_kinds[mesh.triangle_object[t].index()];
    const std::string surface = surface_names[static_cast<std::size_t>(mesh.triangle_surface[t])];
    for (std::size_t r = 0; r < study_.scene.assign.size(); ++r) {
      const auto& rule = study_.scene.assign[r];
      if (!matches(rule.object, object) || !matches(rule.surface, surface) ||
          !matches(rule.kind, kind) || !matches(rule.material_was, file ? file->name : ""))
        continue;
      rule_used[r] = true;
      chosen = &named(rule.material);
    }
    const auto& ground = study_.scene.ground;
    if (!chosen && ground && !ground->material.empty() && file && file->name == "ground")
      chosen = &named(ground->material);
    if (!chosen && file && by_name_.contains(file->name)) chosen = &by_name_.at(file->name);
    if (chosen) return from_study(*chosen, file_id, t);
    return from_file(file, file_id, t);
  }

  Material from_study(const MaterialStudy& study, MaterialId file_id, std::size_t t) {
    if (study.sides) scene_.mesh.triangle_sides[t] = *study.sides;
    const FileMaterial* file =
        file_id.exists() && scene_.mesh.file_materials[file_id.index()].name == study.name
            ? &scene_.mesh.file_materials[file_id.index()]
            : nullptr;
    Material m;
    m.name = study.name;
    m.diffuse = study.diffuse.value_or(file ? file->diffuse.value_or(0) : 0);
    m.emission_w_m2 = study.emission_w_m2;
    // A reflectance of the study's does not put out the file's lamps.
    if (m.emission_w_m2 == 0 && file) m.emission_w_m2 = emission_[file_id.index()];
    if (study.refractive_index) {  // decides about the mirror, too
      m.refractive_index = *study.refractive_index;
      m.extinction_coefficient = study.extinction_coefficient.value_or(0);
      m.thickness_m = study.thickness_m;
      m.absorption_per_m = study.absorption_per_m;
      m.panes = study.panes;
      return m;
    }
    m.mirror = study.mirror.value_or(file ? file->mirror.value_or(0) : 0);
    m.glossy = study.glossy;
    m.glossy_exponent = study.glossy_exponent;
    m.transmittance = study.transmittance;
    return m;
  }

  Material from_file(const FileMaterial* file, MaterialId id, std::size_t t) {
    Material m;
    m.name = file && !file->name.empty() ? file->name : "default";
    if (file && (file->diffuse || file->mirror)) {
      m.diffuse = file->diffuse.value_or(0);
      m.mirror = file->mirror.value_or(0);
    } else {
      m.diffuse = default_reflectance;
      if (scene_.mesh.triangle_surface[t] != Surface::floor)
        defaulted_m2_ += norm(scene_.mesh.area_vector2(t)) / 2;
    }
    if (id.exists()) m.emission_w_m2 = emission_[id.index()];
    return m;
  }

  static std::string other_shares(const Material& m) {
    std::string text;
    if (m.glossy > 0) text += fmt::format(" + glossy {}", m.glossy);
    if (m.transmittance > 0) text += fmt::format(" + transmittance {}", m.transmittance);
    return text;
  }

  MaterialId id_of(const Material& m, std::size_t t) {
    const auto known = ids_.find(m.name);
    if (known != ids_.end() && scene_.materials[known->second.index()] == m) return known->second;
    const double sum = m.diffuse + m.mirror + m.glossy + m.transmittance;
    if (sum > 1 + 1e-9 && refused_.insert(m.name).second)
      problems_.add({},
                    fmt::format("material '{}': diffuse {} + mirror {}{} exceeds 1", m.name,
                                m.diffuse, m.mirror, other_shares(m)),
                    "more light would leave than arrives (triangle " + std::to_string(t) + ")",
                    "override it in scene.materials");
    const auto same = std::find(scene_.materials.begin(), scene_.materials.end(), m);
    const auto id = make_id<MaterialId>(static_cast<std::size_t>(same - scene_.materials.begin()));
    if (same == scene_.materials.end()) scene_.materials.push_back(m);
    ids_[m.name] = id;
    return id;
  }

  const Study& study_;
  Scene& scene_;
  BuiltScene& built_;
  std::vector<double> emission_;
  std::map<std::string, MaterialStudy> by_name_;   ///< of the study
  std::map<std::string, MaterialStudy> of_files_;  ///< named by scene files only
  std::map<std::string, MaterialId> ids_;
  std::set<std::string> refused_;
  Problems problems_;
  double defaulted_m2_ = 0;
};

/// Parallel emitters: of the file's materials only what they emit is read.
ParallelSources read_parallel_sources(const Study& study, Vec3 origin, BuiltScene& built) {
  const SceneStudy& scene = study.scene;
  if (scene.parallel_sources.empty()) return {};
  const PolygonModel model =
      read_scene_file(scene.parallel_sources, {scene.up, scene.unit_m, scene.lod,
                                               scene.vrml_colour, scene.emission_scale_w});
  const Mesh mesh = prepare(model, {.repair = scene.repair, .ground = {}, .north_deg = 0}).mesh;
  std::vector<double> area(mesh.file_materials.size(), 0);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.triangle_material[t].exists())
      area[mesh.triangle_material[t].index()] += norm(mesh.area_vector2(t)) / 2;
  const auto exitance = [&](MaterialId id) {
    if (!id.exists()) return 0.0;
    const FileMaterial& file = mesh.file_materials[id.index()];
    const auto named = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const MaterialStudy& m) { return m.name == file.name; });
    return named != scene.materials.end() ? named->emission_w_m2
                                          : file.emitted_power_w / area[id.index()];
  };
  ParallelSources sources;
  for (const Vec3 p : mesh.vertices) sources.mesh.vertices.push_back(p + mesh.origin - origin);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double M = exitance(mesh.triangle_material[t]);
    if (M <= 0) continue;
    sources.mesh.triangles.push_back(mesh.triangles[t]);
    sources.exitance.push_back(M);
  }
  if (sources.exitance.empty())
    throw InputError(scene.parallel_sources_where,
                     "scene.parallel_sources: nothing in " + scene.parallel_sources + " emits",
                     "no material of it has an emission",
                     "write scene.materials: {NAME: {emission_w_m2: …}} for a material of that file");
  if (const std::size_t dark = mesh.triangle_count() - sources.exitance.size(); dark > 0)
    built.notes.push_back(fmt::format("{}: {} triangles that emit nothing are left out",
                                      scene.parallel_sources, dark));
  return sources;
}

}  // namespace

bool matches(const std::string& pattern, const std::string& text) {
  if (pattern.empty()) return true;
  // Greedy matching with one backtracking point: the last `*` seen.
  std::size_t p = 0, t = 0, star = std::string::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t]) && pattern[p] != '*') {
      ++p;
      ++t;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (star != std::string::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

BuiltScene build_scene(const Study& study) {
  BuiltScene built;
  const PolygonModel model = read_models(study.scene);
  built.notes = model.notes;
  built.site = resolve_site(study, model, built.site_source);
  built.crs = study.site.crs.empty() ? model.crs : study.site.crs;
  PreparedMesh prepared = prepare(model, prepare_rules(study, model, built.site));
  built.report = std::move(prepared.report);
  built.warnings = built.report.warnings;
  built.scene.mesh = std::move(prepared.mesh);
  MaterialAssigner(study, built.scene, built).run();
  built.scene.parallel_sources = read_parallel_sources(study, built.scene.mesh.origin, built);
  built.scene.sensors = place_sensors(study.sensors, built.scene.mesh, built.report.bounds,
                                      built.warnings);
  return built;
}

}  // namespace sunload
