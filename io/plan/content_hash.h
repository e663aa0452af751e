// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The hash that names what a variant computes: equal hashes, equal results.
#pragma once

#include <string>

#include "io/plan/light_series.h"
#include "io/plan/scene_build.h"
#include "io/plan/scene_seasons.h"
#include "io/study/study.h"
#include "solver/mesh/mesh_pilot.h"

namespace sunload {

/// Raised when results change, not at every commit: part of the content hash.
inline constexpr int numerics_version = 51;

/// SHA-256 of everything that can change a number: the study's canonical text, the scene as
/// prepared, times and weather, the instruction set that rays are traced with, `numerics_version`;
/// the pilots of other variants that refine the same mesh, where there are any; what materials are
/// in the seasons of the period, where they change.
std::string content_hash(const Study& study, const BuiltScene& built, const LightSeries& light,
                         const std::string& isa, const std::string& mesh_pilots = {},
                         const SceneSeasons& seasons = {});

/// Of triangles, objects, kinds of surface and sides: equal meshes, equal patches before they are
/// refined.
std::string geometry_digest(const Mesh& mesh);
/// Of what the mesh pilot looks at beside the geometry: mirrors, lamps and screens triangle by
/// triangle, and the light.
std::string pilot_digest(const Scene& scene, const PeriodLight& light);

/// Of all that decides what rays tell, as long as nothing shines by itself: the scene but for the
/// diffuse reflectance of surfaces that do nothing else, mesh, sun, sky and counts. `mesh_pilots`
/// as in `content_hash`.
std::string rays_digest(const Study& study, const BuiltScene& built, const LightSeries& light,
                        const std::string& isa, const std::string& mesh_pilots);

/// Equal where realizations share their random numbers: hash of times, seed and counts.
std::string pairing_id(const Study& study, const LightSeries& light);

}  // namespace sunload
