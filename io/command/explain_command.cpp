// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>

#include "io/base/exit_code.h"
#include "io/base/output_target.h"
#include "io/command/commands.h"
#include "io/explain/explanation.h"
#include "io/explain/painting.h"
#include "io/explain/place.h"
#include "io/explain/place_map.h"
#include "io/picture/picture.h"
#include "io/picture/waterfall.h"
#include "io/result/pairing.h"
#include "io/result/time.h"

namespace sunload {

namespace {

/// In the format that is asked for.
template <class Made>
std::string text_of(const Made& made, ExplainOptions::Format format,
                    std::string (*text)(const Made&), std::string (*csv)(const Made&),
                    std::string (*json)(const Made&)) {
  switch (format) {
    case ExplainOptions::Format::csv:
      return csv(made);
    case ExplainOptions::Format::json:
      return json(made);
    case ExplainOptions::Format::text:
      break;
  }
  return text(made);
}

/// Refuses, before the work, what cannot be explained.
std::unique_ptr<const ResultReader> opened_to_explain(const NamedResult& named,
                                                      const NamedParts& parts) {
  auto result = opened(named);
  expect_explainable(*result);
  place_named(*result, parts);
  return result;
}

}  // namespace

int explain(const ExplainOptions& options) {
  expect_picture_name(options.picture);  // before the work
  if (!options.map.empty()) expect_map_name(options.map);
  ResultScenes scenes(options.study_folder);
  if (options.what == ExplainOptions::What::painting) {
    const auto result = opened_to_explain(options.result, options.parts);
    std::cout << text_of(painted(*result, *scenes.of(*result), options.parts), options.format,
                         painting_text, painting_csv, painting_json);
    return exit_code::done;
  }
  const auto explanation_of = [&](const NamedResult& named) {
    const auto result = opened_to_explain(named, options.parts);
    const auto scene = scenes.of(*result);
    for (const auto& output : {options.map, options.picture})
      expect_not_read(output, scene->files());
    if (!options.map.empty()) write_place_map(*result, *scene, options.parts, options.map);
    return explained(*result, *scene, options.parts);
  };
  Explanation explanation = explanation_of(options.result);
  if (!options.against.empty()) {
    NamedResult base = options.result;
    base.path = options.against;
    const auto result_of_base = opened(base), result = opened(options.result);
    explanation =
        difference(explanation_of(base), explanation, are_pairs(*result_of_base, *result));
    if (auto times = different_times_in_words(*result_of_base, *result); !times.empty())
      explanation.notes.push_back(std::move(times));
    for (auto& note : notes_on_places(*result_of_base, *result, options.parts))
      explanation.notes.push_back(std::move(note));
  }
  if (!options.picture.empty()) draw_waterfall(explanation, options.picture);
  std::cout << text_of(explanation, options.format, explanation_text, explanation_csv,
                       explanation_json);
  return exit_code::done;
}

}  // namespace sunload
