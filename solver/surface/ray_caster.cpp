// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/ray_caster.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "geo/base/check.h"
#include "geo/base/keys.h"
#include "geo/base/vector_code.h"
#include "solver/base/rng.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

// Rounding of a coordinate to float is half an ulp; an interpolated point sums
// three products, and its offset adds one more rounding: below 4 ulp in each
// axis, 7 in space. The factor 16 leaves more than twice that.
constexpr double offset_ulps = 16;
constexpr double float_ulp = 1.0 / (1 << 24);

// Ends of rays, in lengths of their directions.
constexpr float no_end = std::numeric_limits<float>::infinity(), whole_way = 1;

// Of the light along a ray. In a wood rays to low suns cross some hundred surfaces: of what five of
// leaves let pass, chance decides whether it goes on, as it does along any other ray.
constexpr float nothing = 0, faintest = 1.0f / 2048;

std::string embree_config(const std::string& isa, int threads) {
  return "threads=" + std::to_string(threads) + ",set_affinity=0,isa=" + isa;
}

bool processor_has(const std::string& isa) {
  if (isa == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512cd");
  if (isa == "avx2") return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return __builtin_cpu_supports("sse4.2");
}

/// The last error of Embree; kept by its callback, thrown after the call.
struct DeviceError {
  RTCError code = RTC_ERROR_NONE;
  std::string text;
};

void keep_error(void* user, RTCError code, const char* text) {
  auto* error = static_cast<DeviceError*>(user);
  if (error->code == RTC_ERROR_NONE) *error = {code, text ? text : ""};
}

void throw_kept(const DeviceError& error) {
  if (error.code == RTC_ERROR_NONE) return;
  if (error.text.find("pthread_create") != std::string::npos)
    throw MachineError("no more threads for the ray caster (" + error.text +
                       "): too little memory (ulimit -v), or too many threads (ulimit -u)");
  if (error.code == RTC_ERROR_OUT_OF_MEMORY)
    throw MachineError("out of memory for the ray caster: " + error.text);
  throw std::logic_error("ray caster: " + error.text);
}

double largest_coordinate(Vec3 p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

double largest_coordinate(const Mesh& mesh) {
  double largest = 0;
  for (const auto& p : mesh.vertices) largest = std::max(largest, largest_coordinate(p));
  return largest;
}

}  // namespace

double ray_offset_m(const Mesh& mesh) { return offset_ulps * float_ulp * largest_coordinate(mesh); }
double ray_offset_m(Vec3 from) { return offset_ulps * float_ulp * largest_coordinate(from); }

std::string usable_isa(const std::string& wanted) {
  if (wanted != "auto") {
    if (wanted != "sse4.2" && wanted != "avx2" && wanted != "avx512")
      throw InputError({}, "solver.isa = " + wanted, "not an instruction set of the ray caster",
                       "use auto, sse4.2, avx2 or avx512");
    if (!processor_has(wanted))
      throw InputError({}, "solver.isa = " + wanted, "this processor does not have it",
                       "use auto or a smaller one");
    return wanted;
  }
  for (const char* isa : {"avx512", "avx2", "sse4.2"})
    if (processor_has(isa)) return isa;
  throw InputError({}, "this processor is too old", "SSE4.2 is needed", "run on another machine");
}

struct RayCaster::Embree {
  Screens screens;
  DeviceError error;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Embree() {
    // After an error Embree may end the process here: of its threads some have never begun. What it
    // holds is left to the end of the process, which is near.
    if (error.code != RTC_ERROR_NONE) return;
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

/// Uniform in [0, 1), from the coordinates of ray r of N and the key of a triangle.
float passing_number(RTCRayN* ray, unsigned N, unsigned r, std::uint64_t key) {
  const auto pair = [](float a, float b) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b);
  };
  std::uint64_t hash = mixed(key, pair(RTCRayN_org_x(ray, N, r), RTCRayN_org_y(ray, N, r)));
  hash = mixed(hash, pair(RTCRayN_org_z(ray, N, r), RTCRayN_dir_x(ray, N, r)));
  hash = mixed(hash, pair(RTCRayN_dir_y(ray, N, r), RTCRayN_dir_z(ray, N, r)));
  return uniform(static_cast<std::uint32_t>(hash >> 32));
}

/// What of the light along rays passes the surfaces that they cross.
class Passage {
 public:
  struct Crossing {
    unsigned ray, triangle;
    float distance, u, v;
    bool front, at_edge;  ///< of the triangle
    float transmittance;
  };

  /// Of what is left of a ray, no more than `faint`, chance decides.
  explicit Passage(float faint) : faint_(faint) {
    share_.fill(1);
    last_.fill(none);
  }
  const RayCaster::Shares& share() const { return share_; }
  const std::vector<Crossing>& crossed() const { return crossed_; }
  /// False where chance is to decide whether that surface is crossed.
  bool cross(const Crossing& at) {
    for (auto known = last_[at.ray]; known != none; known = before_[known])
      if (is_same(crossed_[known], at)) return true;
    if (share_[at.ray] <= faint_) return false;
    before_.push_back(last_[at.ray]);
    last_[at.ray] = static_cast<std::uint32_t>(crossed_.size());
    crossed_.push_back(at);
    share_[at.ray] *= at.transmittance;
    return true;
  }

 private:
  static constexpr auto none = std::numeric_limits<std::uint32_t>::max();

  /// Of one ray. Trees of boxes hold a triangle several times, and where two triangles of a surface
  /// meet, both are hit.
  static bool is_same(const Crossing& a, const Crossing& b) {
    constexpr float roundings = 1e-6f;  // of a distance
    if (a.triangle == b.triangle) return true;
    return a.at_edge && b.at_edge && a.front == b.front &&
           std::abs(a.distance - b.distance) <= roundings * a.distance;
  }

  float faint_;
  std::vector<Crossing> crossed_;      ///< of all rays
  std::vector<std::uint32_t> before_;  ///< of each: the one of the same ray before it
  std::array<std::uint32_t, packet_size> last_;
  RayCaster::Shares share_;
};

/// What Embree hands on to `let_pass`.
struct Context {
  RTCIntersectContext embree;  ///< the first, so that its address is that of the whole
  Passage* passage;            ///< null: chance decides

  explicit Context(RayCaster::Coherence coherence, Passage* through = nullptr) : passage(through) {
    rtcInitIntersectContext(&embree);
    if (coherence == RayCaster::Coherence::parallel)
      embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
};

Passage::Crossing crossing_of(const RTCFilterFunctionNArguments* hits, unsigned r,
                              float transmittance) {
  constexpr float edge = 1e-5f;  // of barycentric weights: some hundred roundings
  const float u = RTCHitN_u(hits->hit, hits->N, r), v = RTCHitN_v(hits->hit, hits->N, r);
  const float facing = RTCHitN_Ng_x(hits->hit, hits->N, r) * RTCRayN_dir_x(hits->ray, hits->N, r) +
                       RTCHitN_Ng_y(hits->hit, hits->N, r) * RTCRayN_dir_y(hits->ray, hits->N, r) +
                       RTCHitN_Ng_z(hits->hit, hits->N, r) * RTCRayN_dir_z(hits->ray, hits->N, r);
  return {.ray = RTCRayN_id(hits->ray, hits->N, r),
          .triangle = RTCHitN_primID(hits->hit, hits->N, r),
          .distance = RTCRayN_tfar(hits->ray, hits->N, r),
          .u = u,
          .v = v,
          .front = facing < 0,
          .at_edge = std::min({u, v, 1 - u - v}) < edge,
          .transmittance = transmittance};
}

/// Embree asks it for every hit; the hits that it refuses are as if the triangle were not there.
/// What lets light pass is crossed by rays whose passage is noted, and else passed by chance.
void let_pass(const RTCFilterFunctionNArguments* hits) {
  const auto& screens = *static_cast<const Screens*>(hits->geometryUserPtr);
  Passage* passage = reinterpret_cast<const Context*>(hits->context)->passage;
  for (unsigned r = 0; r < hits->N; ++r) {
    if (hits->valid[r] == 0) continue;
    const unsigned triangle = RTCHitN_primID(hits->hit, hits->N, r);
    const float T = screens.transmittance[triangle];
    if (T <= 0) continue;
    if (T >= 1 || (passage && passage->cross(crossing_of(hits, r, T))) ||
        passing_number(hits->ray, hits->N, r, screens.key[triangle]) < T)
      hits->valid[r] = 0;
  }
}

}  // namespace

RayCaster::RayCaster(const Mesh& mesh, const std::string& isa, Screens screens)
    : embree_(std::make_unique<Embree>()), isa_(usable_isa(isa)), offset_m_(ray_offset_m(mesh)) {
  embree_->device = rtcNewDevice(embree_config(isa_, thread_count()).c_str());
  // The instruction set was checked: what is left to fail is memory for threads and tables.
  if (!embree_->device)
    throw MachineError("the ray caster cannot start: too little memory, or too many threads");
  rtcSetDeviceErrorFunction(embree_->device, keep_error, &embree_->error);
  embree_->scene = rtcNewScene(embree_->device);
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(embree_->scene, RTC_BUILD_QUALITY_HIGH);

  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                             mesh.vertices.size()));
  auto* corners = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh.triangle_count()));
  if (points && corners) {
    for (const auto& p : mesh.vertices)
      for (const double coordinate : {p.x, p.y, p.z}) *points++ = static_cast<float>(coordinate);
    for (const auto& triangle : mesh.triangles)
      for (const auto vertex : triangle) *corners++ = static_cast<unsigned>(vertex);
    if (!screens.transmittance.empty()) {
      SUNLOAD_EXPECT(screens.transmittance.size() == mesh.triangle_count() &&
                         screens.key.size() == mesh.triangle_count(),
                     "one transmittance per triangle");
      embree_->screens = std::move(screens);
      rtcSetGeometryUserData(geometry, &embree_->screens);
      rtcSetGeometryIntersectFilterFunction(geometry, let_pass);
      rtcSetGeometryOccludedFilterFunction(geometry, let_pass);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(embree_->scene, geometry, 0);
  }
  rtcReleaseGeometry(geometry);
  if (points && corners) rtcCommitScene(embree_->scene);
  throw_kept(embree_->error);
}

RayCaster::~RayCaster() = default;

PacketDirections same_for_all(Vec3 direction) {
  PacketDirections directions;
  for (std::size_t r = 0; r < packet_size; ++r) {
    directions.x[r] = static_cast<float>(direction.x);
    directions.y[r] = static_cast<float>(direction.y);
    directions.z[r] = static_cast<float>(direction.z);
  }
  return directions;
}

namespace {

Hit first_hit_in(RTCScene scene, Context& context, Vec3 origin, Vec3 direction) {
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(origin.x);
  query.ray.org_y = static_cast<float>(origin.y);
  query.ray.org_z = static_cast<float>(origin.z);
  query.ray.dir_x = static_cast<float>(direction.x);
  query.ray.dir_y = static_cast<float>(direction.y);
  query.ray.dir_z = static_cast<float>(direction.z);
  query.ray.tfar = no_end;
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const double facing = static_cast<double>(query.hit.Ng_x) * direction.x +
                        static_cast<double>(query.hit.Ng_y) * direction.y +
                        static_cast<double>(query.hit.Ng_z) * direction.z;
  return {static_cast<std::int32_t>(query.hit.primID), static_cast<double>(query.hit.u),
          static_cast<double>(query.hit.v), static_cast<double>(query.ray.tfar) * norm(direction),
          facing < 0};
}

}  // namespace

Hit RayCaster::first_hit(Vec3 origin, Vec3 direction) const {
  Context context(Coherence::none);
  return first_hit_in(embree_->scene, context, origin, direction);
}

namespace {

/// Of a ray that takes its end, and of light what is left of it there. `crossed`: all that was
/// noted on its way, in any order.
void add_takers(std::size_t ray, std::vector<Passage::Crossing> crossed, const Hit& end,
                double length_m, std::vector<RayCaster::Taker>& takers) {
  std::ranges::sort(crossed, {}, &Passage::Crossing::distance);
  double left = 1;
  for (const auto& at : crossed) {
    const double distance_m = static_cast<double>(at.distance) * length_m;
    if (!end.left_scene() && distance_m > end.distance_m) break;
    takers.push_back({{static_cast<std::int32_t>(at.triangle), static_cast<double>(at.u),
                       static_cast<double>(at.v), distance_m, at.front},
                      left * (1 - static_cast<double>(at.transmittance)),
                      ray});
    left *= static_cast<double>(at.transmittance);
  }
  if (!end.left_scene()) takers.push_back({end, left, ray});
}

PacketHits first_hits_in(RTCScene scene, Context& context, const Packet& origins,
                         const PacketDirections& directions, std::uint32_t active) {
  RTCRayHit16 query;
  alignas(64) int valid[packet_size];
  for (std::size_t r = 0; r < packet_size; ++r) {
    valid[r] = (active >> r & 1u) ? -1 : 0;
    query.ray.org_x[r] = origins.x[r];
    query.ray.org_y[r] = origins.y[r];
    query.ray.org_z[r] = origins.z[r];
    query.ray.dir_x[r] = directions.x[r];
    query.ray.dir_y[r] = directions.y[r];
    query.ray.dir_z[r] = directions.z[r];
    query.ray.tnear[r] = 0;
    query.ray.tfar[r] = no_end;
    query.ray.time[r] = 0;
    query.ray.mask[r] = ~0u;
    query.ray.id[r] = static_cast<unsigned>(r);
    query.hit.geomID[r] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect16(valid, scene, &context.embree, &query);
  PacketHits hits;
  for (std::size_t r = 0; r < packet_size; ++r) {
    const bool hit = valid[r] != 0 && query.hit.geomID[r] != RTC_INVALID_GEOMETRY_ID;
    hits.triangle[r] = hit ? static_cast<std::int32_t>(query.hit.primID[r]) : -1;
    hits.u[r] = query.hit.u[r];
    hits.v[r] = query.hit.v[r];
    hits.distance[r] = query.ray.tfar[r];
    hits.front[r] = query.hit.Ng_x[r] * directions.x[r] + query.hit.Ng_y[r] * directions.y[r] +
                        query.hit.Ng_z[r] * directions.z[r] <
                    0;
  }
  return hits;
}

}  // namespace

std::vector<RayCaster::Taker> RayCaster::takers(Vec3 origin, Vec3 direction) const {
  Passage passage(nothing);
  Context context(Coherence::none, &passage);
  const Hit end = first_hit_in(embree_->scene, context, origin, direction);
  std::vector<Taker> takers;
  add_takers(0, passage.crossed(), end, norm(direction), takers);
  return takers;
}

std::vector<RayCaster::Taker> RayCaster::takers_each(const Packet& origins,
                                                     const PacketDirections& directions,
                                                     std::uint32_t active) const {
  Passage passage(nothing);
  Context context(Coherence::parallel, &passage);
  const PacketHits ends = first_hits_in(embree_->scene, context, origins, directions, active);
  std::vector<Taker> takers;
  takers.reserve(packet_size);
  for (; active != 0; active &= active - 1) {
    const auto r = static_cast<std::size_t>(std::countr_zero(active));
    const double length_m = norm(at(directions, r));
    Hit end = ends[r];
    end.distance_m *= length_m;
    std::vector<Passage::Crossing> crossed;
    std::ranges::copy_if(passage.crossed(), std::back_inserter(crossed),
                         [&](const auto& crossing) { return crossing.ray == r; });
    add_takers(r, std::move(crossed), end, length_m, takers);
  }
  return takers;
}

PacketHits RayCaster::first_hits(const Packet& origins, const PacketDirections& directions,
                                 std::uint32_t active, Coherence coherence) const {
  Context context(coherence);
  return first_hits_in(embree_->scene, context, origins, directions, active);
}

std::uint32_t RayCaster::unoccluded(const Packet& origins, Vec3 direction,
                                    std::uint32_t active) const {
  return unoccluded_each(origins, same_for_all(direction), active);
}

std::uint32_t RayCaster::unoccluded_each(const Packet& origins, const PacketDirections& directions,
                                         std::uint32_t active) const {
  // Nearly parallel: the sun's disk is small.
  return unoccluded(origins, directions, no_end, active, Coherence::parallel);
}

std::uint32_t RayCaster::unoccluded_up_to(const Packet& origins, const PacketDirections& ways,
                                          std::uint32_t active) const {
  return unoccluded(origins, ways, whole_way, active, Coherence::none);
}

RayCaster::Shares RayCaster::passed_each(const Packet& origins, const PacketDirections& directions,
                                         std::uint32_t active) const {
  return passed(origins, directions, no_end, active, Coherence::parallel);
}

RayCaster::Shares RayCaster::passed_up_to(const Packet& origins, const PacketDirections& ways,
                                          std::uint32_t active) const {
  return passed(origins, ways, whole_way, active, Coherence::none);
}

namespace {

/// Rays that met nothing.
std::uint32_t unoccluded_rays(RTCScene scene, Context& context, const Packet& origins,
                              const PacketDirections& directions, float end, std::uint32_t active) {
  RTCRay16 ray;
  alignas(64) int valid[packet_size];
  for (std::size_t r = 0; r < packet_size; ++r) {
    valid[r] = (active >> r & 1u) ? -1 : 0;
    ray.org_x[r] = origins.x[r];
    ray.org_y[r] = origins.y[r];
    ray.org_z[r] = origins.z[r];
    ray.dir_x[r] = directions.x[r];
    ray.dir_y[r] = directions.y[r];
    ray.dir_z[r] = directions.z[r];
    ray.tnear[r] = 0;
    ray.tfar[r] = end;
    ray.time[r] = 0;
    ray.mask[r] = ~0u;
    ray.flags[r] = 0;
    ray.id[r] = static_cast<unsigned>(r);
  }
  rtcOccluded16(valid, scene, &context.embree, &ray);
  std::uint32_t seen = 0;  // Embree marks an occluded ray by a negative end
  for (std::size_t r = 0; r < packet_size; ++r)
    if (ray.tfar[r] > 0) seen |= 1u << r;
  return seen & active;
}

}  // namespace

std::uint32_t RayCaster::unoccluded(const Packet& origins, const PacketDirections& directions,
                                    float end, std::uint32_t active, Coherence coherence) const {
  Context context(coherence);
  return unoccluded_rays(embree_->scene, context, origins, directions, end, active);
}

namespace {

/// Nothing of the other rays.
SUNLOAD_VECTOR_CODE void keep(std::uint32_t rays, float* shares) {
  for (std::uint32_t r = 0; r < packet_size; ++r)
    shares[r] = (rays >> r & 1u) != 0 ? shares[r] : 0.0f;
}

}  // namespace

RayCaster::Shares RayCaster::passed(const Packet& origins, const PacketDirections& directions,
                                    float end, std::uint32_t active, Coherence coherence) const {
  Shares shares;
  if (embree_->screens.transmittance.empty()) {
    shares.fill(1);
    keep(unoccluded(origins, directions, end, active, coherence), shares.data());
    return shares;
  }
  Passage passage(faintest);
  Context context(coherence, &passage);
  const auto seen = unoccluded_rays(embree_->scene, context, origins, directions, end, active);
  shares = passage.share();
  keep(seen, shares.data());
  return shares;
}

}  // namespace sunload
