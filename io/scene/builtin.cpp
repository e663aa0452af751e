// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/builtin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "geo/base/check.h"
#include "geo/builtin/scenes.h"
#include "io/base/key_names.h"
#include "io/scene/base/words.h"

namespace sunload {
namespace {

// Smaller lengths are below the details of the scenes, larger ones beyond any street.
constexpr double least_length = 0.1, largest_length = 1e4;

/// The parameters of one request, read key by key; collects what is wrong.
class Parameters {
 public:
  explicit Parameters(const BuiltinRules& rules) : rules_(rules) {}

  /// Replaces `length` if the parameter is given.
  void length(const std::string& key, double& length) {
    const std::string* text = find(key);
    if (text == nullptr) return;
    const auto value = finite_number(*text);
    if (value && *value >= least_length && *value <= largest_length)
      length = *value;
    else
      wrong(key, *text, "must be a length from 0.1 to 10000 m", "");
  }

  /// Replaces `value` if the parameter is given.
  void count(const std::string& key, double least, double most, double& value) {
    const std::string* text = find(key);
    if (text == nullptr) return;
    const auto number = finite_number(*text);
    if (number && *number >= least && *number <= most && *number == std::floor(*number))
      value = *number;
    else
      wrong(key, *text, fmt::format("must be a whole number from {:.0f} to {:.0f}", least, most),
            "");
  }

  /// The place of the given word in `words`, 0 if the parameter is not given.
  std::size_t choice(const std::string& key, const std::vector<std::string>& words) {
    const std::string* text = find(key);
    if (text == nullptr) return 0;
    const auto found = std::find(words.begin(), words.end(), *text);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    wrong(key, *text, "is no kind of " + key, key_hint(*text, words));
    return 0;
  }

  void require(bool holds, const std::string& key, const std::string& why) {
    if (!holds) problems_.add({}, rules_.name + ": " + key + " is too small", why);
  }

  void finish() {
    for (const auto& [key, value] : rules_.parameters)
      if (std::find(known_.begin(), known_.end(), key) == known_.end())
        problems_.add({}, "unknown parameter '" + key + "' of the scene '" + rules_.name + "'", "",
                      known_.empty() ? "it has none" : key_hint(key, known_));
    problems_.throw_if_any();
  }

  const std::vector<std::string>& known() const { return known_; }

 private:
  const std::string* find(const std::string& key) {
    known_.push_back(key);
    const auto found = rules_.parameters.find(key);
    return found == rules_.parameters.end() ? nullptr : &found->second;
  }

  void wrong(const std::string& key, const std::string& text, const std::string& why,
             const std::string& hint) {
    problems_.add({}, rules_.name + ": " + key + " = '" + shortened(text) + "'", why, hint);
  }

  const BuiltinRules& rules_;
  std::vector<std::string> known_;
  Problems problems_;
};

/// A scene whose parameters are read, ready to be built.
using Build = std::function<PolygonModel()>;

Build read_street(Parameters& p) {
  const bool is_glazed = p.choice("house_3", {"brick", "glazed"}) == 1;
  return
      [=] { return builtin::street(is_glazed ? builtin::House3::glazed : builtin::House3::brick); };
}

Build read_box_on_plane(Parameters& p) {
  builtin::BoxOnPlane size;
  p.length("width", size.width);
  p.length("depth", size.depth);
  p.length("height", size.height);
  p.length("plane", size.plane);
  constexpr double margin = 0.1;  // of plane around the box, in all
  p.require(size.plane >= std::max(size.width, size.depth) + margin, "plane",
            "it must be wider than the box");
  return [=] { return builtin::box_on_plane(size); };
}

Build read_canyon(Parameters& p) {
  builtin::Canyon size;
  p.length("height", size.height);
  p.length("width", size.width);
  p.length("length", size.length);
  return [=] { return builtin::canyon(size); };
}

Build read_room(Parameters& p) {
  builtin::Room size;
  p.length("width", size.width);
  p.length("depth", size.depth);
  p.length("height", size.height);
  constexpr double least_height = 1;  // above the table
  p.require(size.height >= least_height, "height", "a table of 0.8 m stands in the room");
  return [=] { return builtin::room(size); };
}

Build read_city(Parameters& p) {
  constexpr double one_house = 48, most_triangles = 2e7;
  double triangles = 1e4;
  p.count("triangles", one_house, most_triangles, triangles);
  return [=] { return builtin::city(triangles); };
}

Build read_cylinder(Parameters& p) {
  builtin::Cylinder size;
  p.length("radius", size.radius);
  p.length("height", size.height);
  return [=] { return builtin::cylinder(size); };
}

template <PolygonModel (*make)()>
Build read_fixed(Parameters&) {
  return make;
}

struct Scene {
  std::string name;
  Build (*read)(Parameters&);
};

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> all{
      {"street", read_street},
      {"skyscrapers", read_fixed<builtin::skyscrapers>},
      {"city", read_city},
      {"windows", read_fixed<builtin::windows>},
      {"room", read_room},
      {"cylinder", read_cylinder},
      {"box_on_plane", read_box_on_plane},
      {"canyon", read_canyon},
      {"emission", read_fixed<builtin::emission>},
      {"shadow", read_fixed<builtin::shadow>},
      {"large_extent", read_fixed<builtin::large_extent>},
      {"complex_paths", read_fixed<builtin::complex_paths>},
      {"geometric_accuracy", read_fixed<builtin::geometric_accuracy>},
  };
  return all;
}

const Scene& scene_named(const std::string& name) {
  for (const auto& scene : scenes())
    if (scene.name == name) return scene;
  throw InputError({}, "unknown built-in scene '" + shortened(name) + "'", "",
                   key_hint(name, builtin_scene_names()));
}

}  // namespace

std::vector<std::string> builtin_scene_names() {
  std::vector<std::string> names;
  for (const auto& scene : scenes()) names.push_back(scene.name);
  return names;
}

std::vector<std::string> builtin_parameters(const std::string& name) {
  const BuiltinRules none{name, {}};
  Parameters parameters(none);
  scene_named(name).read(parameters);
  return parameters.known();
}

PolygonModel builtin_scene(const BuiltinRules& rules) {
  const Scene& scene = scene_named(rules.name);
  Parameters parameters(rules);
  const Build build = scene.read(parameters);
  parameters.finish();
  return build();
}

}  // namespace sunload
