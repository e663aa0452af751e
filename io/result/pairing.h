// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether two results may be compared realization by realization.
#pragma once

#include "io/result/reader.h"

namespace sunload {

/// Whether their errors are those of pairs, of the part of the period that is chosen in both: by
/// equal `pairing_id`, or where periods differ by the same intervals in the part, seed, counts of
/// realizations, lines and samples, and transport. Lines are common then; direct samples are
/// addressed by the interval's place in the period, and may be others. Differences realization by
/// realization have the right error in either case: realization r of one result has common numbers
/// with realization r of the other alone, or none, so that they are independent of each other.
bool are_pairs(const ResultReader& base, const ResultReader& variant);

}  // namespace sunload
