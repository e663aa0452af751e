// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How light goes from patch to patch.
#pragma once

namespace sunload {

/// gather: over lines traced once (solver/gather/jacobi); shoot: by samples of power
/// (solver/shoot/shooting); matrix: by form factors between all patches of a small scene
/// (solver/matrix/form_factors).
enum class Transport { gather, shoot, matrix };

/// When shooting. incremental: what is not yet shot; regular: all of it again in every iteration.
enum class Jacobi { incremental, regular };

/// Where the intervals of a period have their sky's and their reflected light from. each: a
/// solution for every interval; modes: few solutions for all (solver/transport/year_gathering);
/// automatic: few solutions where that pays and its error is a third of the standard error or less.
enum class Year { each, modes, automatic };

/// What becomes of the light that is reflected after the last bounce: what it brings is estimated
/// and added (solver/gather/unfollowed), or left out.
enum class Unfollowed { estimate, leave };

}  // namespace sunload
