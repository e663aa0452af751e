// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geo/edit/objects.h"
#include "geo/edit/raise.h"
#include "geo/edit/solids.h"
#include "geo/sun/site.h"
#include "io/base/name_pattern.h"
#include "io/plan/scene_models.h"
#include "io/study/file_place.h"

namespace sunload {

namespace {

constexpr std::size_t most_told = 8;  // of the names in a note

class SceneEditor {
 public:
  SceneEditor(PolygonModel model, const Study& study) : model_(std::move(model)), study_(study) {}

  PolygonModel run() {
    for (std::size_t s = 0; s < study_.scene.edit.size(); ++s) {
      step_ = &study_.scene.edit[s];
      number_ = s + 1;
      std::visit([&](const auto& action) { apply(action); }, step_->action);
    }
    return std::move(model_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& why,
                           const std::string& hint) const {
    throw InputError(step_->where, fmt::format("scene.edit[{}]: {}", number_, what), why, hint);
  }

  // --- what a step is about ---------------------------------------------------------------

  const std::string& crs() const { return study_.site.crs.empty() ? model_.crs : study_.site.crs; }

  std::vector<PlanArea> in_scene(const AreasStudy& study) const {
    if (!study.in_degrees || crs().empty()) return study.areas;
    std::vector<PlanArea> areas = study.areas;
    for (PlanArea& area : areas)
      for (auto& ring : area)
        for (Point2& p : ring) {
          if (std::abs(p.u) > 180 || std::abs(p.v) > 90)
            refuse(
                fmt::format("[{:.10g}, {:.10g}] are no degrees", p.u, p.v),
                "GeoJSON has longitude and latitude (RFC 7946) unless its member crs names a map "
                "projection",
                "write the corners in the scene's metres, or the file with its member crs");
          const Vec3 on_map = map_position(crs(), p.v, p.u, 0);
          p = {on_map.x, on_map.y};
        }
    return areas;
  }

  std::vector<std::string> names_of(const ChosenObjects& chosen) const {
    std::vector<std::string> names;
    for (std::size_t o = 0; o < chosen.size(); ++o)
      if (chosen[o] != 0) names.push_back(model_.object_names[o]);
    return names;
  }

  ChosenObjects chosen() const {
    const ObjectsStudy& wanted = step_->objects;
    const auto extents = extents_of(model_);
    const auto areas = in_scene(wanted.polygon);
    ChosenObjects chosen(model_.object_names.size(), 0);
    for (std::size_t o = 0; o < chosen.size(); ++o) {
      const Vec3 middle = extents[o].middle();
      const std::string kind = o < model_.object_kinds.size() ? model_.object_kinds[o] : "";
      const bool is_chosen =
          !extents[o].is_empty() && matches(wanted.object, model_.object_names[o]) &&
          matches(wanted.kind, kind) && (areas.empty() || lies_in(areas, {middle.x, middle.y}));
      chosen[o] = is_chosen ? 1 : 0;
    }
    if (wanted.near) keep_near(extents, chosen);
    if (std::none_of(chosen.begin(), chosen.end(), [](auto flag) { return flag != 0; }))
      refuse_unmatched();
    return chosen;
  }

  /// A place that is another frame's, or a slip: farther from the model than that is wide.
  void refuse_far(Point2 place) const {
    constexpr double surroundings_m = 1000;
    std::vector<Vec3> corners;
    for (const auto& extent : extents_of(model_))
      if (!extent.is_empty()) corners.insert(corners.end(), {extent.box.low, extent.box.high});
    if (corners.empty()) return;
    const ObjectExtent whole{bounding_box(corners)};
    const auto& [low, high] = whole.box;
    const double away = distance_in_plan(whole, place);
    if (away <= std::max(surroundings_m, std::hypot(high.x - low.x, high.y - low.y))) return;
    refuse(
        fmt::format("[{:.10g}, {:.10g}] is {:.0f} m away from the model", place.u, place.v, away),
        fmt::format("that lies at x {:.10g} to {:.10g}, y {:.10g} to {:.10g} in the metres of its "
                    "files",
                    low.x, high.x, low.y, high.y),
        "write the place in these");
  }

  /// Of bounding boxes in plan: those within the distance, or the nearest.
  void keep_near(const std::vector<ObjectExtent>& extents, ChosenObjects& chosen) const {
    const ObjectsStudy& wanted = step_->objects;
    refuse_far(*wanted.near);
    std::vector<double> away(chosen.size());
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t o = 0; o < chosen.size(); ++o) {
      if (chosen[o] == 0) continue;
      away[o] = distance_in_plan(extents[o], *wanted.near);
      nearest = std::min(nearest, away[o]);
    }
    bool is_taken = false;
    for (std::size_t o = 0; o < chosen.size(); ++o) {
      if (chosen[o] == 0) continue;
      const bool is_near =
          wanted.within_m ? away[o] <= *wanted.within_m : away[o] == nearest && !is_taken;
      chosen[o] = is_near ? 1 : 0;
      is_taken = is_taken || is_near;
    }
  }

  [[noreturn]] void refuse_unmatched() const {
    const ObjectsStudy& wanted = step_->objects;
    std::string words;
    const auto add = [&](const std::string& text) { words += (words.empty() ? "" : ", ") + text; };
    if (!wanted.object.empty()) add("object '" + wanted.object + "'");
    if (!wanted.kind.empty()) add("type '" + wanted.kind + "'");
    if (!wanted.polygon.areas.empty()) add("polygon");
    if (wanted.near) add("near");
    std::vector<std::string> kinds = model_.object_kinds;
    std::sort(kinds.begin(), kinds.end());
    kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
    auto meant = wanted.object.empty() ? near_names(wanted.kind, kinds)
                                       : near_names(wanted.object, model_.object_names);
    meant.resize(std::min(meant.size(), most_told));
    refuse(fmt::format("no object matches {} (there are {})", words, model_.object_names.size()),
           "a step changes something",
           meant.empty() ? "sunload check without the step lists what is there"
                         : fmt::format("did you mean '{}'?", fmt::join(meant, "', '")));
  }

  void tell(const std::string& what, const std::vector<std::string>& names) {
    const auto shown =
        names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), most_told));
    model_.notes.push_back(fmt::format("scene.edit[{}]: {} {} object{}: {}{}", number_, what,
                                       names.size(), names.size() == 1 ? "" : "s",
                                       fmt::join(names.begin(), shown, ", "),
                                       names.size() > most_told ? ", …" : ""));
  }

  // --- what it does -----------------------------------------------------------------------

  void apply(const RemoveEdit& /*has no values*/) {
    const ChosenObjects out = chosen();
    tell("removes", names_of(out));
    model_ = without_objects(model_, out);
  }

  void apply(const RaiseEdit& raise) {
    const ChosenObjects all = chosen();
    const auto extents = extents_of(model_);
    if (raise.by_m == 0) return tell("raises by 0 m", names_of(all));
    Problems problems;
    std::size_t windows = 0;
    for (std::size_t o = 0; o < all.size(); ++o) {
      if (all[o] == 0) continue;
      std::optional<double> cut;
      if (raise.from_m) cut = extents[o].box.low.z + *raise.from_m;
      const auto raised = raise_object(model_, make_id<ObjectId>(o), raise.by_m, cut);
      windows += raised.windows_cut;
      if (!raised.refusal.empty())
        problems.add(
            step_->where,
            fmt::format("scene.edit[{}]: {} {}", number_, model_.object_names[o], raised.refusal),
            raised.reason,
            "choose it out, or write raise.from_m: a height above its foot where its walls "
            "are upright");
    }
    problems.throw_if_any();
    tell(fmt::format("raises by {:g} m", raise.by_m), names_of(all));
    if (windows > 0)
      model_.notes.push_back(fmt::format(
          "scene.edit[{}]: {} window face{} where the walls are extended become{} higher", number_,
          windows, windows == 1 ? "" : "s", windows == 1 ? "s" : ""));
  }

  void apply(const MoveEdit& move) {
    const ChosenObjects all = chosen();
    displace_objects(model_, all, [&](Vec3 p) { return p + move.by; });
    tell("moves", names_of(all));
  }

  void apply(const TurnEdit& turn) {
    const ChosenObjects all = chosen();
    Box box;
    const auto extents = extents_of(model_);
    for (std::size_t o = 0; o < all.size(); ++o) {
      if (all[o] == 0) continue;
      const Box& own = extents[o].box;
      box.low = {std::min(box.low.x, own.low.x), std::min(box.low.y, own.low.y), 0};
      box.high = {std::max(box.high.x, own.high.x), std::max(box.high.y, own.high.y), 0};
    }
    Vec3 about = (box.low + box.high) * 0.5;
    if (turn.about) about = {turn.about->u, turn.about->v, 0};
    about.z = 0;
    const FilePlace place = file_place(about, turn.by_deg);
    displace_objects(model_, all, [&](Vec3 p) { return place(p - about); });
    tell(fmt::format("turns by {:g} degrees", turn.by_deg), names_of(all));
  }

  void apply(const ReplaceEdit& replace) {
    const ChosenObjects out = chosen();
    tell("replaces", names_of(out));
    model_ = without_objects(model_, out);
    add_file(replace.file);
  }

  void apply(const AddFileEdit& add) { add_file(add.file); }

  void add_file(const SceneFileStudy& file) {
    PolygonModel part = read_part(file, study_.scene);
    if (file.is_placed()) place(part, place_of(file, crs()));
    if (!part.crs.empty() && !model_.crs.empty() && part.crs != model_.crs)
      refuse("coordinates in " + part.crs, "the scene has " + model_.crs,
             "bring all files of a scene into one CRS, or give this one position_m");
    part.crs.clear();
    const std::size_t before = model_.object_names.size();
    append(model_, part);
    tell("adds", {model_.object_names.begin() + static_cast<std::ptrdiff_t>(before),
                  model_.object_names.end()});
  }

  double base_of(const std::optional<double>& base_m, Point2 at) const {
    return base_m ? *base_m : standing_height(model_, at).value_or(0);
  }

  std::string free_name(const std::string& wanted) const {
    const std::set<std::string> taken(model_.object_names.begin(), model_.object_names.end());
    std::string name = wanted;
    for (int n = 2; taken.contains(name); ++n) name = fmt::format("{}_{}", wanted, n);
    return name;
  }

  void apply(const AddPrismEdit& add) {
    const auto areas = in_scene(add.areas);
    Box box;
    for (const PlanArea& area : areas)
      for (const Point2 p : area.front()) {
        box.low = {std::min(box.low.x, p.u), std::min(box.low.y, p.v), 0};
        box.high = {std::max(box.high.x, p.u), std::max(box.high.y, p.v), 0};
      }
    const Vec3 middle = (box.low + box.high) * 0.5;
    refuse_far({middle.x, middle.y});
    const double base = base_of(add.base_m, {middle.x, middle.y});
    const std::string name = free_name(add.name);
    add_prism(model_, areas, base, base + add.height_m, {name, kind_of("Building"), add.material});
    tell(fmt::format("adds, from z = {:.2f} m,", base), {name});
  }

  void apply(const AddTreesEdit& add) {
    std::vector<Point2> places{add.at};
    if (add.to) {
      const double x = add.to->u - add.at.u, y = add.to->v - add.at.v, length = std::hypot(x, y);
      constexpr double rounding = 1e-9;
      const auto steps = static_cast<std::size_t>(length / add.every_m + rounding);
      if (steps > most_trees)
        refuse(fmt::format("a row of {} trees is too long", steps + 1),
               fmt::format("it has at most {}", most_trees), "");
      for (std::size_t s = 1; s <= steps; ++s) {
        const double share = static_cast<double>(s) * add.every_m / length;
        places.push_back({add.at.u + share * x, add.at.v + share * y});
      }
    }
    for (const Point2 at : {places.front(), places.back()}) refuse_far(at);
    std::vector<double> feet;  // of all before there are any: no tree stands on another
    feet.reserve(places.size());
    for (const Point2 at : places) feet.push_back(base_of(add.base_m, at));
    std::vector<std::string> names;
    for (std::size_t i = 0; i < places.size(); ++i) {
      names.push_back(
          free_name(places.size() == 1 ? add.name : fmt::format("{}_{}", add.name, i + 1)));
      add_tree(model_, {places[i].u, places[i].v, feet[i]}, add.shape,
               {names.back(), kind_of("SolitaryVegetationObject"), ""});
    }
    tell("adds", names);
  }

  /// Types are of cities alone: in plain files all are decided by shape.
  std::string kind_of(const char* kind) const { return model_.is_city_format ? kind : ""; }

  static constexpr std::size_t most_trees = 10'000;

  PolygonModel model_;
  const Study& study_;
  const EditStep* step_ = nullptr;
  std::size_t number_ = 0;
};

}  // namespace

PolygonModel edited(PolygonModel model, const Study& study) {
  return study.scene.edit.empty() ? std::move(model) : SceneEditor(std::move(model), study).run();
}

}  // namespace sunload
