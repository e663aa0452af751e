// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Readers under hostile input: what the fuzzers (scripts/fuzz) and the replay of their
/// findings (replay_test.cpp) share.
///
/// A target is a function of the bytes of a file. InputError is an expected outcome; any other
/// exception, a crash, more than 5 s, or more than 1 GB for less than 1 MB is a finding.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "geo/mesh/mesh.h"
#include "io/scene/file.h"

namespace sunload::fuzz {

using Target = std::function<void(std::string_view bytes)>;

/// All targets of this executable: one of a fuzzer, every one of the replay.
std::map<std::string, Target>& targets();

/// Enters a target into the table before `main`.
struct Registered {
  Registered(const std::string& name, Target target) { targets()[name] = std::move(target); }
};

/// Runs a target. InputError is the user's: what it says must be there.
void run(const Target& target, std::string_view bytes);

/// Writes the bytes to a file of that name in a folder of this process; returns its path.
std::string file_of(std::string_view bytes, const std::string& name);

/// What `check` does with a model: preparation. Models beyond some thousand corners are left
/// alone, so that one input takes milliseconds. Rules follow from the length of the input.
void prepare_small(const PolygonModel& model, std::size_t input_bytes);

/// A scene file, read and prepared.
void read_and_prepare(std::string_view bytes, const std::string& name,
                      PolygonModel (*read)(const std::string&, const SceneFileRules&));

/// Takes the first byte off, for choices that are not part of the file; 0 where there is none.
unsigned char take_byte(std::string_view& bytes);

}  // namespace sunload::fuzz
