// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// `sunload view`: of results, or of the scene of a study.
#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "geo/base/check.h"
#include "io/base/exit_code.h"
#include "io/base/standard_streams.h"
#include "io/command/commands.h"
#include "io/command/study_scenes.h"
#include "io/run/options.h"

namespace sunload {
namespace {

// A page shows so many side by side.
constexpr std::size_t most_viewed = 2;

/// The variants of a study that a page shows; tells what is left out.
std::vector<Study> viewed_variants(const StudyFile& file, const ViewOptions& options) {
  RunOptions chosen;
  chosen.variants = options.variants;
  auto studies = chosen_variants(file, chosen);
  if (studies.size() <= most_viewed) return studies;
  if (!options.variants.empty())
    throw InputError({file.path}, fmt::format("view of {} variants", studies.size()),
                     "a page shows one or two side by side", "name at most two");
  tell(fmt::format("{}: shows {} and {} of {} variants; --variant chooses others", options.page,
                   studies[0].variant, studies[1].variant, studies.size()));
  studies.resize(most_viewed);
  return studies;
}

/// The scene of a study as files that read like results without light.
std::deque<SceneFile> scene_files(const ViewOptions& options) {
  const StudyFile file = read_study(options.inputs.front());
  return study_scenes(file, viewed_variants(file, options), options.page);
}

}  // namespace

int view(const ViewOptions& options) {
  const bool has_study = std::any_of(options.inputs.begin(), options.inputs.end(),
                                     [](auto& path) { return is_study(path); });
  if (has_study && options.inputs.size() > 1)
    throw InputError({}, "view of a study and of something else",
                     "a study shows its own variants, without light",
                     "name the study alone, or results alone");
  if (!has_study && !options.variants.empty())
    throw InputError({}, "--variant without a study", "a result is of one variant",
                     "name the results of the variants, or the study");
  if (!has_study) {
    view_html(options.inputs, options.rules, options.page);
    return exit_code::done;
  }
  const auto scenes = scene_files(options);
  std::vector<std::string> paths(scenes.size());
  std::transform(scenes.begin(), scenes.end(), paths.begin(),
                 [](const SceneFile& scene) { return scene.path(); });
  view_html(paths, options.rules, options.page);
  return exit_code::done;
}

}  // namespace sunload
