// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What every command may rely on in a result, asked once, when it is opened.
#pragma once

#include <string>

#include "io/result/h5.h"

namespace sunload {

/// Refuses a file whose datasets contradict the schema or each other. A file that HDF5 reads can
/// hold anything: other programs may have changed its values.
///
/// Asked for: of every dataset of the schema that is there its kind of values and its shape, with
/// one size for each dimension; the datasets of times, sun and patches without which no command can
/// do anything; indices within what they point into; positions, areas (> 0), unit normals and
/// irradiances (≥ 0) that are finite; times that increase, within the years 1 … 9999, and intervals
/// with a length; an origin of three numbers; a time zone that the system knows.
/// Not read here are series, totals and powers, of which there can be gigabytes: ResultReader
/// refuses values that no light can have when it reads them.
///
/// Takes memory and time like reading the mesh once. Throws InputError with all that is wrong, one
/// line for each dataset, and h5::Error.
void expect_sound(const std::string& path, const h5::File& file);

}  // namespace sunload
