// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_scene.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/sky/sky_colour.h"
#include "solver/base/threads.h"

namespace sunload {
namespace {

constexpr int samples = 2;  ///< per pixel and axis
constexpr std::size_t tile_size = 4;
static_assert(tile_size * tile_size == packet_size);
// Two faces of a wall that turn by more are a fold that gets a line; the facets
// of a round tower of 18 sides and more get none.
constexpr double fold_deg = 20;
// Parallel faces further apart than this, as in a window's reveal, get a line [m].
constexpr double step_m = 0.05;
// How much of the contrast a line takes; patch lines are fainter than borders.
constexpr double border_strength = 0.75, mesh_strength = 0.35;
// Half width of a patch line in pixels, and the height of a triangle in pixels
// below which its lines fade so that they do not cover the colour.
constexpr double mesh_half_width = 0.5, mesh_fade_pixels = 6;
// Lines are dark on colours above this luminance and light below it: 18 % is
// the grey halfway between black and white for the eye (L* = 50).
constexpr double middle_luminance = 0.184;
constexpr double dark_line = 0.01, light_line = 0.55;
constexpr std::size_t palette_steps = 1024;
// What rises by less is no building: kerbs, slabs, plates that are modelled as thin bodies.
constexpr double least_rise_m = 2;

std::vector<Vec3> vectors(const std::vector<double>& flat) {
  std::vector<Vec3> points(flat.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  return points;
}

Colour blended(Colour a, Colour b, double share) {
  const auto mix = [&](double x, double y) { return x + share * (y - x); };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

/// A line over a colour (linear light), dark or light, whichever shows.
Colour lined(Colour c, double strength) {
  // Luminance of linear sRGB (IEC 61966-2-1).
  const double luminance = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
  const double line = luminance > middle_luminance ? dark_line : light_line;
  return blended(c, {line, line, line}, strength);
}

/// sRGB of linear light by table: a step of 2⁻¹⁶ is less than a twentieth of one of 255.
class Encoder {
 public:
  Encoder() : table_(steps + 1) {
    for (std::size_t k = 0; k <= steps; ++k)
      table_[k] = srgb_from_linear(static_cast<double>(k) / static_cast<double>(steps));
  }
  Colour operator()(Colour c) const { return {at(c.red), at(c.green), at(c.blue)}; }

 private:
  static constexpr std::size_t steps = 65536;
  double at(double x) const {
    return table_[static_cast<std::size_t>(std::lround(std::clamp(x, 0.0, 1.0) * steps))];
  }
  std::vector<double> table_;
};

/// Colours of what the rays have met, in linear light.
class Painter {
 public:
  Painter(const PatchScene& scene, const Camera& camera, const PatchColours& colours,
          const Background& background)
      : scene_(scene), camera_(camera), colours_(colours), background_(background) {
    for (std::size_t k = 0; k < palette_steps; ++k)
      palette_.push_back(linear_light(map_colour(
          colours.palette, static_cast<double>(k) / static_cast<double>(palette_steps - 1))));
  }

  /// `column`, `row`: of the sample; `border`: whether it lies at one.
  Colour operator()(const TracedPicture::Sample& sample, std::size_t column, std::size_t row,
                    bool border) const {
    if (sample.triangle < 0) return sky(column, row);
    const auto patch = scene_.patch_met(sample.triangle, sample.front);
    const double value =
        patch < 0 ? std::nan("") : value_at(sample, static_cast<std::size_t>(patch));
    auto colour = is_marked(patch)       ? mark_
                  : std::isnan(value)    ? back_
                  : colours_.own.empty() ? of_value(value)
                                         : colours_.own[static_cast<std::size_t>(patch)];
    if (border) return lined(colour, border_strength);
    if (colours_.mesh == MeshLines::patches && sample.mesh_line > 0)
      return lined(colour, static_cast<double>(sample.mesh_line));
    return colour;
  }

 private:
  bool is_marked(std::int32_t patch) const {
    return patch >= 0 && !colours_.marked.empty() &&
           colours_.marked[static_cast<std::size_t>(patch)] != 0;
  }

  Colour of_value(double value) const {
    const double share = colour_share(colours_.scale, value, colours_.least, colours_.largest);
    return palette_[static_cast<std::size_t>(
        std::lround(share * static_cast<double>(palette_steps - 1)))];
  }

  double value_at(const TracedPicture::Sample& sample, std::size_t patch) const {
    if (colours_.corner_values.empty()) return colours_.values[patch];
    const auto& triangle = scene_.mesh().triangles[static_cast<std::size_t>(sample.triangle)];
    const auto u = static_cast<double>(sample.u), v = static_cast<double>(sample.v);
    const std::array<double, 3> weight{1 - u - v, u, v};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t m = 0; m < 3; ++m)  // a back has its corners in another order
        if (scene_.corners(patch)[m] == triangle[k])
          sum += weight[k] * colours_.corner_values[patch][m];
    return sum;
  }

  Colour sky(std::size_t column, std::size_t row) const {
    if (background_.kind == SkyBackground::plain || background_.sun.z <= 0) return plain_;
    const Vec3 w = camera_
                       .ray((static_cast<double>(column) + 0.5) / samples,
                            (static_cast<double>(row) + 0.5) / samples)
                       .direction;
    if (w.z < 0) return far_ground_;
    const auto c = sky_colour(
        background_.kind == SkyBackground::first ? SkyColourModel::first : SkyColourModel::second,
        w, background_.sun, picture_gain);
    return linear_light({c.red, c.green, c.blue});
  }

  const PatchScene& scene_;
  const Camera& camera_;
  const PatchColours& colours_;
  const Background& background_;
  std::vector<Colour> palette_;
  Colour plain_ = linear_light(plain_sky), far_ground_ = linear_light(far_ground),
         back_ = linear_light(no_value_colour(colours_.palette)), mark_ = linear_light(mark_colour);
};

}  // namespace

Colour linear_light(Colour c) {
  return {linear_from_srgb(c.red), linear_from_srgb(c.green), linear_from_srgb(c.blue)};
}

TracedPicture::TracedPicture(const PatchScene& scene, const RayCaster& caster, const Camera& camera,
                             int width, int height, MeshLines mesh, Backs backs)
    : scene_(scene),
      caster_(caster),
      camera_(camera),
      mesh_(mesh),
      backs_(backs),
      width_(static_cast<std::size_t>(width)),
      height_(static_cast<std::size_t>(height)),
      columns_(width_ * samples),
      rows_(height_ * samples),
      samples_(columns_ * rows_) {
  parallel_for((rows_ + tile_size - 1) / tile_size,
               [&](std::size_t k) { trace_tiles(k * tile_size); });
  parallel_for(rows_, [&](std::size_t row) {
    for (std::size_t k = row * columns_; k < (row + 1) * columns_; ++k) {
      samples_[k].border_right = k + 1 < (row + 1) * columns_ && has_border(k, k + 1);
      samples_[k].border_below = row + 1 < rows_ && has_border(k, k + columns_);
    }
  });
}

bool TracedPicture::shows_anything() const {
  return std::any_of(samples_.begin(), samples_.end(), [&](const Sample& sample) {
    return sample.triangle >= 0 && scene_.patch_met(sample.triangle, sample.front) >= 0;
  });
}

bool TracedPicture::shows(const std::vector<std::size_t>& patches) const {
  std::vector<char> is_wanted(scene_.patch_count(), 0);
  for (const auto p : patches) is_wanted[p] = 1;
  return std::any_of(samples_.begin(), samples_.end(), [&](const Sample& sample) {
    if (sample.triangle < 0) return false;
    const auto patch = scene_.patch_met(sample.triangle, sample.front);
    return patch >= 0 && is_wanted[static_cast<std::size_t>(patch)];
  });
}

/// Mean of the samples in linear light, as the eye would blur them.
std::vector<Colour> TracedPicture::pixels(const PatchColours& colours,
                                          const Background& background) const {
  SUNLOAD_EXPECT(colours.values.size() == scene_.patch_count(), "one value per patch");
  static const Encoder encoded;
  const Painter paint(scene_, camera_, colours, background);
  std::vector<Colour> result(width_ * height_);
  parallel_for(height_, [&](std::size_t y) {
    for (std::size_t x = 0; x < width_; ++x) {
      Colour sum;
      for (std::size_t row = y * samples; row < (y + 1) * samples; ++row)
        for (std::size_t column = x * samples; column < (x + 1) * samples; ++column) {
          const auto c =
              paint(samples_[row * columns_ + column], column, row, is_border(column, row));
          sum = {sum.red + c.red, sum.green + c.green, sum.blue + c.blue};
        }
      constexpr double share = 1.0 / (samples * samples);
      result[y * width_ + x] = encoded({sum.red * share, sum.green * share, sum.blue * share});
    }
  });
  return result;
}

/// Squares of rays, which meet the same triangles, along some rows.
void TracedPicture::trace_tiles(std::size_t first_row) {
  for (std::size_t first = 0; first < columns_; first += tile_size) {
    Packet origins{};
    PacketDirections directions{};
    std::array<CameraRay, packet_size> rays;
    std::uint32_t active = 0;
    for (std::size_t k = 0; k < packet_size; ++k) {
      const std::size_t column = first + k % tile_size, row = first_row + k / tile_size;
      if (column >= columns_ || row >= rows_) continue;
      active |= 1U << k;
      rays[k] = camera_.ray((static_cast<double>(column) + 0.5) / samples,
                            (static_cast<double>(row) + 0.5) / samples);
      origins.x[k] = static_cast<float>(rays[k].origin.x);
      origins.y[k] = static_cast<float>(rays[k].origin.y);
      origins.z[k] = static_cast<float>(rays[k].origin.z);
      directions.x[k] = static_cast<float>(rays[k].direction.x);
      directions.y[k] = static_cast<float>(rays[k].direction.y);
      directions.z[k] = static_cast<float>(rays[k].direction.z);
    }
    const PacketHits hits = first_hits(origins, directions, active);
    for (std::size_t k = 0; k < packet_size; ++k) {
      if (!(active >> k & 1U)) continue;
      auto& sample = samples_[(first_row + k / tile_size) * columns_ + first + k % tile_size];
      sample.triangle = hits.triangle[k];
      sample.front = hits.front[k];
      sample.u = hits.u[k];
      sample.v = hits.v[k];
      if (sample.triangle >= 0 && mesh_ == MeshLines::patches)
        sample.mesh_line = static_cast<float>(mesh_line(static_cast<std::size_t>(sample.triangle),
                                                        static_cast<double>(hits.u[k]),
                                                        static_cast<double>(hits.v[k]), rays[k]));
    }
  }
}

PacketHits TracedPicture::first_hits(const Packet& from, const PacketDirections& directions,
                                     std::uint32_t active) const {
  PacketHits hits = caster_.first_hits(from, directions, active, RayCaster::Coherence::parallel);
  Packet origins = from;
  constexpr int most_backs = 64;
  for (int passed = 0; backs_ == Backs::let_pass && passed < most_backs; ++passed) {
    std::uint32_t on = 0;
    for (std::size_t k = 0; k < packet_size; ++k) {
      if (!(active >> k & 1U) || hits.triangle[k] < 0) continue;
      if (scene_.patch_met(hits.triangle[k], hits.front[k]) >= 0) continue;
      on |= 1U << k;
      const float step = hits.distance[k] + static_cast<float>(caster_.offset_m());
      origins.x[k] += step * directions.x[k];
      origins.y[k] += step * directions.y[k];
      origins.z[k] += step * directions.z[k];
    }
    if (on == 0) break;
    const PacketHits next =
        caster_.first_hits(origins, directions, on, RayCaster::Coherence::parallel);
    for (std::size_t k = 0; k < packet_size; ++k) {
      if (!(on >> k & 1U)) continue;
      hits.triangle[k] = next.triangle[k];
      hits.u[k] = next.u[k];
      hits.v[k] = next.v[k];
      hits.distance[k] = next.distance[k];
      hits.front[k] = next.front[k];
    }
  }
  return hits;
}

/// Strength of the nearest edge's line at barycentric weights (u, v).
double TracedPicture::mesh_line(std::size_t triangle, double u, double v,
                                const CameraRay& ray) const {
  const auto& mesh = scene_.mesh();
  const Vec3 a = mesh.corner(triangle, 0), b = mesh.corner(triangle, 1),
             c = mesh.corner(triangle, 2);
  const Vec3 point = a * (1 - u - v) + b * u + c * v;
  const double pixel = camera_.pixel_size(dot(point - ray.origin, ray.direction));
  const double twice_area = norm(mesh.area_vector2(triangle));
  // Foreshortened surfaces show their heights shortened by about the cosine.
  const double cosine = std::abs(dot(mesh.area_vector2(triangle), ray.direction)) / twice_area;
  double nearest = 1e300, least_height = 1e300;
  for (const auto& [weight, from, to] :
       {std::tuple{1 - u - v, b, c}, std::tuple{u, c, a}, std::tuple{v, a, b}}) {
    const double height = twice_area / norm(to - from) * cosine / pixel;
    nearest = std::min(nearest, weight * height);
    least_height = std::min(least_height, height);
  }
  if (nearest > mesh_half_width) return 0;
  return mesh_strength * std::min(1.0, least_height / mesh_fade_pixels);
}

bool TracedPicture::has_border(std::size_t sample, std::size_t other) const {
  const auto a = samples_[sample].triangle, b = samples_[other].triangle;
  return a != b && (a < 0 || b < 0 || scene_.is_border(a, b));
}

bool TracedPicture::is_border(std::size_t column, std::size_t row) const {
  const auto* sample = &samples_[row * columns_ + column];
  if (sample->triangle < 0) return false;  // lines belong to surfaces, not to the sky
  return sample->border_right || sample->border_below || (column > 0 && sample[-1].border_right) ||
         (row > 0 && (sample - columns_)->border_below);
}

PatchScene::PatchScene(const ResultReader& result)
    : surface_(result.integers("patch_surface")),
      area_(result.doubles("patch_area")),
      normal_(vectors(result.doubles("patch_normal"))) {
  const auto material = result.integers("patch_material");
  const auto centroid = result.doubles("patch_centroid");
  mesh_.vertices = vectors(result.doubles("vertex_position"));
  const auto corners = result.integers("patch_vertices");
  const auto side = result.integers("patch_side"), object = result.integers("patch_object");
  corners_.resize(area_.size());
  for (std::size_t i = 0; i < area_.size(); ++i) {
    corners_[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
    const auto patch = static_cast<std::int32_t>(i);
    // The back of a two-sided patch follows its front and lies in its plane.
    if (side[i] == 1 && !back_.empty() && front_.back() == patch - 1) {
      back_.back() = patch;
      continue;
    }
    mesh_.triangles.push_back({corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]});
    mesh_.triangle_object.push_back({object[i]});
    const auto floats = [](double x, double y, double z) {
      return std::array{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
    };
    facets_.push_back({object[i], material[i], surface_[i],
                       floats(normal_[i].x, normal_[i].y, normal_[i].z),
                       floats(centroid[3 * i], centroid[3 * i + 1], centroid[3 * i + 2])});
    front_.push_back(patch);
    back_.push_back(-1);
  }
}

std::int32_t PatchScene::patch_met(std::int32_t triangle, bool front) const {
  return (front ? front_ : back_)[static_cast<std::size_t>(triangle)];
}

std::vector<Vec3> PatchScene::vertices_of(const std::vector<char>& is_wanted) const {
  std::vector<char> is_used(mesh_.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t)
    if (is_wanted[t])
      for (const auto vertex : mesh_.triangles[t]) is_used[static_cast<std::size_t>(vertex)] = 1;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (is_used[i]) points.push_back(mesh_.vertices[i]);
  return points;
}

std::vector<Vec3> PatchScene::focus_points() const {
  constexpr auto ground = static_cast<std::int32_t>(Surface::ground);
  std::vector<char> is_above(facets_.size()), is_building(facets_.size());
  std::map<std::int32_t, std::pair<double, double>> heights;  // of objects, without their ground
  for (std::size_t t = 0; t < facets_.size(); ++t) {
    is_above[t] = facets_[t].surface != ground ? 1 : 0;
    if (is_above[t] == 0) continue;
    auto& [low, high] = heights.try_emplace(facets_[t].object, 1e300, -1e300).first->second;
    for (const int k : {0, 1, 2}) {
      low = std::min(low, mesh_.corner(t, k).z);
      high = std::max(high, mesh_.corner(t, k).z);
    }
  }
  for (std::size_t t = 0; t < facets_.size(); ++t) {
    if (!is_above[t]) continue;
    const auto& [low, high] = heights.at(facets_[t].object);
    is_building[t] = high - low >= least_rise_m ? 1 : 0;
  }
  for (const auto& wanted : {is_building, is_above})
    if (auto points = vertices_of(wanted); !points.empty()) return points;
  return mesh_.vertices;
}

bool PatchScene::is_border(std::int32_t triangle, std::int32_t other) const {
  const auto& a = facets_[static_cast<std::size_t>(triangle)];
  const auto& b = facets_[static_cast<std::size_t>(other)];
  if (a.object != b.object || a.material != b.material || a.surface != b.surface) return true;
  static const auto fold_cosine = static_cast<float>(std::cos(radians(fold_deg)));
  const float cosine =
      a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2];
  if (cosine < fold_cosine) return true;
  // Coplanar faces may lie far apart across a bend: only parallel ones can be a step.
  constexpr float parallel_cosine = 1 - 1e-6F;
  if (cosine <= parallel_cosine) return false;
  float step = 0;
  for (std::size_t k = 0; k < 3; ++k) step += (a.centroid[k] - b.centroid[k]) * a.normal[k];
  return std::abs(step) > static_cast<float>(step_m);
}

std::vector<Colour> drawn_pixels(const PatchScene& scene, const RayCaster& caster,
                                 const Camera& camera, int width, int height,
                                 const PatchColours& colours) {
  return TracedPicture(scene, caster, camera, width, height, colours.mesh).pixels(colours, {});
}

}  // namespace sunload
