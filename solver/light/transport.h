// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How light goes from patch to patch.
#pragma once

namespace sunload {

/// gather: over lines traced once (solver/gather/jacobi); shoot: by samples of power
/// (solver/shoot/shooting).
enum class Transport { gather, shoot };

/// When shooting. incremental: what is not yet shot; regular: all of it again in every iteration.
enum class Jacobi { incremental, regular };

/// What becomes of the light that is reflected after the last bounce: what it brings is estimated
/// and added (solver/gather/unfollowed), or left out.
enum class Unfollowed { estimate, leave };

}  // namespace sunload
