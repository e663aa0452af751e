// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The emitter that is hidden, by gathering: lines alone find it in mirrors, and need several times
/// as long as samples of the lamp (references_08_test) for the same error.
#include "tests/support/hidden_emitter.h"

namespace sunload::test {
namespace {

TEST(HiddenEmitter, ArrivesByOneReflection) {
  expect_hidden_emitter(Transport::gather, {128, 256}, 0.005);
}

}  // namespace
}  // namespace sunload::test
