// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "geo/base/unused_name.h"
#include "geo/edit/carriers.h"
#include "geo/edit/objects.h"
#include "geo/edit/raise.h"
#include "geo/edit/solids.h"
#include "geo/mesh/feet.h"
#include "geo/sun/map_axes.h"
#include "geo/sun/site.h"
#include "io/base/first_of_many.h"
#include "io/base/name_pattern.h"
#include "io/plan/row_places.h"
#include "io/plan/scene_models.h"
#include "io/plan/selection.h"
#include "io/scene/raster/tree_points.h"
#include "io/study/file_place.h"

namespace sunload {

namespace {

constexpr std::size_t most_told = 8;  // of the names in a note

class SceneEditor {
 public:
  SceneEditor(PolygonModel model, const Study& study) : model_(std::move(model)), study_(study) {}

  EditedModel run() {
    Problems problems;
    bool lacks_objects = false;  // that steps may go on to name
    for (std::size_t s = 0; s < study_.scene.edit.size() && !lacks_objects; ++s) {
      step_ = &study_.scene.edit[s];
      number_ = s + 1;
      try {
        std::visit([&](const auto& action) { apply(action); }, step_->action);
      } catch (const InputError& error) {
        problems.add(error);
        lacks_objects = brings_objects(step_->action);
      }
    }
    problems.throw_if_any();
    return {std::move(model_), std::move(placed_)};
  }

 private:
  static bool brings_objects(const EditAction& action) {
    return std::holds_alternative<ReplaceEdit>(action) ||
           std::holds_alternative<AddFileEdit>(action) ||
           std::holds_alternative<AddPrismEdit>(action) ||
           std::holds_alternative<AddTreesEdit>(action) ||
           std::holds_alternative<AddTreePointsEdit>(action);
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& why,
                           const std::string& hint) const {
    throw InputError(step_->where, subject() + ": " + what, why, hint);
  }

  // --- what a step is about ---------------------------------------------------------------

  const std::string& crs() const { return study_.site.crs.empty() ? model_.crs : study_.site.crs; }

  std::string subject() const { return fmt::format("scene.edit[{}]", number_); }

  FamilyTree tree() const { return {model_.object_names, model_.object_kinds, model_.families}; }
  SceneObjects objects() const { return {tree(), extents_of(model_)}; }

  std::vector<std::string> names_of(const ChosenObjects& chosen) const {
    std::vector<std::string> names;
    for (std::size_t o = 0; o < chosen.size(); ++o)
      if (chosen[o] != 0) names.push_back(model_.object_names[o]);
    return names;
  }

  ChosenObjects chosen() const {
    const SceneObjects all = objects();
    const SceneFrame frame{crs()};
    ChosenObjects chosen = Selector(step_->objects, frame, subject(), step_->where).objects(all);
    if (step_->selection) {
      const ChosenObjects named = selected_objects(*step_->selection, all, frame);
      for (std::size_t o = 0; o < chosen.size(); ++o)
        if (named[o] == 0) chosen[o] = 0;
    }
    if (std::none_of(chosen.begin(), chosen.end(), [](auto flag) { return flag != 0; }))
      refuse_unmatched();
    return chosen;
  }

  [[noreturn]] void refuse_unmatched() const {
    const SelectionStudy& wanted = step_->objects;
    std::string words;
    const auto add = [&](const std::string& text) { words += (words.empty() ? "" : ", ") + text; };
    if (!wanted.object.empty()) add("object '" + wanted.object + "'");
    if (!wanted.kind.empty()) add("type '" + wanted.kind + "'");
    if (!wanted.polygon.areas.empty()) add("polygon");
    if (wanted.near) add("near");
    if (step_->selection) add("selection '" + step_->selection->name + "'");
    std::vector<std::string> kinds = model_.object_kinds;
    std::sort(kinds.begin(), kinds.end());
    kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
    const SelectionStudy& named = step_->selection ? step_->selection->of : wanted;
    const std::string& object = wanted.object.empty() ? named.object : wanted.object;
    const std::string& kind = wanted.kind.empty() ? named.kind : wanted.kind;
    const FamilyTree all = tree();
    const std::string what =
        fmt::format("no object matches {} (there are {})", words, model_.object_names.size());
    if (const auto bare = bare_named(object, all); !bare.empty())
      refuse(what,
             fmt::format("{} is in the files, but nothing is read of it or of what belongs to it",
                         bare),
             "it may have points, lines or rooms alone, or be removed by a step before; sunload "
             "check without the step lists what is there");
    auto meant =
        object.empty() ? near_names(kind, kinds) : near_names(object, names_with_surfaces(all));
    meant.resize(std::min(meant.size(), most_told));
    refuse(what, "a step changes something",
           meant.empty() ? "sunload check without the step lists what is there"
                         : fmt::format("did you mean '{}'?", fmt::join(meant, "', '")));
  }

  /// The first object of that name of which nothing is read, where there are no others; else empty.
  static std::string bare_named(const std::string& object, const FamilyTree& all) {
    const auto has_surfaces = with_surfaces(all);
    std::string first;
    for (std::size_t place = all.size(); place-- > 0;) {
      if (object.empty() || !matches(object, all.name(place))) continue;
      if (has_surfaces[place] != 0) return {};
      first = all.name(place);
    }
    return first;
  }

  void tell(const std::string& what, const std::vector<std::string>& names,
            const std::string& besides = {}) {
    FirstOfMany told(most_told);
    for (const std::string& name : names) told.add(name);
    model_.notes.push_back(fmt::format("scene.edit[{}]: {} {} object{}: {}{}", number_, what,
                                       told.count(), told.count() == 1 ? "" : "s", told.text(),
                                       besides));
  }

  /// The same of objects that stand elsewhere now, or were not there before.
  void tell_placed(const std::string& what, const std::vector<std::string>& names) {
    tell(what, names);
    placed_.insert(names.begin(), names.end());
  }

  // --- what it does -----------------------------------------------------------------------

  void apply(const RemoveEdit& /*has no values*/) {
    const ChosenObjects out = chosen();
    tell("removes", names_of(out));
    model_ = without_objects(model_, out);
  }

  void apply(const RaiseEdit& raise) {
    ChosenObjects all = chosen();
    if (raise.by_m == 0) return tell("raises by 0 m", names_of(all));
    const auto [carriers, is_covered] = carriers_of(tree(), model_, all, raise.from_m);
    for (std::size_t o = 0; o < all.size(); ++o)
      if (is_covered[o] != 0) all[o] = 0;
    ChosenObjects bodies = all;
    for (std::size_t o = 0; o < all.size(); ++o)
      if (carriers[o]) bodies[o] = 0;
    const auto raised = raise_bodies(raise, bodies);
    std::size_t windows = 0;
    for (std::size_t o = 0; o < all.size(); ++o) {
      if (all[o] == 0) continue;
      const RaisedObject& body = raised[carriers[o].value_or(o)];
      const bool stays =
          !body.refusal.empty() ||
          (carriers[o] && !lift_with(model_, make_id<ObjectId>(o), body, raise.by_m));
      if (stays) all[o] = 0;
      windows += raised[o].windows_cut;
    }
    tell(fmt::format("raises by {:g} m", raise.by_m), names_of(all), cuts_in_words(raised));
    tell_bare(raise, raised);
    if (windows > 0)
      model_.notes.push_back(fmt::format(
          "scene.edit[{}]: {} window face{} where the walls are extended become{} higher", number_,
          windows, windows == 1 ? "" : "s", windows == 1 ? "s" : ""));
  }

  /// Where the objects were cut, and the walls that they got: " (cut at z = 6 m; walls added along
  /// 20 of 32 m)".
  static std::string cuts_in_words(const std::vector<RaisedObject>& raised) {
    double lowest = std::numeric_limits<double>::max(), highest = -lowest;
    double outline_m = 0, added_m = 0;
    for (const RaisedObject& each : raised) {
      if (!each.is_lifted) continue;
      lowest = std::min(lowest, each.cut_m);
      highest = std::max(highest, each.cut_m);
      outline_m += each.outline_m;
      added_m += each.added_m;
    }
    if (lowest > highest) return {};
    const auto in_cm = [](double z) { return fmt::format("{:g}", std::round(100 * z) / 100); };
    const std::string low = in_cm(lowest), high = in_cm(highest);
    std::string words = " (cut at z = " + low + (low == high ? "" : " … " + high) + " m";
    if (added_m > 0)
      words += fmt::format("; walls added along {:.4g} of {:.4g} m", added_m, outline_m);
    return words + ")";
  }

  /// Outlines that stay open.
  void tell_bare(const RaiseEdit& raise, const std::vector<RaisedObject>& raised) {
    constexpr double worth_telling_m = 1;
    std::vector<std::string> names;
    double outline_m = 0, bare_m = 0;
    for (std::size_t o = 0; o < raised.size(); ++o) {
      const double bare = raised[o].bare_m - raised[o].added_m;
      if (bare < worth_telling_m) continue;
      names.push_back(model_.object_names[o]);
      outline_m += raised[o].outline_m;
      bare_m += bare;
    }
    if (names.empty()) return;
    tell(raise.by_m > 0
             ? "leaves the outline open, as there is no floor to tell inside from outside,"
             : "lowers along lines without a wall, where neighbours may stand open now,",
         names, fmt::format(" (along {:.4g} of {:.4g} m)", bare_m, outline_m));
  }

  /// Throws where one cannot be raised, but for parts of buildings that end below from_m while
  /// others rise.
  std::vector<RaisedObject> raise_bodies(const RaiseEdit& raise, const ChosenObjects& bodies) {
    const auto extents = extents_of(model_);
    std::vector<RaisedObject> raised(bodies.size());
    Problems problems, of_low_parts;
    bool is_any_raised = false;
    for (std::size_t o = 0; o < bodies.size(); ++o) {
      if (bodies[o] == 0) continue;
      std::optional<double> cut;
      if (raise.from_m) cut = extents[o].box.low.z + *raise.from_m;
      raised[o] = raise_object(model_, make_id<ObjectId>(o), raise.by_m, cut);
      if (raised[o].refusal.empty()) {
        is_any_raised = true;
        continue;
      }
      const bool is_low_part =
          cut && *cut > extents[o].box.high.z && is_part_of_body(tree().kind(o));
      (is_low_part ? of_low_parts : problems)
          .add(step_->where,
               fmt::format("scene.edit[{}]: {} {}", number_, model_.object_names[o],
                           raised[o].refusal),
               raised[o].reason,
               "choose it out, or write raise.from_m: a height above its foot where its walls "
               "are upright");
    }
    problems.throw_if_any();
    if (!is_any_raised) of_low_parts.throw_if_any();
    return raised;
  }

  void apply(const MoveEdit& move) {
    const ChosenObjects all = chosen();
    displace_objects(model_, all, [&](Vec3 p) { return p + move.by; });
    tell_placed("moves", names_of(all));
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
    tell_placed(fmt::format("turns by {:g} degrees", turn.by_deg), names_of(all));
  }

  void apply(const ReplaceEdit& replace) {
    const ChosenObjects out = chosen();
    tell("replaces", names_of(out));
    model_ = without_objects(model_, out);
    add_file(replace.file);
  }

  void apply(const AddFileEdit& add) { add_file(add.file); }

  void add_file(const SceneFileStudy& file) {
    PolygonModel part = read_part(file, study_.scene, crs());
    if (file.is_placed()) place(part, place_of(file, crs()));
    if (!part.crs.empty() && !model_.crs.empty() && !are_of_one_map(part.crs, model_.crs))
      refuse("coordinates in " + part.crs, "the scene has " + model_.crs,
             "bring all files of a scene into one CRS, or give this one position_m");
    part.crs.clear();
    const std::size_t before = model_.object_names.size();
    append(model_, part);
    tell_placed("adds", {model_.object_names.begin() + static_cast<std::ptrdiff_t>(before),
                         model_.object_names.end()});
  }

  double base_of(const std::optional<double>& base_m, Point2 at) const {
    return base_m ? *base_m : standing_height(model_, at).value_or(0);
  }

  std::set<std::string> names_taken() const {
    return {model_.object_names.begin(), model_.object_names.end()};
  }

  void apply(const AddPrismEdit& add) {
    const auto areas = areas_in_scene(add.areas, crs(), subject(), step_->where);
    Box box;
    for (const PlanArea& area : areas)
      for (const Point2 p : area.front()) {
        box.low = {std::min(box.low.x, p.u), std::min(box.low.y, p.v), 0};
        box.high = {std::max(box.high.x, p.u), std::max(box.high.y, p.v), 0};
      }
    const Vec3 middle = (box.low + box.high) * 0.5;
    refuse_far({middle.x, middle.y}, extents_of(model_), subject(), step_->where);
    const double base = base_of(add.base_m, {middle.x, middle.y});
    auto taken = names_taken();
    const std::string name = unused_name(add.name, taken);
    box.low.z = box.high.z = base;
    const auto above = add.base_m ? height_in_the_air(model_, box) : std::nullopt;
    const bool hangs = above && add.height_m < lowest_house_m;
    add_prism(model_, areas, base, base + add.height_m,
              {name, hangs ? hanging_kind : kind_of("Building"), add.material});
    std::string where = fmt::format("from z = {:.2f} m", base);
    if (hangs) where += fmt::format(", {:.2f} m in the air", *above);
    if (above && !hangs)
      where += fmt::format(", {:.2f} m above the land there, to which a made ground rises", *above);
    tell_placed("adds, " + where + ",", {name});
  }

  void apply(const AddTreesEdit& add) {
    std::vector<Point2> places{add.at};
    if (add.to) {
      const double x = add.to->u - add.at.u, y = add.to->v - add.at.v, length = std::hypot(x, y);
      if (length / add.every_m > static_cast<double>(most_trees))
        refuse(fmt::format("a row of {:.0f} trees is too long", length / add.every_m + 1),
               fmt::format("it has at most {}", most_trees), "");
      places.clear();
      for (const double share : row_shares(length, add.every_m))
        places.push_back({add.at.u + share * x, add.at.v + share * y});
    }
    for (const Point2 at : {places.front(), places.back()})
      refuse_far(at, extents_of(model_), subject(), step_->where);
    std::vector<NewTree> trees;
    for (std::size_t i = 0; i < places.size(); ++i)
      trees.push_back({places[i], add.shape,
                       places.size() == 1 ? add.name : fmt::format("{}_{}", add.name, i + 1)});
    tell_placed("adds", planted(trees, add.base_m));
  }

  void apply(const AddTreePointsEdit& add) {
    const auto [points, notes] = read_tree_points(add.path, add.rules, crs(), study_.scene.unit_m);
    std::vector<NewTree> trees;
    const ObjectExtent model = extent_of_all(extents_of(model_));
    for (const auto& [place, height_m, crown_m, name] : points)
      if (model.is_empty() || distance_in_plan(model, place) <= beside_model_m)
        trees.push_back({place,
                         {height_m, crown_m, add.trunk_share * height_m, add.leaves, add.trunk},
                         fmt::format("{}_{}", add.name, name)});
    if (trees.empty()) {
      refuse_far(points.front().place, extents_of(model_), subject(), step_->where);
      refuse(fmt::format("none of {} trees stands on the model or less than {:g} m beside it",
                         points.size(), beside_model_m),
             "others are left out", "are they of this place?");
    }
    if (trees.size() > most_trees)
      refuse(fmt::format("{} trees are too many", trees.size()),
             fmt::format("there may be {}", most_trees), "cut the file to the place first");
    for (const auto& note : notes) model_.notes.push_back(fmt::format("{}: {}", subject(), note));
    if (const std::size_t left_out = points.size() - trees.size(); left_out > 0)
      model_.notes.push_back(fmt::format("{}: {} trees more than {:g} m beside the model left out",
                                         subject(), left_out, beside_model_m));
    tell_placed("adds", planted(trees, {}));
  }

  struct NewTree {
    Point2 place;
    TreeShape shape;
    std::string name;
  };
  /// Adds them all; none stands on another. Returns the names that they have got.
  std::vector<std::string> planted(const std::vector<NewTree>& trees,
                                   const std::optional<double>& base_m) {
    std::vector<double> feet;  // before there are any of them
    feet.reserve(trees.size());
    for (const NewTree& tree : trees) feet.push_back(base_of(base_m, tree.place));
    auto taken = names_taken();
    std::vector<std::string> names;
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const auto& [place, shape, name] = trees[i];
      names.push_back(unused_name(name, taken));
      add_tree(model_, {place.u, place.v, feet[i]}, shape,
               {names.back(), "SolitaryVegetationObject", ""});
    }
    return names;
  }

  /// Types are of cities alone: in plain files all are decided by shape, but for trees, whose
  /// crowns are no roofs and carry no ground.
  std::string kind_of(const char* kind) const { return model_.is_city_format ? kind : ""; }

  static constexpr std::size_t most_trees = 10'000;
  /// Of trees in a file, which may be all of a town: those farther away shade little of the model.
  static constexpr double beside_model_m = 20;

  PolygonModel model_;
  std::set<std::string> placed_;
  const Study& study_;
  const EditStep* step_ = nullptr;
  std::size_t number_ = 0;
};

}  // namespace

EditedModel edited(PolygonModel model, const Study& study) {
  if (study.scene.edit.empty()) return {std::move(model), {}};
  return SceneEditor(std::move(model), study).run();
}

}  // namespace sunload
