// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/scene_file.h"

#include "io/plan/variant_mesh.h"
#include "io/run/result_attributes.h"
#include "io/run/result_geometry.h"

namespace sunload {

SceneFile::SceneFile(const VariantPlan& plan, const StudyFile& file, const std::string& output)
    : file_(output) {
  const VariantMesh made = unrefined_mesh(plan);
  ResultWriter::Options options;
  options.times_are_synthetic = plan.light.times_are_synthetic;
  options.quantity = plan.study.light.quantity;
  // Nobody keeps it.
  options.compression = 0;
  ResultWriter writer(file_.aside(), result_geometry(plan, *made.mesh), result_times(plan),
                      options);
  writer.finish(scene_attributes(plan), file.yaml);
}

}  // namespace sunload
