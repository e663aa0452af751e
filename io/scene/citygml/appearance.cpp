// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/citygml/appearance.h"

#include <array>
#include <optional>
#include <set>
#include <sstream>

#include "io/scene/base/words.h"

namespace sunload {

namespace {

/// The theme of the appearance that a material stands in.
std::string theme_of(XmlElement material) {
  return material.parent().parent().child("theme").text();
}

bool is_of_backs(XmlElement material) {
  const auto front = material.child("isFront").text();
  return front == "false" || front == "0";
}

std::optional<std::array<double, 3>> colour_of(XmlElement material) {
  std::istringstream words(material.child("diffuseColor").text());
  std::array<double, 3> colour{};
  for (double& share : colour) {
    std::string word;
    words >> word;
    const auto number = finite_number(word);
    if (!number) return std::nullopt;
    share = *number;
  }
  return colour;
}

std::string name_of(XmlElement material, std::size_t number) {
  if (auto name = material.child("name").text(); !name.empty()) return name;
  const auto id = material.attribute("id");
  return id.empty() ? "material_" + std::to_string(number) : std::string(id);
}

}  // namespace

CityAppearance::CityAppearance(const CityDocument& document, PolygonModel& model,
                               NoteCounter& notes) {
  std::set<std::string> themes;
  for (const auto material : document.materials()) {
    if (is_of_backs(material)) {
      notes.count("materials of backs not taken");
      continue;
    }
    const auto theme = theme_of(material);
    const auto id = add_material(material, model, notes);
    themes.insert(theme);
    for (const auto target : material.children()) {
      if (target.name() != "target") continue;
      const auto href = target.attribute("href");
      std::string of = href.empty() ? target.text() : std::string(href);
      if (of.starts_with('#')) of.erase(0, 1);
      const auto [entry, is_new] = of_id_.try_emplace(of, Themed{theme, id});
      if (!is_new && theme < entry->second.theme) entry->second = {theme, id};
    }
  }
  if (!themes.empty() && !themes.begin()->empty())
    notes.say("material theme '" + shortened(*themes.begin()) + "' taken");
  if (themes.size() > 1)
    notes.count("further material themes, taken where the first has no material",
                themes.size() - 1);
}

MaterialId CityAppearance::of(XmlElement element, MaterialId otherwise) const {
  if (of_id_.empty()) return otherwise;
  const auto id = element.attribute("id");
  if (id.empty()) return otherwise;
  const auto found = of_id_.find(std::string(id));
  return found == of_id_.end() ? otherwise : found->second.material;
}

MaterialId CityAppearance::add_material(XmlElement material, PolygonModel& model,
                                        NoteCounter& notes) {
  FileMaterial result;
  result.name = name_of(material, model.materials.size());
  if (const auto colour = colour_of(material); colour && !result.set_diffuse(*colour))
    notes.count("colours outside [0, 1] ignored");
  // Buildings repeat the materials that they share.
  auto key = result.name + '\n' + std::to_string(result.diffuse.value_or(-1));
  for (const double share : result.diffuse_rgb.value_or(std::array<double, 3>{}))
    key += ' ' + std::to_string(share);
  const auto [entry, is_new] = ids_.try_emplace(key, make_id<MaterialId>(model.materials.size()));
  if (is_new) model.materials.push_back(std::move(result));
  if (finite_number(trimmed(material.child("transparency").text())).value_or(0) > 0)
    transparent_.add(entry->second);
  return entry->second;
}

}  // namespace sunload
