// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/writing_behind.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace sunload::test {
namespace {

void fail() { throw std::runtime_error("disk full"); }

template <class Action>
std::string thrown_by(const Action& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(WritingBehind, GoesOnWhileOthersWork) {
  std::promise<void> go_on;
  bool is_written = false;
  WritingBehind writing;
  writing.begin([&] {
    go_on.get_future().wait();
    is_written = true;
  });
  go_on.set_value();  // never reached, were the file written by `begin`
  writing.finish();
  EXPECT_TRUE(is_written);
}

TEST(WritingBehind, WritesOneAfterAnotherInTheirOrder) {
  std::vector<int> order;
  {
    WritingBehind writing;
    for (int k = 0; k < 20; ++k) writing.begin([&order, k] { order.push_back(k); });
  }
  ASSERT_EQ(order.size(), 20u) << "the last is waited for";
  for (int k = 0; k < 20; ++k) EXPECT_EQ(order[static_cast<std::size_t>(k)], k);
}

TEST(WritingBehind, ErrorsReachWhoComesNextOnce) {
  WritingBehind writing;
  bool is_written = false;
  writing.begin(fail);
  EXPECT_EQ(thrown_by([&] { writing.begin([&] { is_written = true; }); }), "disk full");
  EXPECT_FALSE(is_written);
  EXPECT_EQ(thrown_by([&] { writing.finish(); }), "");
  writing.begin(fail);
  EXPECT_EQ(thrown_by([&] { writing.finish(); }), "disk full");
  EXPECT_EQ(thrown_by([&] { writing.finish(); }), "");
}

}  // namespace
}  // namespace sunload::test
