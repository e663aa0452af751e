// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/onward.h"

#include "solver/base/sampling.h"
#include "solver/surface/lobe.h"

namespace sunload {

Onward onward(const Material& m, Vec3 n, Vec3 w, const RandomKey& key) {
  const double cos_theta = dot(w, n);
  Onward on{mirrored(w, n)};
  if (is_pane_or_metal(m)) {
    const SmoothShares shares = smooth_shares(m, cos_theta);
    on.weight = shares.mirror;
    on.transmitted = shares.transmitted;
    on.absorbed = left_over(1 - m.diffuse - shares.mirror - shares.transmitted);
  } else if (m.glossy <= 0) {
    on.weight = m.mirror;
  } else {
    on.weight = m.mirror + m.glossy;
    const RandomWords random = random_words(key);
    if (uniform(random[2]) * on.weight >= m.mirror) {  // the lobe, in proportion to its share
      const Tangents axes = tangents(on.direction);
      const Vec3 local =
          sample_power_cosine(static_cast<double>(uniform(random[0])),
                              static_cast<double>(uniform(random[1])), m.glossy_exponent);
      on.direction = axes.tangent * local.x + axes.bitangent * local.y + on.direction * local.z;
      on.weight *= lobe_sample_weight(dot(on.direction, n), m.glossy_exponent);
    }
    // What the lobe returns at this angle is known by this sample alone.
    on.absorbed = 1 - m.diffuse - m.transmittance - on.weight;
  }
  return on;
}

}  // namespace sunload
