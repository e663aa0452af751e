// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of `scene.edit` done on the model that scene files make.
#pragma once

#include <set>
#include <string>

#include "geo/mesh/mesh.h"
#include "io/study/study.h"

namespace sunload {

/// A model after its steps.
struct EditedModel {
  PolygonModel model;
  std::set<std::string> placed;  ///< names of objects that steps added, moved or turned
};

/// One step after the other; what each has chosen is added to the model's notes. Throws InputError,
/// at the step, where nothing matches (with near names) or where it cannot be done.
EditedModel edited(PolygonModel model, const Study& study);

}  // namespace sunload
