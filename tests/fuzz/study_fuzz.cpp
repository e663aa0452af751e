// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Studies: YAML, all sections, canonical text. The files that a study names are there.
#include "io/study/study.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("study", [](std::string_view bytes) {
  static const bool has_files = [] {
    for (const char* name : {"a.obj", "a.epw"}) file_of({}, name);
    return !file_of("0 0 1.5 0 0 1\n", "a.pts").empty();
  }();
  if (!has_files) return;
  const auto study = read_study(file_of(bytes, "study.yaml"));
  for (const auto& variant : study.variants) canonical_text(variant);
});

}  // namespace sunload::fuzz
