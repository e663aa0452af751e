// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The viewer's page as it was built from scripts/viewer: markup, style and
/// programs, in pieces, without data.
#pragma once

#include <span>
#include <string_view>

namespace sunload {

/// What comes before and after the data. Both empty where this build has no
/// page (npm was missing).
std::span<const std::string_view> viewer_page_head();
std::span<const std::string_view> viewer_page_tail();

}  // namespace sunload
