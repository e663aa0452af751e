// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// All reflections at once, by a dense factorisation. The only file here that knows Eigen.
#pragma once

#include <vector>

namespace sunload {

/// R = (1 - F ρ)⁻¹ F of n patches, row by row: with E_0 the irradiance that arrives without diffuse
/// reflection, E = E_0 + R ρ E_0. `F`: [n][n] form factors; `rho`: [n] diffuse reflectances. No
/// entry is below 0. Cost: 8/3 n³ operations. Throws InputError where light would go on for ever.
std::vector<float> all_reflections(const std::vector<float>& F, const std::vector<float>& rho);

}  // namespace sunload
