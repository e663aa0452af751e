// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What of a picture's rules cannot be, or would have no effect: each throws InputError with all of
/// it.
#pragma once

#include "io/picture/render.h"
#include "io/result/shown_quantity.h"

namespace sunload {

/// Of rules among themselves.
void expect_sense(const RenderRules& rules);
/// Of a comparison, or a map of a place.
void expect_fit_for_derived(const ResultReader& result, const RenderRules& rules);
/// Of series whose rows are days or months.
void expect_fit_for_steps(const ResultReader& result, const RenderRules& rules);
/// A time that nothing in the picture depends on is a slip: the user wants another quantity.
void expect_time_matters(const ResultReader& result, const RenderRules& rules,
                         const ShownQuantity& shown);
/// Options of light make no sense of a scene without it.
void expect_fit_for_kinds(const RenderRules& rules);

/// Whether a picture is of a scene without light.
bool is_of_kinds(PictureColours colours);

}  // namespace sunload
