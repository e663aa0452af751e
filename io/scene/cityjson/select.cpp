// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/cityjson/select.h"

#include <optional>

#include "io/scene/base/city_types.h"
#include "io/scene/base/words.h"
#include "io/scene/cityjson/geometry.h"

namespace sunload {

namespace {

using nlohmann::json;
using Choices = std::map<std::string, GeometryChoice>;

std::string text_member(const json& object, const char* name) {
  const auto* member = find_member(object, name);
  return member != nullptr && member->is_string() ? member->get<std::string>() : std::string();
}

/// CityJSON 1.0 has numbers, later versions text.
Lod lod_of_geometry(const json& geometry) {
  const auto* lod = find_member(geometry, "lod");
  if (lod == nullptr || !(lod->is_string() || lod->is_number())) return {};
  return lod_of(lod->is_string() ? lod->get<std::string>() : lod->dump());
}

/// Rank of one geometry, or nothing where it has no surfaces that could be read.
std::optional<LodRank> geometry_rank(const json& geometry, const std::string& object,
                                     std::size_t place, const LodWish& wish,
                                     const TemplateOf& template_of, NoteCounter& notes) {
  const bool is_instance = text_member(geometry, "type") == "GeometryInstance";
  const auto& shape = is_instance ? template_of(geometry, object, place) : geometry;
  const auto type = text_member(shape, "type");
  if (!has_surfaces(type)) {
    if (type == "MultiPoint" || type == "MultiLineString")
      notes.count("geometries of points or lines ignored");
    else
      notes.warn("geometries of unknown type '" + shortened(type) + "' ignored", 1);
    return std::nullopt;
  }
  return wish.rank(lod_of_geometry(shape));
}

GeometryChoice choose_of_object(const std::string& id, const json& object, const LodWish& wish,
                                const TemplateOf& template_of, const Where& where,
                                NoteCounter& notes) {
  GeometryChoice choice{&object, text_member(object, "type"), {}, {}};
  if (choice.type.empty()) {
    throw InputError(where, "CityObject '" + id + "' has no type", "every CityObject has one");
  }
  if (is_interior(choice.type)) {
    notes.count("interior objects (" + choice.type + ") left out");
    return choice;
  }
  if (!is_city_object_type(choice.type)) {
    notes.count("objects of unknown type '" + shortened(choice.type) + "' read like any other");
  }
  const auto* list = find_member(object, "geometry");
  if (list == nullptr) return choice;
  if (!list->is_array()) {
    throw InputError(where, "CityObject '" + id + "': geometry is no list");
  }
  std::size_t not_chosen = 0;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto rank = geometry_rank((*list)[i], id, i, wish, template_of, notes);
    if (!rank) continue;
    if (choice.geometries.empty() || *rank > choice.rank) {
      not_chosen += choice.geometries.size();
      choice.geometries.clear();
      choice.rank = *rank;
    }
    if (*rank == choice.rank) {
      choice.geometries.push_back(i);
    } else {
      ++not_chosen;
    }
  }
  if (not_chosen > 0) notes.count("geometries of other levels of detail left out", not_chosen);
  return choice;
}

/// The choices of the objects that a list of ids names.
std::vector<GeometryChoice*> listed(Choices& choices, const json* ids) {
  std::vector<GeometryChoice*> found;
  if (ids == nullptr || !ids->is_array()) return found;
  for (const auto& id : *ids) {
    if (!id.is_string()) continue;
    const auto choice = choices.find(id.get_ref<const std::string&>());
    if (choice != choices.end() && !choice->second.geometries.empty()) {
      found.push_back(&choice->second);
    }
  }
  return found;
}

/// The list in which an object names those that belong to it; null: there is none.
const json* members_of(const GeometryChoice& choice) {
  const auto* members = find_member(*choice.object, "children");
  if (members == nullptr && choice.type == "CityObjectGroup")
    members = find_member(*choice.object, "members");  // CityJSON 1.0
  return members;
}

/// Who belongs to whom, by either's list. A group goes behind every other owner.
void find_owners(Choices& choices) {
  const auto note = [&](GeometryChoice& member, const std::string& owner) {
    const auto found = choices.find(owner);
    if (found == choices.end() || &found->second == &member) return;
    const bool is_better =
        member.owner.empty() || (choices.at(member.owner).type == "CityObjectGroup" &&
                                 found->second.type != "CityObjectGroup");
    if (is_better) member.owner = owner;
  };
  const auto each_id = [](const json* ids, const auto& visit) {
    if (ids == nullptr || !ids->is_array()) return;
    for (const auto& id : *ids)
      if (id.is_string()) visit(id.get_ref<const std::string&>());
  };
  for (auto& [id, choice] : choices) {
    each_id(find_member(*choice.object, "parents"),
            [&, &member = choice](const std::string& owner) { note(member, owner); });
    each_id(members_of(choice), [&, &owner = id](const std::string& member) {
      if (const auto found = choices.find(member); found != choices.end())
        note(found->second, owner);
    });
  }
}

/// A whole and its parts at different levels would lie inside each other.
void unstack_whole_and_parts(Choices& choices, NoteCounter& notes) {
  for (auto& [id, whole] : choices) {
    if (whole.geometries.empty() || whole.type == "CityObjectGroup") continue;
    auto parts = listed(choices, find_member(*whole.object, "children"));
    std::erase_if(parts, [](const auto* part) { return !part->type.ends_with("Part"); });
    if (parts.empty()) continue;
    std::vector<LodRank> ranks;
    ranks.reserve(parts.size());
    for (const auto* part : parts) ranks.push_back(part->rank);
    const auto read = unstacked(whole.rank, ranks, notes);
    if (read == WholeOrParts::parts) whole.geometries.clear();
    if (read == WholeOrParts::whole)
      for (auto* part : parts) part->geometries.clear();
  }
}

/// The geometry of a group is a generalisation of its members.
void unstack_groups(Choices& choices, NoteCounter& notes) {
  for (auto& [id, group] : choices) {
    if (group.geometries.empty() || group.type != "CityObjectGroup") continue;
    if (listed(choices, members_of(group)).empty()) continue;
    notes.count("geometries of groups left out: they repeat their members",
                group.geometries.size());
    group.geometries.clear();
  }
}

}  // namespace

Choices choose_geometries(const json& city_objects, const LodWish& wish,
                          const TemplateOf& template_of, const Where& where, NoteCounter& notes) {
  if (!city_objects.is_object()) throw InputError(where, "CityObjects is no object of ids");
  Choices choices;
  for (const auto& [id, object] : city_objects.items()) {
    choices.emplace(id, choose_of_object(id, object, wish, template_of, where, notes));
  }
  unstack_whole_and_parts(choices, notes);
  unstack_groups(choices, notes);
  find_owners(choices);
  for (const auto& [id, choice] : choices) {
    if (!choice.geometries.empty() && !wish.is_met_by(choice.rank)) {
      notes.count("objects without LoD " + wish.text() + ": the nearest one read");
    }
  }
  return choices;
}

}  // namespace sunload
