// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/half_float.h"

#include <half.h>  // Imath

namespace sunload {

std::uint16_t half_bits(float value) { return Imath::half(value).bits(); }

}  // namespace sunload
