// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Options that several commands have, in the same words.
#pragma once

#include <string>

#include "io/command/command_line.h"
#include "io/result/named_parts.h"
#include "io/result/period_choice.h"
#include "io/run/options.h"

namespace sunload {

void add_study(const Command& command, std::string& study);

/// Which variants of a study, the folder of their results, and with how many threads.
void add_place(const Command& command, RunOptions& options);

/// A result file, exactly one.
void add_result(const Command& command, std::string& result);

/// Facades, objects and selections by name or pattern; `only` is what is done with them alone,
/// `only_facades` where that of facades differs.
void add_named(const Command& command, NamedParts& parts, const std::string& only,
               const std::string& only_facades = {});

/// Which band of a result in bands.
void add_band(const Command& command, std::string& band);

/// Which part of the period. Its end is --until alone where the command has another --to already.
void add_period(const Command& command, PeriodChoice& period);

}  // namespace sunload
