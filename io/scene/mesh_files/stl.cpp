// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/mesh_files/stl.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <unordered_map>

#include "io/scene/base/indexed_faces.h"
#include "io/scene/base/words.h"

namespace sunload {

namespace {

constexpr std::size_t header_bytes = 84;    // a remark of 80 bytes and the count of triangles
constexpr std::size_t triangle_bytes = 50;  // normal, three points, two bytes of attributes
constexpr std::size_t normal_bytes = 12;

struct HashOfPoint {
  std::size_t operator()(const Vec3& p) const {
    std::size_t hash = 0;
    // 64-bit golden ratio: spreads the few bits in which neighbours differ.
    for (const double value : {p.x, p.y, p.z})
      hash = (hash ^ std::hash<double>{}(value)) * 0x9E3779B97F4A7C15u;
    return hash ^ (hash >> 32);
  }
};

class StlReader {
 public:
  StlReader(const std::string& path, const SceneFileRules& rules)
      : path_(path), text_(read_whole_file(path)), faces_(path, rules, 'z') {}

  PolygonModel read() {
    if (has_binary_length())
      read_binary();
    else if (lower_case(std::string(trimmed(text_).substr(0, 5))) == "solid")
      read_text();
    else
      refuse_length();
    return faces_.finish();
  }

 private:
  std::size_t stated_count() const {
    std::uint32_t count = 0;
    for (std::size_t b = 4; b-- > 0;)
      count = (count << 8) | static_cast<unsigned char>(text_[header_bytes - 4 + b]);
    return count;
  }

  bool has_binary_length() const {
    return text_.size() >= header_bytes &&
           text_.size() == header_bytes + triangle_bytes * stated_count();
  }

  [[noreturn]] void refuse_length() const {
    if (text_.size() < header_bytes) {
      throw InputError({path_}, "is no STL file",
                       "it has neither a binary header nor 'solid' in front");
    }
    throw InputError({path_}, "has another length than its header states",
                     fmt::format("{} triangles take {} bytes, it has {}", stated_count(),
                                 header_bytes + triangle_bytes * stated_count(), text_.size()),
                     "is it cut off?");
  }

  /// False where the point is beyond all coordinates on Earth.
  bool add_point(Vec3 point) {
    const Vec3 no_signed_zeros = point + Vec3{};  // −0 + 0 is 0: they are the same place
    const auto [entry, is_new] =
        vertex_at_.try_emplace(no_signed_zeros, static_cast<std::int32_t>(faces_.vertex_count()));
    faces_.add_corner(entry->second);
    return !is_new || faces_.add_vertex(no_signed_zeros);
  }

  void read_binary() {
    const auto count = stated_count();
    faces_.expect(count / 2, count);  // a closed surface has half as many vertices as triangles
    vertex_at_.reserve(count / 2);
    std::size_t with_attributes = 0;
    for (std::size_t t = 0; t < count; ++t) {
      const char* at = text_.data() + header_bytes + t * triangle_bytes + normal_bytes;
      for (int corner = 0; corner < 3; ++corner, at += 3 * sizeof(float)) {
        const Vec3 point{little_float(at), little_float(at + sizeof(float)),
                         little_float(at + 2 * sizeof(float))};
        faces_.note_single_precision(point);
        if (!add_point(point)) {
          throw InputError({path_}, fmt::format("triangle {} has a point that is none on Earth", t),
                           "a coordinate is no finite number below 1e9 m", "is unit_m right?");
        }
      }
      faces_.end_face();
      with_attributes += at[0] != 0 || at[1] != 0;
    }
    faces_.notes().count("attributes of triangles ignored", with_attributes);
  }

  static double little_float(const char* at) {
    std::uint32_t bits = 0;
    for (std::size_t b = sizeof(bits); b-- > 0;)
      bits = (bits << 8) | static_cast<unsigned char>(at[b]);
    return static_cast<double>(std::bit_cast<float>(bits));
  }

  [[noreturn]] void fail(const Words& words, std::string_view word, const std::string& what,
                         const std::string& why = {}) const {
    throw InputError(place_in_text(path_, text_, words.byte_of(word)), what, why,
                     "is the file cut off?");
  }

  /// White space is free: a facet may stand on one line, or all of a file. Words behind the first
  /// of a line that are no keywords have no meaning.
  void read_text() {
    Words words(text_);
    while (!words.at_end()) {
      const auto word = words.next();
      if (word.empty())
        words.go_to_next_line();
      else
        read_statement(words, word);
    }
    if (is_in_facet_ || !has_end_) fail(words, {}, "the file ends within a solid");
  }

  void read_statement(Words& words, std::string_view word) {
    const auto keyword = lower_case(std::string(word));
    if (keyword == "solid") {
      begin_solid(std::string(name_on_line(words)));
    } else if (keyword == "facet") {
      is_in_facet_ = true;
      skip_normal(words);
    } else if (keyword == "vertex") {
      if (!is_in_facet_) fail(words, {}, "a vertex outside of all facets");
      read_vertex(words);
    } else if (keyword == "endfacet") {
      faces_.end_face();
      is_in_facet_ = false;
    } else if (keyword == "endsolid") {
      end_solid(words);
    } else if (keyword != "outer" && keyword != "loop" && keyword != "endloop" &&
               is_first_of_line(word)) {
      fail(words, {}, "unknown statement '" + shortened(keyword) + "'",
           "this is hardly an STL file");
    }
  }

  bool is_first_of_line(std::string_view word) const {
    const char* at = word.data();
    while (at != text_.data() && at[-1] != '\n' && trimmed({at - 1, 1}).empty()) --at;
    return at == text_.data() || at[-1] == '\n';
  }

  static std::string_view next_word(Words& words) {
    auto word = words.next();
    for (; word.empty() && !words.at_end(); word = words.next()) words.go_to_next_line();
    return word;
  }

  static bool is_word(std::string_view word, const char* wanted) {
    return lower_case(std::string(word)) == wanted;
  }

  /// The order of corners tells it.
  static void skip_normal(Words& words) {
    Words ahead = words;
    if (!is_word(next_word(ahead), "normal")) return;
    for (int k = 0; k < 3; ++k) {
      words = ahead;
      const auto word = next_word(ahead);
      if (is_word(word, "outer") || is_word(word, "vertex")) return;
    }
    words = ahead;
  }

  /// Names hold blanks; on a line that goes on they end where a facet begins.
  std::string_view name_on_line(Words& words) const {
    const Words before = words;
    const auto begin = before.byte_of({});
    for (Words ahead = before;; words = ahead) {
      const auto word = ahead.next();
      if (word.empty()) break;
      if (is_word(word, "facet") && is_word(Words(ahead).next(), "normal"))
        return trimmed(std::string_view(text_).substr(begin, ahead.byte_of(word) - begin));
    }
    words = before;
    return words.rest();
  }

  /// The next solid may begin on the same line.
  void end_solid(Words& words) {
    has_end_ = true;
    const auto name = name_on_line(words);
    if (!is_word(Words(words).next(), "facet")) return;
    std::optional<std::string_view> next_name;
    for (Words in_name(name); !in_name.at_end();)
      if (const auto word = in_name.next(); is_word(word, "solid"))
        next_name = trimmed(name.substr(in_name.byte_of({})));
      else if (word.empty())
        break;
    if (next_name) begin_solid(std::string(*next_name));
  }

  void begin_solid(const std::string& name) {
    has_end_ = false;
    faces_.use_object(name.empty() ? std::filesystem::path(path_).stem().string() : name);
  }

  void read_vertex(Words& words) {
    std::array<double, 3> xyz{};
    for (auto& coordinate : xyz) {
      const auto word = next_word(words);
      const auto value = finite_number(word);
      if (!value)
        fail(words, word, "'" + shortened(word) + "' is no finite number",
             "a coordinate was expected");
      coordinate = *value;
    }
    if (!add_point({xyz[0], xyz[1], xyz[2]}))
      fail(words, {}, "vertex beyond all coordinates on Earth", "no map projection reaches 1e9 m");
  }

  std::string path_;
  std::string text_;
  IndexedFaces faces_;
  bool is_in_facet_ = false, has_end_ = true;  ///< of text: where the cursor stands
  std::unordered_map<Vec3, std::int32_t, HashOfPoint> vertex_at_;
};

}  // namespace

PolygonModel read_scene_stl(const std::string& path, const SceneFileRules& rules) {
  return StlReader(path, rules).read();
}

}  // namespace sunload
