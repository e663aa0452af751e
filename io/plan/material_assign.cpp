// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/material_assign.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "io/base/key_names.h"
#include "io/base/name_pattern.h"
#include "io/study/material_table.h"
#include "solver/surface/clear_glass.h"

namespace sunload {

namespace {

constexpr double rounding = 1e-9;  // of sums of shares

/// Whether a study's material leaves reflection to what the file or the table says of its name.
bool says_nothing(const MaterialStudy& m) {
  return !m.diffuse && !m.diffuse_of_weather && !m.mirror &&
         std::holds_alternative<ConstantShares>(m.smooth) && m.glossy == 0 && m.transmittance == 0;
}

bool says_nothing(const FileMaterial& m) { return !m.diffuse && !m.mirror; }

/// Whether a rule names objects, selections or materials of files, not just kinds of them.
bool is_specific(const AssignRule& rule) {
  const auto chooses = [](const std::string& pattern) {
    return pattern.find_first_not_of('*') != std::string::npos;
  };
  return chooses(rule.object) || chooses(rule.material_was) || rule.selection;
}

std::string in_words(const AssignRule& rule) {
  std::string words;
  for (const auto& [key, pattern] : {std::pair{"object", &rule.object},
                                     {"surface", &rule.surface},
                                     {"was", &rule.material_was},
                                     {"type", &rule.kind}})
    if (!pattern->empty())
      words += fmt::format("{}{} {}", words.empty() ? "" : ", ", key, *pattern);
  if (rule.selection)
    words += fmt::format("{}selection {}", words.empty() ? "" : ", ", rule.selection->name);
  return (words.empty() ? "all" : words) + ": " + rule.material;
}

/// Materials of what is added.
std::vector<std::string> materials_in(const EditAction& action) {
  if (const auto* trees = std::get_if<AddTreesEdit>(&action))
    return {trees->shape.leaves, trees->shape.trunk};
  if (const auto* points = std::get_if<AddTreePointsEdit>(&action))
    return {points->leaves, points->trunk};
  if (const auto* prism = std::get_if<AddPrismEdit>(&action)) return {prism->material};
  if (const auto* added = std::get_if<AddFileEdit>(&action)) return {added->file.material};
  if (const auto* other = std::get_if<ReplaceEdit>(&action)) return {other->file.material};
  return {};
}

/// The first file or step of the study that gives this material to its faces.
Where where_named(const SceneStudy& study, const std::string& material) {
  for (const SceneFileStudy& file : study.files)
    if (file.material == material) return file.where;
  for (const EditStep& step : study.edit)
    for (const std::string& name : materials_in(step.action))
      if (name == material) return step.where;
  return study.where;
}

class MaterialAssigner {
 public:
  MaterialAssigner(const Study& study, const SceneFrame& frame, Scene& scene,
                   std::vector<std::string>& warnings, const MaterialsWhen& when)
      : study_(study),
        when_(when),
        scene_(scene),
        warnings_(warnings),
        emission_(emission_per_area(study.scene, scene.mesh)),
        made_of_file_(scene.mesh.file_materials.size() + 1, nullptr),
        defaulted_of_file_m2_(scene.mesh.file_materials.size(), 0) {
    for (const auto& m : scene.mesh.file_materials)
      if (!m.name.empty() && !m.is_reference) of_files_.insert({m.name, of_file(m)});
    for (const auto& m : study.scene.materials) by_name_[m.name] = completed(m);
    for (const auto& rule : study.scene.assign) {
      expect_known(rule.material, rule.where);
      selected_.push_back(rule.selection ? selected_faces(*rule.selection, scene.mesh, frame)
                                         : ChosenParts());
      named_.push_back(objects_named(rule.object, scene.mesh));
    }
    if (study.scene.ground && !study.scene.ground->material.empty())
      expect_known(study.scene.ground->material, study.scene.where, "scene.ground: ");
    std::set<std::string> references;  // each tree has its own
    for (const auto& m : scene.mesh.file_materials)
      if (m.is_reference && references.insert(m.name).second)
        expect_known(m.name, where_named(study.scene, m.name));
    for (const auto& m : study.scene.materials)
      for (const auto& in : m.seasons) expect_known(in.material, in.where);
    problems_.throw_if_any();
  }

  std::vector<RuleUse> run() {
    const Mesh& mesh = scene_.mesh;
    for (const auto& rule : study_.scene.assign) used_.push_back({.rule = in_words(rule)});
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) scene_.material.push_back(given_to(t));
    problems_.throw_if_any();
    for (std::size_t r = 0; r < used_.size(); ++r) warn_of_rule(study_.scene.assign[r], used_[r]);
    warn_of_defaults();
    warn_of_tabled_names();
    warn_of_scaled();
    warn_of_dark_lamps();
    return std::move(used_);
  }

 private:
  static MaterialStudy of_file(const FileMaterial& file) {
    MaterialStudy study;
    study.name = file.name;
    study.diffuse = file.diffuse;
    study.diffuse_rgb = file.diffuse_rgb;
    study.mirror = file.mirror;
    return study;
  }

  static std::vector<double> emission_per_area(const SceneStudy& study, const Mesh& mesh) {
    std::vector<double> area(mesh.file_materials.size(), 0), emission(area);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (mesh.triangle_material[t].exists() && mesh.bears_patches(t) &&
          mesh.file_materials[mesh.triangle_material[t].index()].emitted_power_w > 0) {
        // The two patches of a two-sided triangle emit both.
        const auto m = mesh.triangle_material[t].index();
        Sides sides = mesh.triangle_sides[t];
        for (const auto& named : study.materials)
          if (named.name == mesh.file_materials[m].name) sides = named.sides.value_or(sides);
        area[m] += (sides == Sides::two ? 2 : 1) * mesh.area_m2(t);
      }
    for (std::size_t m = 0; m < area.size(); ++m)
      if (area[m] > 0) emission[m] = mesh.file_materials[m].emitted_power_w / area[m];
    return emission;
  }

  /// What a material of the study leaves to the table: all of its reflection, where neither it nor
  /// a file's material of its name says anything of it.
  MaterialStudy completed(const MaterialStudy& m) const {
    const auto of_table = tabled_material(m.name);
    const auto of_file = of_files_.find(m.name);
    const bool file_knows = of_file != of_files_.end() && !says_nothing(of_file->second);
    if (!says_nothing(m) || file_knows || !of_table) return m;
    MaterialStudy all = *of_table;
    all.where = m.where;
    all.emission_w_m2 = m.emission_w_m2;
    all.emission_lm_m2 = m.emission_lm_m2;
    if (m.sides) all.sides = m.sides;
    all.seasons = m.seasons;
    return all;
  }

  /// Makes sure that the name stands for something, from the table if need be.
  void expect_known(const std::string& name, const Where& where, const std::string& key = {}) {
    if (by_name_.contains(name)) return;
    const auto of_file = of_files_.find(name);
    if (of_file != of_files_.end() && !says_nothing(of_file->second)) return;
    if (const auto of_table = tabled_material(name)) {
      of_table_[name] = *of_table;
      return;
    }
    if (of_file != of_files_.end()) return;
    std::vector<std::string> known = tabled_names();
    for (const auto& [other, m] : by_name_) known.push_back(other);
    for (const auto& [other, m] : of_files_) known.push_back(other);
    const std::string hint = key_hint(name, known);
    problems_.add(
        where, key + "material '" + name + "' is not known",
        "neither scene.materials nor the scene files define it, and the table has no such row",
        hint.starts_with("did you mean")
            ? hint
            : "define it under scene.materials, or take one that `sunload materials` lists");
  }

  const MaterialStudy& named(const std::string& name) const {
    for (const auto* source : {&by_name_, &of_table_})
      if (const auto found = source->find(name); found != source->end()) return found->second;
    return of_files_.at(name);
  }

  /// Numbers of the last rules that match: that name something, and that go by kinds.
  struct LastRules {
    std::optional<std::size_t> specific, by_kind;
  };
  LastRules rules_for(std::size_t t) {
    LastRules last;
    for (std::size_t r = 0; r < study_.scene.assign.size(); ++r) {
      const auto& rule = study_.scene.assign[r];
      if ((rule.selection && selected_[r][t] == 0) ||
          !matches_but_selection(rule, named_[r], scene_.mesh, t))
        continue;
      ++used_[r].matched;
      (is_specific(rule) ? last.specific : last.by_kind) = r;
    }
    return last;
  }

  const MaterialStudy& given_by(std::size_t rule, std::size_t t) {
    ++used_[rule].given;
    used_[rule].given_m2 += scene_.mesh.area_m2(t);
    return named(study_.scene.assign[rule].material);
  }

  /// What a material is in the seasons that are in force: by the last of them that it knows.
  const MaterialStudy* in_season(const MaterialStudy* source) const {
    if (source == nullptr || source->seasons.empty()) return source;
    const MaterialStudy* now = source;
    for (const std::string& season : when_.seasons)
      for (const SeasonMaterial& in : source->seasons)
        if (in.season == season) now = &named(in.material);
    return now;
  }

  /// Of the study or the table what a triangle is made of; null: as its file says.
  const MaterialStudy* source_of(std::size_t t) {
    const Mesh& mesh = scene_.mesh;
    const auto file_id = mesh.triangle_material[t];
    const FileMaterial* file = file_id.exists() ? &mesh.file_materials[file_id.index()] : nullptr;
    const LastRules rules = rules_for(t);
    if (rules.specific) return &given_by(*rules.specific, t);
    if (file && file->is_reference) return &named(file->name);
    if (rules.by_kind) return &given_by(*rules.by_kind, t);
    const auto& ground = study_.scene.ground;
    if (ground && !ground->material.empty() && file && file->name == "ground")
      return &named(ground->material);
    const std::string& name = file && !file->name.empty() ? file->name : nameless_material;
    return by_name_.contains(name) ? &named(name) : nullptr;
  }

  struct Made {
    MaterialId id;
    std::optional<Sides> sides;
    bool is_default = false;  ///< nobody says what it reflects
  };

  /// Made once of what the study and the file say; what depends on the triangle is done for each.
  MaterialId given_to(std::size_t t) {
    const Made& made = made_for(t);
    if (made.sides) scene_.mesh.triangle_sides[t] = *made.sides;
    if (made.is_default) add_default(t);
    return made.id;
  }

  const Made& made_for(std::size_t t) {
    const MaterialId file_id = scene_.mesh.triangle_material[t];
    const Made*& without_rules = made_of_file_[file_id.exists() ? file_id.index() + 1 : 0];
    if (without_rules != nullptr) return *without_rules;
    const MaterialStudy* written = source_of(t);
    const MaterialStudy* source = in_season(written);
    const auto [place, is_new] = made_.try_emplace({written, file_id.value});
    Made& made = place->second;
    if (is_new) {
      if (source && written) made.sides = source->sides ? source->sides : written->sides;
      made.id = id_of(source ? from_study(*source, file_id, made.is_default)
                             : from_file(file_id, made.is_default),
                      t);
    }
    if (study_.scene.assign.empty()) without_rules = &made;
    return made;
  }

  void warn_of_rule(const AssignRule& rule, const RuleUse& use) {
    const bool chooses = is_specific(rule) || !rule.surface.empty() || !rule.kind.empty();
    std::string what, consequence;
    if (use.matched == 0) {
      what = "matches nothing";
      consequence = "no surface gets its material from it";
    } else if (use.given == 0) {
      if (rule.may_be_overruled) return;
      what = "gives nothing";
      consequence =
          "all that it matches has its material from later rules, or from those that name "
          "objects or files";
    } else if (chooses && use.matched == scene_.mesh.triangle_count()) {
      what = "matches everything";
      consequence = "what it chooses by, all surfaces have";
    } else {
      return;
    }
    warnings_.push_back(
        message(rule.where, "this assignment of '" + rule.material + "' " + what, consequence));
  }

  Material from_study(const MaterialStudy& study, MaterialId file_id, bool& is_default) const {
    const FileMaterial* file =
        file_id.exists() && scene_.mesh.file_materials[file_id.index()].name == study.name
            ? &scene_.mesh.file_materials[file_id.index()]
            : nullptr;
    Material m;
    m.name = study.name;
    m.diffuse = study.diffuse_of_weather
                    ? when_.albedo.value_or(default_reflectance)
                    : study.diffuse.value_or(file ? file->diffuse.value_or(0) : 0);
    // Nobody says what it reflects; lamps without reflectance are black.
    m.emission_w_m2 = emission_of(study, study_.light.quantity);
    if (says_nothing(study) && m.emission_w_m2 == 0 && !(file && !says_nothing(*file))) {
      m.diffuse = default_reflectance;
      is_default = true;
    }
    // A reflectance of the study's does not put out the file's lamps.
    if (m.emission_w_m2 == 0 && file) m.emission_w_m2 = emission_[file_id.index()];
    m.smooth = study.smooth;
    if (is_fresnel(m)) return m;  // decides about the mirror, too
    m.mirror = study.mirror.value_or(file ? file->mirror.value_or(0) : 0);
    if (is_pane_or_metal(m)) return m;
    m.glossy = study.glossy;
    m.glossy_exponent = study.glossy_exponent;
    m.transmittance = study.transmittance;
    if (study.diffuse_of_weather) return m;
    set_colour(m, study.diffuse ? study.diffuse_rgb : file ? file->diffuse_rgb : std::nullopt);
    return m;
  }

  Material from_file(MaterialId id, bool& is_default) {
    const FileMaterial* file = id.exists() ? &scene_.mesh.file_materials[id.index()] : nullptr;
    Material m;
    m.name = file && !file->name.empty() ? file->name : nameless_material;
    if (file && (file->diffuse || file->mirror)) {
      m.diffuse = file->diffuse.value_or(0);
      m.mirror = file->mirror.value_or(0);
      set_colour(m, file->diffuse_rgb);
      if (study_.scene.vrml_excess == VrmlExcess::scale && file->may_be_scaled) scale(m, *file);
    } else {
      m.diffuse = default_reflectance;
      is_default = true;
    }
    if (id.exists()) m.emission_w_m2 = emission_[id.index()];
    return m;
  }

  /// What leaves at most: of the brightest band.
  static double largest_sum(const Material& m) {
    const double diffuse = m.diffuse_in_band ? std::ranges::max(*m.diffuse_in_band) : m.diffuse;
    return diffuse + m.mirror;
  }

  /// Colours that add up to more than 1, with the ratio of diffuse, mirror and bands kept.
  void scale(Material& m, const FileMaterial& file) {
    const double sum = largest_sum(m);
    if (sum <= 1 + rounding) return;
    m.diffuse /= sum;
    m.mirror /= sum;
    if (m.diffuse_in_band)
      for (double& share : *m.diffuse_in_band) share /= sum;
    scaled_[fmt::format("'{}' of {}", m.name, file.source)] = 1 / sum;
  }

  void warn_of_scaled() {
    if (scaled_.empty()) return;
    std::string list;
    for (const auto& [material, factor] : scaled_)
      list += fmt::format("{}{} × {:.3g}", list.empty() ? "" : ", ", material, factor);
    warnings_.push_back(fmt::format(
        "{} materials whose diffuse and specular colours add up to more than 1 are scaled "
        "(scene.vrml_excess): {}",
        scaled_.size(), list));
  }

  /// Gloss, whose shares depend on the angle, stands on grey.
  void set_colour(Material& m, const std::optional<BandShares>& rgb) const {
    if (study_.solver.bands == Bands::rgb && m.glossy == 0) m.diffuse_in_band = rgb;
  }

  void add_default(std::size_t t) {
    const Mesh& mesh = scene_.mesh;
    if (!mesh.bears_patches(t)) return;
    defaulted_m2_[static_cast<std::size_t>(mesh.triangle_surface[t])] += mesh.area_m2(t);
    if (const auto id = mesh.triangle_material[t]; id.exists())
      defaulted_of_file_m2_[id.index()] += mesh.area_m2(t);
  }

  /// Files that keep names alone, as `sunload scene` writes crowns.
  void warn_of_tabled_names() {
    std::map<std::string, double> area_m2;
    for (std::size_t m = 0; m < defaulted_of_file_m2_.size(); ++m)
      if (defaulted_of_file_m2_[m] > 0)
        if (const auto& name = scene_.mesh.file_materials[m].name; tabled_material(name))
          area_m2[name] += defaulted_of_file_m2_[m];
    if (area_m2.empty()) return;
    std::string list, rows;
    bool any_transmits = false;
    for (const auto& [name, area] : area_m2) {
      list += fmt::format("{}{} {:.4g} m2", list.empty() ? "" : ", ", name, area);
      rows += fmt::format("{}{}: {{}}", rows.empty() ? "" : ", ", name);
      any_transmits |= tabled_material(name)->transmittance > 0;
    }
    warnings_.push_back(
        message({}, "files name materials of the table without a value (" + list + ")",
                fmt::format("they reflect {} as what nobody defines{}", default_reflectance,
                            any_transmits ? ", and no light passes" : ""),
                "scene.materials: {" + rows + "} takes the table's"));
  }

  /// Of what is no patch the reflectance is never asked for.
  void warn_of_defaults() {
    double defaulted = 0, all = 0;
    std::string kinds;
    for (std::size_t s = 0; s < surface_names.size(); ++s) {
      if (defaulted_m2_[s] == 0) continue;
      defaulted += defaulted_m2_[s];
      kinds += fmt::format("{}{} {:.0f} m2", kinds.empty() ? "" : ", ", surface_names[s],
                           defaulted_m2_[s]);
    }
    if (defaulted == 0) return;
    for (std::size_t t = 0; t < scene_.mesh.triangle_count(); ++t)
      if (scene_.mesh.bears_patches(t)) all += scene_.mesh.area_m2(t);
    warnings_.push_back(fmt::format(
        "{:.0f} m2, {:.3g} % of the surface, have no material in file or study ({}); diffuse "
        "reflectance {} is taken for them; scene.assign and scene.ground give materials, `sunload "
        "materials` lists names",
        defaulted, 100 * defaulted / all, kinds, default_reflectance));
  }

  /// Materials that glow by their file, and nobody says how much: colours of VRML alone have a
  /// power (docs/developer/method.md, The historic system).
  void warn_of_dark_lamps() {
    const Mesh& mesh = scene_.mesh;
    std::map<std::string, double> dark_m2;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const auto id = mesh.triangle_material[t];
      if (id.exists() && mesh.file_materials[id.index()].glows &&
          !by_name_.contains(mesh.file_materials[id.index()].name) &&
          scene_.material_of(t).emission_w_m2 == 0)
        dark_m2[mesh.file_materials[id.index()].name] += mesh.area_m2(t);
    }
    for (const auto& [name, area] : dark_m2)
      warnings_.push_back(fmt::format(
          "material '{}' glows by its file, which tells no power: its {:.4g} m2 emit nothing; "
          "write scene.materials: {{{}: {{emission_w_m2: …}}}}, 0 if that is meant",
          name, area, name));
  }

  static std::string other_shares(const Material& m) {
    std::string text;
    if (m.glossy > 0) text += fmt::format(" + glossy {}", m.glossy);
    if (m.transmittance > 0) text += fmt::format(" + transmittance {}", m.transmittance);
    if (const double T0 = normal_transmittance(m); T0 > 0)
      text += fmt::format(" + {} normal_transmittance {}", clear_glass_factor, T0);
    return text;
  }

  MaterialId id_of(const Material& m, std::size_t t) {
    const double diffuse = m.diffuse_in_band ? std::ranges::max(*m.diffuse_in_band) : m.diffuse;
    const double sum =
        largest_sum(m) + m.glossy + m.transmittance + clear_glass_factor * normal_transmittance(m);
    const auto file_id = scene_.mesh.triangle_material[t];
    const FileMaterial* file =
        file_id.exists() ? &scene_.mesh.file_materials[file_id.index()] : nullptr;
    // Of one name in several files, each is refused.
    const std::string source = file ? file->source : std::string();
    if (sum > 1 + rounding && refused_.emplace(source, m.name).second)
      problems_.add({source},
                    fmt::format("material '{}': diffuse {} + mirror {}{} exceeds 1", m.name,
                                diffuse, m.mirror, other_shares(m)),
                    "more light would leave than arrives (triangle " + std::to_string(t) + ")",
                    normal_transmittance(m) > 0
                        ? "diffuse and mirror under scene.materials go before those of the file"
                    : file && file->may_be_scaled
                        ? "override it in scene.materials, or write scene.vrml_excess: scale"
                        : "override it in scene.materials");
    const auto known = ids_.find(m.name);
    if (known != ids_.end() && scene_.materials[known->second.index()] == m) return known->second;
    const auto same = std::find(scene_.materials.begin(), scene_.materials.end(), m);
    const auto id = make_id<MaterialId>(static_cast<std::size_t>(same - scene_.materials.begin()));
    if (same == scene_.materials.end()) scene_.materials.push_back(m);
    ids_[m.name] = id;
    return id;
  }

  const Study& study_;
  const MaterialsWhen& when_;
  Scene& scene_;
  std::vector<std::string>& warnings_;
  std::vector<double> emission_;
  std::map<std::string, MaterialStudy> by_name_;   ///< of the study
  std::map<std::string, MaterialStudy> of_files_;  ///< of the scene files
  std::map<std::string, MaterialStudy> of_table_;  ///< rows that the study names
  std::map<std::string, MaterialId> ids_;
  std::map<std::pair<const MaterialStudy*, std::int32_t>, Made> made_;  ///< by source and file's
  std::vector<const Made*> made_of_file_;  ///< from 1 on, 0: of no file; null: rules decide
  std::set<std::pair<std::string, std::string>> refused_;  ///< file, material
  std::map<std::string, double> scaled_;                   ///< material and file, factor
  std::vector<RuleUse> used_;
  std::vector<ChosenObjects> named_;   ///< by every rule, themselves or what they belong to
  std::vector<ChosenParts> selected_;  ///< faces of every rule's selection; empty: it has none
  Problems problems_;
  std::array<double, surface_names.size()> defaulted_m2_{};
  std::vector<double> defaulted_of_file_m2_;  ///< the same by materials of files
};

}  // namespace

bool matches_but_selection(const AssignRule& rule, const ChosenObjects& named, const Mesh& mesh,
                           std::size_t triangle) {
  const std::size_t object = mesh.triangle_object[triangle].index();
  const MaterialId of_file = mesh.triangle_material[triangle];
  return named[object] != 0 &&
         matches(rule.surface,
                 surface_names[static_cast<std::size_t>(mesh.triangle_surface[triangle])]) &&
         matches(rule.kind, mesh.object_kinds[object]) &&
         matches(rule.material_was,
                 of_file.exists() ? mesh.file_materials[of_file.index()].name : "");
}

std::vector<RuleUse> assign_materials(const Study& study, const SceneFrame& frame, Scene& scene,
                                      std::vector<std::string>& warnings,
                                      const MaterialsWhen& when) {
  return MaterialAssigner(study, frame, scene, warnings, when).run();
}

}  // namespace sunload
