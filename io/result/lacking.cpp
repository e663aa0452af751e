// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/lacking.h"

#include "io/base/standard_streams.h"

namespace sunload {

void warn_of_lacking(const ResultReader& result) {
  if (const std::string lacking = result.lacking(); !lacking.empty())
    tell_warnings({lacking + ": totals are those of the others, and series have gaps"},
                  result.path());
}

}  // namespace sunload
