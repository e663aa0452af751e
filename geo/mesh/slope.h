// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How triangles lean, and which are above each other.
#pragma once

#include <optional>

#include "geo/mesh/mesh.h"

namespace sunload {

/// A face steeper than this is upright.
inline constexpr double upright_slope_deg = 70;

/// Which way a face looks: upward or downward where it leans no more than `upright_slope_deg` from
/// level, else upright.
enum class Slope { upward, upright, downward };
/// Nothing for a triangle without area.
std::optional<Slope> slope_of(const Mesh& mesh, std::size_t triangle);

/// Height of the triangle's plane above (x, y), where the point is inside of it in plan or on its
/// rim; nothing for a triangle that is upright in plan.
std::optional<double> height_at(Vec3 a, Vec3 b, Vec3 c, double x, double y);
std::optional<double> height_at(const Mesh& mesh, std::size_t triangle, double x, double y);

/// Objects of cities by the type that CityJSON has for them.
bool is_land(const std::string& object_kind);
bool is_plant(const std::string& object_kind);

}  // namespace sunload
