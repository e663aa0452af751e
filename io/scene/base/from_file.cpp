// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/base/from_file.h"

#include <cmath>
#include <utility>

#include "geo/base/coordinates.h"

namespace sunload {

namespace {

/// Two million objects of 60 characters; tables hold each name up to four times.
constexpr std::size_t most_name_bytes = 120'000'000;

}  // namespace

SceneFromFile::SceneFromFile(const SceneFileRules& rules, char default_up, const std::string& file)
    : up_(rules.up == 0 ? default_up : rules.up), unit_m_(rules.unit_m) {
  if (up_ != 'x' && up_ != 'y' && up_ != 'z') {
    throw InputError({file}, std::string("up: ") + up_, "must be x, y or z");
  }
  if (!(unit_m_ > 0) || !std::isfinite(unit_m_)) {
    throw InputError({file}, "unit_m: " + std::to_string(unit_m_), "must be a positive length");
  }
}

Vec3 SceneFromFile::operator()(Vec3 p) const {
  const Vec3 turned = up_ == 'z' ? p : up_ == 'y' ? Vec3{p.x, -p.z, p.y} : Vec3{p.y, p.z, p.x};
  return turned * unit_m_;
}

bool is_usable(Vec3 p) {
  return std::abs(p.x) <= largest_coordinate_m && std::abs(p.y) <= largest_coordinate_m &&
         std::abs(p.z) <= largest_coordinate_m;
}

std::string UniqueNames::operator()(const std::string& name) {
  bytes_ += name.size();
  if (bytes_ > most_name_bytes) {
    throw InputError("names of objects take " + std::to_string(bytes_) +
                     " bytes (a scene has few names of some words); is one name very long?");
  }
  std::string candidate = name;
  for (int& n = last_.try_emplace(name, 1).first->second; !taken_.insert(candidate).second;)
    candidate = name + "_" + std::to_string(++n);
  return candidate;
}

void put_notes(const NoteCounter& counted, PolygonModel& model) {
  for (auto& line : counted.lines()) model.notes.push_back(std::move(line));
  for (auto& line : counted.warnings()) model.warnings.push_back(model.source + ": " + line);
}

}  // namespace sunload
