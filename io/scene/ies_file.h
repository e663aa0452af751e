// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Photometry of luminaires as makers publish it: ANSI/IES LM-63 of 1986 … 2019 (.ies), type C.
#pragma once

#include <string>

#include "geo/lamp/intensity_web.h"

namespace sunload {

/// Candelas of the luminaire as it hangs: values times its multiplier and ballast factors, planes
/// that symmetry leaves out filled in. Throws InputError with all that is wrong: no such file,
/// types A and B (of headlights and floodlights), tilted lamps, angles out of order, negative or
/// missing values.
IntensityWeb read_ies_file(const std::string& path);

}  // namespace sunload
