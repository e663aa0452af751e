// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/luminaire_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geo/base/keys.h"
#include "geo/base/units.h"
#include "geo/mesh/clip.h"
#include "solver/base/sampling.h"

namespace sunload {

namespace {

/// Wider ones are no lobes, and their pyramids hardly less than a half space.
constexpr double widest_cone = 60 * radians_per_degree;
constexpr double angle_rounding = 1e-9;
/// Each step down the intensity falls to a quarter, five times: to a thousandth.
constexpr double step_down = 0.25;
constexpr int intensity_steps = 5;
constexpr std::size_t most_lobes = 4;
/// A cone that is wider than the one before by less than this share takes its place.
constexpr double next_cone = 1.2;
/// Pyramids of so many sides hold 0.8 % more than narrow cones: that is rejected. They are wider,
/// so that no side touches the cone.
constexpr int pyramid_sides = 24;
constexpr double pyramid_angle = 1.001;
constexpr int most_draws = 1000;
/// Of a cone: less of it is nothing.
constexpr double least_share_of_cone = 1e-12;
/// From this solid angle on directions are drawn within it [sr].
constexpr double least_drawn_solid_angle = 1e-3;

double angle_between(Vec3 a, Vec3 b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

Vec3 direction_of(double plane_deg, double gamma_deg) {
  const double C = plane_deg * radians_per_degree, gamma = gamma_deg * radians_per_degree;
  return {std::sin(gamma) * std::cos(C), std::sin(gamma) * std::sin(C), std::cos(gamma)};
}

/// What lies between two angles γ and two planes C.
struct WebCell {
  double from_plane, to_plane, from_gamma, to_gamma;  ///< [degree]
  double largest;                                     ///< intensity
  Vec3 brightest;                                     ///< direction of the corner that has it

  /// Largest and least angle between `axis` and the corners, and what lies opposite to it in C.
  struct Reach {
    double least, largest;
  };
  Reach reach(Vec3 axis) const {
    const double opposite =
        std::fmod(std::atan2(axis.y, axis.x) / radians_per_degree + 180 + 360, 360.0);
    Reach reach{pi, 0};
    for (const double plane : {from_plane, to_plane, std::clamp(opposite, from_plane, to_plane)})
      for (const double gamma : {from_gamma, to_gamma}) {
        const double angle = angle_between(axis, direction_of(plane, gamma));
        reach.least = std::min(reach.least, angle);
        reach.largest = std::max(reach.largest, angle);
      }
    return reach;
  }
};

/// Those that are not dark.
std::vector<WebCell> cells_of(const IntensityWeb& web) {
  // A single plane stands for all.
  const bool is_round = web.planes_deg.size() == 1;
  const std::vector<double> planes = is_round ? std::vector<double>{0, 360} : web.planes_deg;
  const std::size_t gammas = web.gammas_deg.size();
  std::vector<WebCell> cells;
  for (std::size_t p = 1; p < planes.size(); ++p)
    for (std::size_t g = 1; g < gammas; ++g) {
      WebCell cell{planes[p - 1], planes[p], web.gammas_deg[g - 1], web.gammas_deg[g], 0, {}};
      for (const std::size_t plane : {p - 1, p})
        for (const std::size_t gamma : {g - 1, g}) {
          const double I = web.intensities[(is_round ? 0 : plane) * gammas + gamma];
          if (I <= cell.largest) continue;
          cell.largest = I;
          cell.brightest = direction_of(planes[plane], web.gammas_deg[gamma]);
        }
      if (cell.largest > 0) cells.push_back(cell);
    }
  return cells;
}

/// Cells of a web about one axis.
class Lobe {
 public:
  Lobe(const std::vector<WebCell>& cells, Vec3 axis, double peak) : axis_(axis), peak_(peak) {
    for (const WebCell& cell : cells)
      if (const auto reach = cell.reach(axis); reach.least <= widest_cone * (1 + angle_rounding))
        near_.push_back({cell.largest, reach.largest});
  }

  /// Angle within which all is that is brighter than `level`.
  double angle(double level) const {
    double angle = 0;
    for (const auto& [largest, reach] : near_)
      if (largest > level) angle = std::max(angle, reach);
    return angle;
  }
  double first_angle() const { return angle(peak_ * step_down); }

  std::vector<IntensitySteps::Cone> cones() const {
    std::vector<IntensitySteps::Cone> cones;
    double level = peak_;
    for (int step = 0; step < intensity_steps; ++step) {
      const double next = level * step_down;
      const double edge = angle(next) * (1 + angle_rounding);
      if (edge > widest_cone * (1 + angle_rounding)) break;
      if (!cones.empty() && edge < next_cone * cones.back().angle) {
        cones.back().angle = edge;
        cones.back().intensity += level - next;
      } else {
        cones.push_back({axis_, edge, level - next});
      }
      level = next;
    }
    return cones;
  }

 private:
  struct Near {
    double largest, reach;
  };
  Vec3 axis_;
  double peak_;
  std::vector<Near> near_;
};

const WebCell& brightest(const std::vector<WebCell>& cells) {
  return *std::max_element(cells.begin(), cells.end(), [](const WebCell& a, const WebCell& b) {
    return a.largest < b.largest;
  });
}

/// About where the cells are brightest, or the end of the web's axis where that is narrower.
std::vector<IntensitySteps::Cone> brightest_lobe(const std::vector<WebCell>& cells) {
  const WebCell& peak = brightest(cells);
  Lobe lobe(cells, peak.brightest, peak.largest);
  for (const Vec3 axis : {Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
    if (angle_between(axis, peak.brightest) >= widest_cone) continue;
    const Lobe about_axis(cells, axis, peak.largest);
    if (about_axis.first_angle() <= lobe.first_angle()) lobe = about_axis;
  }
  return lobe.cones();
}

/// Inward normals of the sides of a pyramid about a cone.
std::vector<Vec3> pyramid_about(Vec3 axis, double angle) {
  const Tangents across = tangents(axis);
  std::vector<Vec3> sides;
  for (int s = 0; s < pyramid_sides; ++s) {
    const double turn = 2 * pi * s / pyramid_sides;
    const Vec3 out = across.tangent * std::cos(turn) + across.bitangent * std::sin(turn);
    sides.push_back(axis * std::sin(angle) - out * std::cos(angle));
  }
  return sides;
}

enum class Held { nothing, partly, whole };

/// How much of a triangle lies in a cone from the origin; `nothing` only where that is sure by a
/// ball about it.
Held held(const std::array<Vec3, 3>& corners, Vec3 axis, double angle) {
  const auto& [a, b, c] = corners;
  const Vec3 middle = (a + b + c) / 3;
  const double radius = std::max({norm(a - middle), norm(b - middle), norm(c - middle)});
  const double distance = norm(middle);
  if (distance > radius && angle_between(axis, middle) > angle + std::asin(radius / distance))
    return Held::nothing;
  const double least = std::cos(angle);
  const bool is_whole = std::all_of(corners.begin(), corners.end(), [&](Vec3 corner) {
    return dot(axis, corner) >= least * norm(corner);
  });
  return is_whole ? Held::whole : Held::partly;
}

/// Whether a cone from the origin lies within the triangle.
bool holds_cone(const std::array<Vec3, 3>& corners, Vec3 axis, double angle) {
  const double least = std::sin(angle);
  const double side = dot(cross(corners[0], corners[1]), corners[2]) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 inward = cross(corners[i], corners[(i + 1) % 3]) * side;
    if (dot(inward, axis) < least * norm(inward)) return false;
  }
  return true;
}

/// Places 0 … 1 on the way from p to q, ends included, where it crosses a circle about the origin;
/// both in a plane at distance 1 from it, about its foot.
std::vector<double> crossings(Vec3 p, Vec3 q, double radius) {
  std::vector<double> places{0};
  const Vec3 way = q - p;
  // |p + t way|² less 1, the distance of the plane, is the square of the radius.
  const double a = dot(way, way), b = dot(p, way), c = dot(p, p) - 1 - radius * radius;
  if (const double root = b * b - a * c; a > 0 && root > 0)
    for (const double t : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a})
      if (t > 0 && t < 1) places.push_back(t);
  places.push_back(1);
  return places;
}

/// Size of a polygon, in the plane across `axis` at distance 1, that lies in the cone: its solid
/// angle, or area. As seen from the axis each edge bounds a triangle, and where it is outside of
/// the cone a sector of that.
double size_in_cone(const std::vector<Vec3>& polygon, Vec3 axis, double angle,
                    bool is_solid_angle) {
  const double radius = std::tan(angle);
  const double of_turn =
      is_solid_angle ? 2 * std::pow(std::sin(angle / 2), 2) : radius * radius / 2;
  double size = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const std::vector<double> places = crossings(p, q, radius);
    for (std::size_t k = 1; k < places.size(); ++k) {
      const Vec3 from = p + (q - p) * places[k - 1], to = p + (q - p) * places[k];
      const Vec3 out_from = from - axis, out_to = to - axis, middle = (out_from + out_to) / 2;
      const double twice_area = dot(axis, cross(out_from, out_to));
      double part = std::abs(twice_area) / 2;
      if (dot(middle, middle) > radius * radius)
        part = of_turn * angle_between(out_from, out_to);
      else if (is_solid_angle)
        part = SphericalTriangle(axis, from, to).solid_angle();
      size += twice_area < 0 ? -part : part;
    }
  }
  return std::abs(size);
}

/// The place of x in a row of sizes, and where in that size it lies, in [0, 1).
struct Chosen {
  std::size_t place;
  double rest;
};
Chosen chosen(const std::vector<double>& sizes, double x) {
  std::size_t i = 0;
  while (i + 1 < sizes.size() && x >= sizes[i]) x -= sizes[i++];
  constexpr double below_one = 1 - 0x1p-32;
  return {i, sizes[i] > 0 ? std::clamp(x / sizes[i], 0.0, below_one) : 0};
}

}  // namespace

IntensitySteps steps_of(const IntensityWeb& web) {
  IntensitySteps steps;
  std::vector<WebCell> left = cells_of(web);
  for (std::size_t lobe = 0; lobe < most_lobes && !left.empty(); ++lobe) {
    const auto cones = brightest_lobe(left);
    if (cones.empty()) break;
    steps.cones.insert(steps.cones.end(), cones.begin(), cones.end());
    std::erase_if(left, [&](const WebCell& cell) {
      return cell.reach(cones.back().axis).largest <= cones.back().angle;
    });
  }
  if (!left.empty()) steps.beyond = brightest(left).largest;
  return steps;
}

LuminaireView::LuminaireView(const Luminaire& luminaire, const IntensitySteps& steps,
                             const std::array<Vec3, 3>& corners)
    : corners_{corners[0] - luminaire.position, corners[1] - luminaire.position,
               corners[2] - luminaire.position},
      seen_(corners_[0], corners_[1], corners_[2]),
      whole_(steps.beyond) {
  for (const auto& [own, angle, intensity] : steps.cones) {
    const Vec3 axis =
        luminaire.plane_0 * own.x + luminaire.plane_90 * own.y + luminaire.axis * own.z;
    const Held how = held(corners_, axis, angle);
    if (how == Held::whole) whole_ += intensity;
    if (how == Held::partly) add_part(axis, angle, intensity);
  }
  if (!parts_.empty()) weigh();
}

void LuminaireView::add_part(Vec3 axis, double angle, double intensity) {
  const double of_cone = 4 * pi * std::pow(std::sin(angle / 2), 2);
  Part part{.axis = axis, .least_cosine = std::cos(angle)};
  if (holds_cone(corners_, axis, angle)) {
    part.size = of_cone;
    part.weight = intensity * of_cone;
    part.by_solid_angle = true;
    parts_.push_back(std::move(part));
    return;
  }
  part.polygon.assign(corners_.begin(), corners_.end());
  for (const Vec3 side : pyramid_about(axis, pyramid_angle * angle))
    part.polygon = clipped(part.polygon, [&](Vec3 p) { return dot(side, p); });
  if (part.polygon.size() < 3) return;
  for (Vec3& corner : part.polygon) corner = corner / dot(axis, corner);
  const double solid_angle = size_in_cone(part.polygon, axis, angle, true);
  if (solid_angle <= least_share_of_cone * of_cone) return;
  part.by_solid_angle = solid_angle >= least_drawn_solid_angle;
  part.size = part.by_solid_angle ? solid_angle : size_in_cone(part.polygon, axis, angle, false);
  part.weight = intensity * solid_angle;
  for (std::size_t i = 2; i < part.polygon.size(); ++i) {
    const Vec3 a = part.polygon[0], b = part.polygon[i - 1], c = part.polygon[i];
    part.fan.emplace_back(a, b, c);
    part.sizes.push_back(part.by_solid_angle ? part.fan.back().solid_angle()
                                             : norm(cross(b - a, c - a)) / 2);
    part.size_of_fan += part.sizes.back();
  }
  parts_.push_back(std::move(part));
}

/// Weights become shares of their sum.
void LuminaireView::weigh() {
  whole_ *= seen_.solid_angle();
  double sum = whole_;
  for (const Part& part : parts_) sum += part.weight;
  whole_ /= sum;
  weights_.push_back(whole_);
  for (Part& part : parts_) {
    part.weight /= sum;
    weights_.push_back(part.weight);
  }
}

LuminaireView::Direction LuminaireView::sample(double u, double v) const {
  const auto [place, rest] = chosen(weights_, u);
  if (place == 0) {
    const Vec3 w = sample_triangle_seen(rest, v);
    return {w, density(w, nullptr)};
  }
  const Part& part = parts_[place - 1];
  const Vec3 w = part.sample(rest, v);
  return {w, density(w, &part)};
}

/// `own`: the part that it was drawn in, at whose edge it may lie.
double LuminaireView::density(Vec3 w, const Part* own) const {
  double density = whole_ > 0 ? whole_ * density_of_triangle_seen(w) : 0;
  for (const Part& part : parts_)
    if (&part == own || part.contains(w)) density += part.weight * part.density(w);
  return density;
}

Vec3 LuminaireView::sample_triangle_seen(double u, double v) const {
  if (seen_.solid_angle() >= least_drawn_solid_angle) return seen_.sample(u, v);
  const Barycentric at = sample_triangle(u, v);
  return normalized(corners_[0] * at.w0 + corners_[1] * at.w1 + corners_[2] * at.w2);
}

double LuminaireView::density_of_triangle_seen(Vec3 w) const {
  if (seen_.solid_angle() >= least_drawn_solid_angle) return 1 / seen_.solid_angle();
  // r² / (A cosθ), with 2A the length of the normal.
  const Vec3 normal = cross(corners_[1] - corners_[0], corners_[2] - corners_[0]);
  const double twice_area = norm(normal);
  const double height = std::abs(dot(normal, corners_[0])) / twice_area;
  const double cos_theta = std::abs(dot(normal, w)) / twice_area;
  return 2 * height * height / (twice_area * cos_theta * cos_theta * cos_theta);
}

bool LuminaireView::Part::contains(Vec3 w) const { return dot(axis, w) >= least_cosine; }

double LuminaireView::Part::density(Vec3 w) const {
  if (by_solid_angle) return 1 / size;
  const double cosine = dot(axis, w);
  return 1 / (size * cosine * cosine * cosine);
}

Vec3 LuminaireView::Part::sample(double u, double v) const {
  if (fan.empty()) return sample_cone(u, v);
  Vec3 w = sample_fan(u, v);
  for (int draw = 1; draw < most_draws && !contains(w); ++draw) {
    // Others, independent of these.
    const auto next =
        mixed(static_cast<std::uint64_t>(u * 0x1p52), static_cast<std::uint64_t>(v * 0x1p52));
    u = static_cast<double>(next >> 32) * 0x1p-32;
    v = static_cast<double>(next & 0xffffffffu) * 0x1p-32;
    w = sample_fan(u, v);
  }
  return w;
}

Vec3 LuminaireView::Part::sample_cone(double u, double v) const {
  const Tangents across = tangents(axis);
  const double versine = u * size / (2 * pi), turn = 2 * pi * v;
  const double sine = std::sqrt(versine * (2 - versine));
  return axis * (1 - versine) + across.tangent * (sine * std::cos(turn)) +
         across.bitangent * (sine * std::sin(turn));
}

Vec3 LuminaireView::Part::sample_fan(double u, double v) const {
  const auto [piece, rest] = chosen(sizes, u * size_of_fan);
  if (by_solid_angle) return fan[piece].sample(rest, v);
  const Barycentric at = sample_triangle(rest, v);
  return normalized(polygon[0] * at.w0 + polygon[piece + 1] * at.w1 + polygon[piece + 2] * at.w2);
}

}  // namespace sunload
