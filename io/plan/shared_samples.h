// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How many samples of the bright sky about the sun serve several suns.
#pragma once

#include "io/plan/variant_plan.h"

namespace sunload {

/// Samples that are drawn, of what each sun of the period would take by itself, where neighbours in
/// a block share them (solver/first_light/circumsolar_sky.h): modelled by the angles between them.
double share_of_samples_drawn(const VariantPlan& plan);

}  // namespace sunload
