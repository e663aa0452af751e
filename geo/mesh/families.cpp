// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/families.h"

#include <algorithm>

namespace sunload {

namespace {

const std::string& no_kind() {
  static const std::string none;
  return none;
}

}  // namespace

FamilyTree::FamilyTree(const std::vector<std::string>& names, const std::vector<std::string>& kinds,
                       const Families& families)
    : names_(names),
      kinds_(kinds),
      families_(families),
      owner_(names.size() + families.bare.size()),
      is_added_(owner_.size(), 0) {
  const auto place_of = [&](const Owner& owner) -> std::optional<std::size_t> {
    if (owner.object.exists()) return owner.object.index();
    if (owner.bare.exists()) return names.size() + owner.bare.index();
    return std::nullopt;
  };
  const std::size_t owned = std::min(names.size(), families.of_object.size());
  for (std::size_t o = 0; o < owned; ++o) owner_[o] = place_of(families.of_object[o]);
  for (std::size_t b = 0; b < families.bare.size(); ++b)
    owner_[names.size() + b] = place_of(families.bare[b].owner);
  owners_first_.reserve(owner_.size());
  for (std::size_t place = 0; place < owner_.size(); ++place) add_behind_owners(place);
}

void FamilyTree::add_behind_owners(std::size_t place) {
  constexpr char on_the_way = 1, done = 2;
  std::vector<std::size_t> way;
  for (std::optional<std::size_t> next = place; next && is_added_[*next] != done;
       next = owner_[*next]) {
    if (is_added_[*next] == on_the_way) {
      owner_[way.back()].reset();
      break;
    }
    is_added_[*next] = on_the_way;
    way.push_back(*next);
  }
  for (auto next = way.rbegin(); next != way.rend(); ++next) {
    is_added_[*next] = done;
    owners_first_.push_back(*next);
  }
}

const std::string& FamilyTree::name(std::size_t place) const {
  return place < names_.size() ? names_[place] : families_.bare[place - names_.size()].name;
}

const std::string& FamilyTree::kind(std::size_t place) const {
  if (place >= names_.size()) return families_.bare[place - names_.size()].kind;
  return place < kinds_.size() ? kinds_[place] : no_kind();
}

std::vector<char> with_surfaces(const FamilyTree& tree) {
  std::vector<char> have(tree.size(), 0);
  std::fill_n(have.begin(), tree.object_count(), 1);
  const auto& order = tree.owners_first();
  for (auto place = order.rbegin(); place != order.rend(); ++place)
    if (const auto owner = tree.owner(*place); owner && have[*place] != 0) have[*owner] = 1;
  return have;
}

std::vector<std::string> names_with_surfaces(const FamilyTree& tree) {
  const auto have = with_surfaces(tree);
  std::vector<std::string> names;
  for (std::size_t place = 0; place < tree.size(); ++place)
    if (have[place] != 0) names.push_back(tree.name(place));
  return names;
}

bool is_part_of_body(const std::string& kind) { return kind.ends_with("Part"); }

bool holds_others_apart(const std::string& kind) {
  return kind == "CityObjectGroup" || kind == "ReliefFeature";
}

}  // namespace sunload
