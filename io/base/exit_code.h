/// Exit codes of the program (DESIGN 1).
#pragma once

namespace sunload::exit_code {

inline constexpr int done = 0;
inline constexpr int wrong_input = 2;
inline constexpr int machine_limit = 3;
inline constexpr int bug = 70;
inline constexpr int unfinished = 75;

}  // namespace sunload::exit_code
