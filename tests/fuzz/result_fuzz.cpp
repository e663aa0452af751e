// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Result files, through HDF5: every dataset of the schema that is there.
#include "io/result/reader.h"
#include "io/result/schema.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("result", [](std::string_view bytes) {
  const ResultReader result(file_of(bytes, "result.h5"));
  const auto read = [&](const ResultVariable& variable) {
    const std::string name(variable.name);
    if (!result.has(name)) return;
    result.units(name);
    const auto shape = result.shape(name);
    if (variable.type == h5::Type::text)
      result.strings(name);
    else
      result.doubles(name);
    if (!shape.empty() && shape[0] > 0) result.row(name, 0);
  };
  for (const auto& variable : result_schema(result.quantity()))
    run([&](std::string_view) { read(variable); }, bytes);
});

}  // namespace sunload::fuzz
