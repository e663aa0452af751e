/// What the scene readers share: file access, axes and units, counted notes.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "geo/check.h"
#include "geo/vec.h"
#include "io/scene_file.h"

namespace sunload {

/// Scene from file: turns the file's axes and units into metres with z up.
class SceneFromFile {
 public:
  /// `default_up` is that of the format. Throws InputError for rules that make no sense.
  SceneFromFile(const SceneFileRules& rules, char default_up, const std::string& file);
  Vec3 operator()(Vec3 p) const;

 private:
  char up_;
  double unit_m_;
};

/// True for coordinates that geometry can be computed with: finite, and no farther
/// from the origin than any map projection of the Earth puts a point.
bool is_usable(Vec3 scene_position);

/// The bytes of a regular file of at most 2 GB; throws InputError otherwise.
std::string read_whole_file(const std::string& path);

/// The first bytes of a file, enough to tell its format.
std::string read_file_head(const std::string& path, std::size_t byte_count);

/// Line and column (from 1) of a byte of a text.
Where place_in_text(const std::string& file, std::string_view text, std::size_t byte,
                    int first_line = 1);

/// Corners of faces that so many bytes may make, where a format names parts again and again
/// (instances, USE, shared nodes): no file of less than 1 MB shall take more than 1 GB.
constexpr std::size_t most_corners_of(std::size_t file_bytes) { return 8'000'000 + 4 * file_bytes; }

std::string lower_case(std::string text);

/// Extension in lower case with its dot, or nothing.
std::string lower_extension(const std::string& path);

/// Hands out `name`, or `name_2`, `name_3` … where it is taken.
class UniqueNames {
 public:
  /// Throws InputError where names that are repeated take too much memory.
  std::string operator()(const std::string& name);

 private:
  std::size_t bytes_ = 0;
  std::set<std::string> taken_;
  std::map<std::string, int> last_;
};

/// Counts what happened; each kind becomes one note, `12 faces …`.
class NoteCounter {
 public:
  void count(const std::string& what, std::size_t times = 1) {
    if (times > 0) counts_[what] += times;
  }
  /// A note without a number, kept once.
  void say(const std::string& what) { counts_.try_emplace(what, 0); }
  std::vector<std::string> lines() const;

 private:
  std::map<std::string, std::size_t> counts_;
};

}  // namespace sunload
