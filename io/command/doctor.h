// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// `sunload doctor`: what this build has, what this machine gives, and whether it computes.
#pragma once

namespace sunload {

/// Prints one line for each thing, with what to do where it is missing, and computes a small scene
/// from its study to its result file. Exit code 3 where something is missing that runs need, 70
/// where the self-test's energy does not balance.
int doctor();

}  // namespace sunload
