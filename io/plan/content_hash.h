// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The hash that names what a variant computes: equal hashes, equal results.
#pragma once

#include <string>

#include "io/plan/light_series.h"
#include "io/plan/scene_build.h"
#include "io/study/study.h"

namespace sunload {

/// Raised when results change, not at every commit: part of the content hash.
inline constexpr int numerics_version = 9;

/// SHA-256 of everything that can change a number: the study's canonical text, the scene as
/// prepared, times and weather, the instruction set that rays are traced with, `numerics_version`.
std::string content_hash(const Study& study, const BuiltScene& built, const LightSeries& light,
                         const std::string& isa);

/// Equal where realizations share their random numbers: hash of times, seed and counts.
std::string pairing_id(const Study& study, const LightSeries& light);

}  // namespace sunload
