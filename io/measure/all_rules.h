// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Every rule, one per file; for io/measure/rules.cpp alone.
#pragma once

#include "io/measure/rule.h"

namespace sunload::rules {

MeasureRule sun_hours();
MeasureRule en_17037();
MeasureRule csn_73_4301();
MeasureRule bre_209_garden();
MeasureRule bre_209_vsc();
MeasureRule bre_209_probable_sun();
MeasureRule bright_sun();
MeasureRule light_hours();
MeasureRule glint_hours();
MeasureRule daylight_factor();
MeasureRule peak_light();
MeasureRule roof_potential();

}  // namespace sunload::rules
