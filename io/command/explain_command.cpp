// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "io/base/exit_code.h"
#include "io/command/commands.h"
#include "io/explain/explanation.h"
#include "io/explain/painting.h"
#include "io/explain/place.h"

namespace sunload {

namespace {

std::string text_of(const Explanation& explanation, ExplainOptions::Format format) {
  switch (format) {
    case ExplainOptions::Format::csv:
      return explanation_csv(explanation);
    case ExplainOptions::Format::json:
      return explanation_json(explanation);
    case ExplainOptions::Format::text:
      break;
  }
  return explanation_text(explanation);
}

std::string text_of(const Painting& painting, ExplainOptions::Format format) {
  switch (format) {
    case ExplainOptions::Format::csv:
      return painting_csv(painting);
    case ExplainOptions::Format::json:
      return painting_json(painting);
    case ExplainOptions::Format::text:
      break;
  }
  return painting_text(painting);
}

}  // namespace

int explain(const ExplainOptions& options) {
  ResultScenes scenes(options.study_folder);
  if (options.what == ExplainOptions::What::painting) {
    const auto result = opened(options.result);
    place_named(*result, options.parts);  // refuses before the work
    std::cout << text_of(painted(*result, *scenes.of(*result), options.parts), options.format);
    return exit_code::done;
  }
  const auto explanation_of = [&](const NamedResult& named) {
    const auto result = opened(named);
    place_named(*result, options.parts);  // refuses before the work
    return explained(*result, *scenes.of(*result), options.parts);
  };
  Explanation explanation = explanation_of(options.result);
  if (!options.against.empty()) {
    NamedResult base = options.result;
    base.path = options.against;
    explanation = difference(explanation_of(base), explanation);
  }
  std::cout << text_of(explanation, options.format);
  return exit_code::done;
}

}  // namespace sunload
