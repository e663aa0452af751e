// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/sensor_light.h"

namespace sunload {

BlockLight sensor_light(const LineSet& lines, const PatchOptics& optics,
                        const BlockSources& sources, RayColumns rays,
                        const std::vector<double>& parallel, const Columns& radiosity) {
  BlockLight light = unreflected_light(lines, optics, sources, std::move(rays), parallel);
  gather(lines.patches, radiosity, light.reflected, Into::add);
  return light;
}

Columns reflected_on_sensors(const LineSet& lines, const BlockSources& sources,
                             const Columns& radiosity) {
  Columns light = far_ground_light(lines, sources);
  gather(lines.patches, radiosity, light, Into::add);
  return light;
}

}  // namespace sunload
