// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/builtin/tenement.h"

#include <algorithm>

namespace sunload::builtin {
namespace {

constexpr double course_height = 0.2, course_depth = 0.1;  // string course of each floor
constexpr double front_eave = 0.5, rear_eave = 0.35;       // how far the eaves stand out
constexpr double eave_height = 0.25, cornice_height = 0.55;
constexpr double mansard_inset = 1.1, mansard_height = 2.9;
constexpr double sill_height = 0.9;
constexpr double top_storey_less = 0.35;

std::string storey_name(std::size_t storey) { return "storey_" + std::to_string(storey); }

/// Profile of a house from the front's foot, through the floor and over the roof.
std::vector<Sweep::Edge> house_profile(const House& house, const HouseFinishes& f) {
  const double eaves = house.eaves(), depth = house.depth;
  std::vector<Sweep::Edge> profile{{{0, 0}, f.floor, ""},
                                   {{depth, 0}, f.wall, "rear"},
                                   {{depth, eaves - eave_height}, f.trim, ""},
                                   {{depth + rear_eave, eaves - eave_height}, f.trim, ""}};
  const Point2 ridge{depth / 2, eaves + house.ridge};
  if (house.roof == Roof::mansard) {
    profile.push_back({{depth + rear_eave, eaves}, f.roof, "steep_rear"});
    profile.push_back({{depth - mansard_inset, eaves + mansard_height}, f.roof, "slope_rear"});
    profile.push_back({ridge, f.roof, "slope_front"});
    profile.push_back({{mansard_inset, eaves + mansard_height}, f.roof, "steep_front"});
  } else {
    profile.push_back({{depth + rear_eave, eaves}, f.roof, "slope_rear"});
    profile.push_back({ridge, f.roof, "slope_front"});
  }
  profile.push_back({{-front_eave, eaves}, f.trim, ""});
  profile.push_back({{-front_eave, eaves - eave_height}, f.trim, ""});
  profile.push_back({{-front_eave / 2, eaves - eave_height}, f.trim, ""});
  profile.push_back({{-front_eave / 2, eaves - cornice_height}, f.trim, ""});
  double floor = eaves;
  for (std::size_t s = house.storeys.size(); s-- > 0;) {
    const double top = s + 1 == house.storeys.size() ? eaves - cornice_height : floor;
    profile.push_back({{0, top}, s == 0 ? f.base_wall : f.wall, storey_name(s)});
    floor -= house.storeys[s];
    if (s == 0) break;
    profile.push_back({{0, floor + course_height}, f.trim, ""});
    profile.push_back({{-course_depth, floor + course_height}, f.trim, ""});
    profile.push_back({{-course_depth, floor}, f.trim, ""});
  }
  return profile;
}

double axis_at(double width, int axes, int k) { return width * (k + 0.5) / axes; }

void decorate_front(Sweep& shell, const House& house, const HouseFinishes& f) {
  for (std::size_t s = 1; s < house.storeys.size(); ++s) {
    Face& wall = shell.face(storey_name(s));
    WindowKind kind = house.window;
    if (s + 1 == house.storeys.size()) {  // under the cornice
      kind.height -= top_storey_less;
      kind.hood = 0;
    }
    for (int k = 0; k < house.axes; ++k) {
      const double u = axis_at(house.width, house.axes, k);
      const bool has_balcony =
          std::count(house.balcony_axes.begin(), house.balcony_axes.end(), k) > 0;
      if (has_balcony) {
        constexpr double slab_foot = 0.3, width = 2.2, depth = 1.1;
        balcony(wall, {u, slab_foot}, width, depth, f);
      } else {
        window(wall, {u, sill_height - course_height}, kind, f);
      }
    }
  }
}

void decorate_ground_floor(Sweep& shell, const House& house, const HouseFinishes& f) {
  Face& wall = shell.face(storey_name(0));
  constexpr double door_width = 1.5, door_height = 3.0;
  constexpr double shop_low = 0.5, shop_high = 3.0, shop_margin = 0.35, flat_sill = 1.3;
  for (int k = 0; k < house.axes; ++k) {
    const double u = axis_at(house.width, house.axes, k), half = house.width / house.axes / 2;
    if (k == house.door_axis) {
      door(wall, u, door_width, door_height, f);
    } else if (house.ground_floor == GroundFloor::shops) {
      shop_window(wall, {u - half + shop_margin, shop_low}, {u + half - shop_margin, shop_high}, f);
    } else {
      WindowKind kind = house.window;
      kind.hood = 0;
      window(wall, {u, flat_sill}, kind, f);
    }
  }
}

void decorate_rear(Face& wall, const House& house, const HouseFinishes& f) {
  const WindowKind kind{.width = 1.0, .height = 1.5, .sill = 0, .panes = Panes::one};
  double floor = 0;
  for (const double height : house.storeys) {
    for (int k = 0; k < house.rear_axes; ++k)
      window(wall, {axis_at(house.width, house.rear_axes, k), floor + sill_height}, kind, f);
    floor += height;
  }
}

/// Windows in the middle of a free-standing gable.
void decorate_gable(Face& wall, const House& house, const HouseFinishes& f) {
  const WindowKind kind{.width = 0.8, .height = 1.4, .panes = Panes::one};
  const double middle = (wall.low().u + wall.high().u) / 2;
  double floor = house.storeys[0];
  for (std::size_t s = 1; s < house.storeys.size(); ++s) {
    for (int k = 0; k < house.gable_axes; ++k) {
      constexpr double pitch = 3;
      const double u = middle + pitch * (k - (house.gable_axes - 1) / 2.0);
      window(wall, {u, floor + sill_height}, kind, f);
    }
    floor += house.storeys[s];
  }
}

void decorate_roof(Sweep& shell, const House& house, const HouseFinishes& f) {
  const bool is_mansard = house.roof == Roof::mansard;
  const double up = is_mansard ? 0.6 : 1.3;  // from the eaves to a dormer's front, along the roof
  Face& lower = shell.face(is_mansard ? "steep_front" : "slope_front");
  for (int k = 0; k < house.dormers; ++k)
    dormer(lower, {axis_at(house.width, house.dormers, k), up},
           is_mansard ? DormerKind{.wall_height = 1.4, .gable_height = 0.5} : DormerKind{}, f);
  Face& front = shell.face("slope_front");
  Face& rear = shell.face("slope_rear");
  constexpr double window_share = 0.62;  // of the slope, above the dormers
  for (int k = 0; k < house.roof_windows; ++k)
    roof_window(rear,
                {house.width * (k + 1.0) / (house.roof_windows + 1), window_share * rear.high().v},
                f);
  constexpr double from_ridge = 0.7, stack_length = 1.6, stack_depth = 0.7, above_ridge = 1.2;
  for (int k = 0; k < house.chimneys; ++k) {
    Face& slope = k % 2 == 0 ? front : rear;
    constexpr double end_margin = 1.6, pots_pitch = 0.7;
    const double u = end_margin + (house.width - 2 * end_margin) * k / (house.chimneys - 1);
    chimney(slope, {u, slope.high().v - from_ridge}, {stack_length, stack_depth},
            house.eaves() + house.ridge + above_ridge, static_cast<int>(stack_length / pots_pitch),
            f);
  }
}

/// Fins and transoms that stand out of a storey of glass, one pane from edge to edge.
void add_curtain_grid(Face& glass, int columns, Finish metal) {
  constexpr double margin = 0.2, fin_width = 0.08, fin_depth = 0.25;
  constexpr double transom_at = 0.95, transom_height = 0.06, transom_depth = 0.08, gap = 0.1;
  const double pitch = glass.high().u / columns;
  for (int k = 0; k < columns; ++k) {
    const double left = k * pitch, right = left + pitch;
    const double from = left + (k == 0 ? margin : fin_width / 2 + gap);
    const double to = right - (k + 1 == columns ? margin : fin_width / 2 + gap);
    glass
        .step(rectangle({from, transom_at}, {to, transom_at + transom_height}), transom_depth,
              metal, metal)
        .emit();
    if (k > 0)
      glass
          .step(rectangle({left - fin_width / 2, margin},
                          {left + fin_width / 2, glass.high().v - margin}),
                fin_depth, metal, metal)
          .emit();
  }
}

/// Large panes between the piers of a storey.
void add_large_windows(Face& wall, int columns, Finish metal, Finish glass) {
  constexpr double pier = 0.5, sill = 0.5, head = 0.35, recess = 0.15;
  const double pitch = (wall.high().u - pier) / columns;
  for (int k = 0; k < columns; ++k) {
    const double left = pier + k * pitch;
    wall.step(rectangle({left, sill}, {left + pitch - pier, wall.high().v - head}), -recess, metal,
              glass)
        .emit();
  }
}

}  // namespace

void add_house(Builder& builder, const House& house, const HouseFinishes& f, FreeGable free) {
  builder.begin_object(house.name, house.placement);
  Sweep shell(builder, house_profile(house, f), house.width, f.wall);
  decorate_ground_floor(shell, house, f);
  decorate_front(shell, house, f);
  decorate_rear(shell.face("rear"), house, f);
  decorate_gable(free == FreeGable::low_x ? shell.gable_low() : shell.gable_high(), house, f);
  decorate_roof(shell, house, f);
  shell.emit();
}

void add_glazed_house(Builder& builder, const House& house, const HouseFinishes& f,
                      const OfficeFinishes& office, FreeGable free) {
  const auto& [metal, glass, deck] = office;
  constexpr double parapet = 0.9, parapet_width = 0.3, band = 0.25, band_depth = 0.08;
  const double top = house.eaves(), d = house.depth;
  std::vector<Sweep::Edge> profile{{{0, 0}, f.floor, ""}};
  double floor = 0;
  for (std::size_t s = 0; s < house.storeys.size(); ++s) {  // up the rear
    profile.push_back({{d, floor}, metal, "rear_" + std::to_string(s)});
    floor += house.storeys[s];
    profile.push_back({{d, floor - band}, metal, ""});
    profile.push_back({{d + band_depth, floor - band}, metal, ""});
    profile.push_back({{d + band_depth, floor}, metal, ""});
  }
  profile.push_back({{d - parapet_width, top}, metal, ""});
  profile.push_back({{d - parapet_width, top - parapet}, deck, "deck"});
  profile.push_back({{parapet_width, top - parapet}, metal, ""});
  profile.push_back({{parapet_width, top}, metal, ""});
  for (std::size_t s = house.storeys.size(); s-- > 0;) {  // down the front
    profile.push_back({{-band_depth, floor}, metal, ""});
    profile.push_back({{-band_depth, floor - band}, metal, ""});
    profile.push_back({{0, floor - band}, glass, storey_name(s)});
    floor -= house.storeys[s];
    if (s > 0) profile.push_back({{0, floor}, metal, ""});
  }
  builder.begin_object(house.name, house.placement);
  Sweep shell(builder, profile, house.width, f.wall);
  constexpr int front_columns = 18, rear_columns = 9;
  for (std::size_t s = 0; s < house.storeys.size(); ++s) {
    add_curtain_grid(shell.face(storey_name(s)), front_columns, metal);
    add_large_windows(shell.face("rear_" + std::to_string(s)), rear_columns, metal, glass);
  }
  decorate_gable(free == FreeGable::low_x ? shell.gable_low() : shell.gable_high(), house, f);
  Face& roof = shell.face("deck");
  constexpr double plant_height = 2.2, plant_width = 3.5, plant_margin = 3.5;
  for (const double u : {0.25, 0.75}) {
    const double middle = u * house.width;
    roof.step(rectangle({middle - plant_width / 2, plant_margin},
                        {middle + plant_width / 2, roof.high().v - plant_margin}),
              plant_height, metal, {metal.material, Surface::roof})
        .emit();
  }
  shell.emit();
}

}  // namespace sunload::builtin
