// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "geo/base/units.h"
#include "io/base/bands.h"
#include "io/base/version.h"
#include "io/batch/batch_tally.h"
#include "io/batch/file.h"
#include "io/plan/content_hash.h"
#include "io/plan/variant_mesh.h"
#include "solver/accuracy.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

/// Sums and maxima of all batches, in batch order.
class Totals {
 public:
  void add(const BatchReader& batch) {
    for (const auto& spec : batch.arrays()) {
      if (spec.rule == MergeRule::append) continue;
      auto values = batch.doubles(spec.name);
      auto [place, is_first] = arrays_.try_emplace(spec.name);
      if (is_first) {
        place->second = std::move(values);
        continue;
      }
      auto& total = place->second;
      for (std::size_t i = 0; i < total.size(); ++i)
        total[i] =
            spec.rule == MergeRule::sum ? total[i] + values[i] : std::max(total[i], values[i]);
    }
  }
  /// Where arrays are those of bands, adds their means under the names without band.
  void add_means() {
    const auto prefixes = band_prefixes(Bands::rgb);
    std::map<std::string, std::vector<double>> means;
    for (const auto& [name, values] : arrays_) {
      const BandArray array = band_array(name);
      if (array.band != 0) continue;
      auto mean = values;
      for (std::size_t i = 0; i < mean.size(); ++i) {
        for (std::size_t b = 1; b < band_count; ++b)
          mean[i] += arrays_.at(prefixes[b] + array.name)[i];
        mean[i] /= static_cast<double>(band_count);
      }
      means.emplace(array.name, std::move(mean));
    }
    arrays_.merge(means);
  }
  bool has(const std::string& name) const { return arrays_.contains(name); }
  const std::vector<double>& operator[](const std::string& name) const { return arrays_.at(name); }

 private:
  std::map<std::string, std::vector<double>> arrays_;
};

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (auto& v : values) v *= factor;
  return values;
}

/// Standard error over the rows of a [realization, n] array.
std::vector<double> errors_of(const std::vector<double>& rows, std::size_t n) {
  const std::size_t realizations = n > 0 ? rows.size() / n : 0;
  std::vector<double> errors(n), values(realizations);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t r = 0; r < realizations; ++r) values[r] = rows[r * n + i];
    errors[i] = mean_error(values).standard_error;
  }
  return errors;
}

/// Area-weighted mean over the patches of every facade, for each row of [rows, N].
std::vector<double> facade_means(const std::vector<double>& rows, const ResultGeometry& geometry) {
  const std::size_t N = geometry.patch_area.size(), F = geometry.facade_name.size();
  const std::size_t count = N > 0 ? rows.size() / N : 0;
  std::vector<double> area(F, 0), means(count * F, 0);
  for (std::size_t i = 0; i < N; ++i)
    if (geometry.patch_facade[i] >= 0)
      area[static_cast<std::size_t>(geometry.patch_facade[i])] += geometry.patch_area[i];
  for (std::size_t row = 0; row < count; ++row)
    for (std::size_t i = 0; i < N; ++i)
      if (const auto f = geometry.patch_facade[i]; f >= 0)
        means[row * F + static_cast<std::size_t>(f)] +=
            geometry.patch_area[i] * rows[row * N + i] / area[static_cast<std::size_t>(f)];
  return means;
}

constexpr double kwh_per_joule = 1 / joules_per_kwh;

/// Writes what follows from the totals of every band, side by side.
class BandWriter {
 public:
  BandWriter(ResultWriter& writer, Bands bands)
      : writer_(writer), prefixes_(band_prefixes(bands)) {}

  /// `of_band(prefix)` gives the values of one band, [rows, n].
  template <class OfBand>
  void write(const std::string& name, std::size_t rows, OfBand&& of_band) {
    std::vector<std::vector<double>> bands;
    for (const auto& prefix : prefixes_) bands.push_back(of_band(prefix));
    writer_.write({name, side_by_side(std::move(bands), rows)});
  }
  /// What is the same in all bands.
  void write_once(const std::string& name, std::vector<double> values) {
    writer_.write({name, std::move(values)});
  }
  const std::string& first() const { return prefixes_.front(); }

 private:
  ResultWriter& writer_;
  std::vector<std::string> prefixes_;
};

/// Totals of N patches or sensors; names begin with `prefix`.
void write_received(BandWriter& writer, const Totals& totals, const std::string& prefix,
                    std::size_t N, std::size_t realizations) {
  for (std::size_t p = 0; p < part_count; ++p) {
    const std::string sum = prefix + sum_name(static_cast<Part>(p));
    if (!totals.has(writer.first() + sum)) continue;
    const std::string name = static_cast<Part>(p) == Part::total
                                 ? "light_load"
                                 : std::string("light_load_") + part_names[p];
    writer.write(prefix + name, 1, [&](const std::string& band) {
      return scaled(totals[band + sum], kwh_per_joule);
    });
  }
  const auto of_realizations = [&](const std::string& band) {
    return scaled(totals[band + prefix + batch_array::exposure], kwh_per_joule);
  };
  writer.write(prefix + "light_load_realization", realizations, of_realizations);
  writer.write(prefix + "light_load_se", 1,
               [&](const std::string& band) { return errors_of(of_realizations(band), N); });
  writer.write_once(prefix + "sun_hours",
                    scaled(totals[prefix + batch_array::sunlit], 1 / seconds_per_hour));
  writer.write(prefix + "irradiance_max", 1, [&](const std::string& band) {
    return totals[band + prefix + batch_array::maximum];
  });
  writer.write_once(prefix + "sky_view_factor", totals[prefix + batch_array::sky_view]);
}

void write_loads(BandWriter& writer, const Totals& totals, const ResultGeometry& geometry,
                 std::size_t realizations) {
  const std::size_t N = geometry.patch_area.size(), F = geometry.facade_name.size();
  write_received(writer, totals, "", N, realizations);
  if (totals.has(batch_array::patch_lines))
    writer.write_once(batch_array::patch_lines, totals[batch_array::patch_lines]);
  writer.write("power_load", 1, [&](const std::string& band) {
    return scaled(totals[band + batch_array::outgoing], kwh_per_joule);
  });
  if (const std::size_t S = geometry.sensor_position.size(); S > 0)
    write_received(writer, totals, sensor_prefix, S, realizations);
  if (F == 0) return;
  const auto of_facades = [&](const std::string& band) {
    return facade_means(scaled(totals[band + batch_array::exposure], kwh_per_joule), geometry);
  };
  writer.write("facade_light_load_realization", realizations, of_facades);
  writer.write("facade_light_load_se", 1,
               [&](const std::string& band) { return errors_of(of_facades(band), F); });
  writer.write("facade_light_load", 1, [&](const std::string& band) {
    return facade_means(scaled(totals[band + sum_name(Part::total)], kwh_per_joule), geometry);
  });
}

void write_ledger_errors(BandWriter& writer, const Totals& totals) {
  for (std::size_t t = 0; t <= term_count; ++t) {
    const std::string term = t < term_count ? term_names[t] : "residual";
    writer.write("power_" + term + "_se", 1, [&](const std::string& band) {
      const auto rows = scaled(totals[band + batch_array::ledger], kwh_per_joule);
      return std::vector{errors_of(rows, term_count + 1)[t]};
    });
  }
}

/// Largest relative difference that the lines' reuse makes, as a share of the
/// scene's energy: (mean over realizations - pooled) / (R - 1) (docs/developer/method.md,
/// Gathering).
double reuse_bias(const Totals& totals, const ResultGeometry& geometry, std::size_t realizations) {
  const auto& pooled = totals[sum_name(Part::total)];
  const auto& rows = totals[batch_array::exposure];
  const std::size_t N = pooled.size();
  double of_pooled = 0, of_rows = 0;
  for (std::size_t i = 0; i < N; ++i) {
    of_pooled += geometry.patch_area[i] * pooled[i];
    for (std::size_t r = 0; r < realizations; ++r)
      of_rows += geometry.patch_area[i] * rows[r * N + i] / static_cast<double>(realizations);
  }
  if (of_pooled <= 0 || realizations < 2) return 0;
  return (of_rows - of_pooled) / of_pooled / static_cast<double>(realizations - 1);
}

/// The part of the pooled ledger's residual that the lines' reuse makes [kWh]:
/// a patch that sees more sky sends more, and by the same lines more of it is
/// seen to escape. It falls as 1/lines, so that realizations show R times of it.
double residual_reuse_bias_kwh(const Totals& totals, std::size_t realizations) {
  const auto& rows = totals[batch_array::ledger];
  double of_rows = 0;
  for (std::size_t r = 0; r < realizations; ++r)
    of_rows += rows[r * (term_count + 1) + term_count] / static_cast<double>(realizations);
  const double of_pooled = totals[batch_array::energy][1];
  return (of_rows - of_pooled) / static_cast<double>(realizations - 1) * kwh_per_joule;
}

/// Sensors of which more than half the lines meet backs see a body from within.
std::string buried_sensors(const Totals& totals, const ResultGeometry& geometry) {
  if (!totals.has(batch_array::sensor_backs)) return {};
  const auto& backs = totals[batch_array::sensor_backs];
  std::size_t count = 0, first = 0;
  for (std::size_t s = backs.size(); s-- > 0;)
    if (backs[s] > 0.5) {
      ++count;
      first = s;
    }
  if (count == 0) return {};
  const Vec3 at = geometry.sensor_position[first] + geometry.origin;
  return fmt::format(
      "{} of {} sensors see mostly backs of surfaces, from where no light comes, the first of them "
      "sensor {} at ({:.10g}, {:.10g}, {:.10g}); they lie within bodies or look into them",
      count, backs.size(), first, at.x, at.y, at.z);
}

/// Faults of the model that only the light brings out.
std::vector<std::string> result_warnings(const Totals& totals, const ResultGeometry& geometry) {
  // Light lost at backs is worth a warning above this share (docs/developer/design.md, Study).
  constexpr double tolerable = 1e-3;
  std::vector<std::string> warnings;
  const auto& energy = totals[batch_array::energy];
  const double share = energy[0] > 0 ? energy[2] / energy[0] : 0;
  if (share > tolerable)
    warnings.push_back(fmt::format(
        "{:.2g} % of the energy is lost at backs of one-sided surfaces; turn or close these "
        "surfaces, or make them two-sided (sides: two)",
        100 * share));
  if (auto buried = buried_sensors(totals, geometry); !buried.empty())
    warnings.push_back(std::move(buried));
  return warnings;
}

/// Share of the leaf area that counts whose error is as small as the study asks for.
double accuracy_share(const Totals& totals, const ResultGeometry& geometry, double relative) {
  const auto& load = totals[sum_name(Part::total)];
  const auto se = errors_of(totals[batch_array::exposure], load.size());
  const double largest = load.empty() ? 0 : *std::max_element(load.begin(), load.end());
  double counts = 0, met = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (load[i] <= 0 || load[i] < share_that_counts * largest) continue;
    counts += geometry.patch_area[i];
    if (se[i] <= relative * load[i]) met += geometry.patch_area[i];
  }
  return counts > 0 ? met / counts : 1;
}

ResultTimes result_times(const LightSeries& light, Quantity quantity) {
  ResultTimes times;
  for (const auto& i : light.intervals) {
    times.time.push_back(i.when.sun_time);
    times.bounds.push_back({i.when.begin, i.when.end});
    times.sun_azimuth_deg.push_back(i.when.sun.azimuth_deg);
    times.sun_elevation_deg.push_back(i.when.sun.elevation_deg);
    times.sun_direction.push_back(i.when.direction);
    times.dni.push_back(i.mean.dni);
    times.dhi.push_back(i.mean.dhi);
    times.ghi.push_back(i.mean.ghi);
    if (quantity == Quantity::irradiance) continue;
    const Irradiance lux = source_means(i, quantity);
    times.direct_illuminance.push_back(lux.dni);
    times.diffuse_illuminance.push_back(lux.dhi);
    times.global_illuminance.push_back(lux.ghi);
  }
  return times;
}

ResultAttributes result_attributes(const VariantPlan& plan, const StudyFile& file,
                                   const Totals& totals, const ResultGeometry& geometry) {
  const Study& study = plan.study;
  const WorkDone work = work_from(totals[batch_array::work]);
  const auto R = static_cast<std::size_t>(study.solver.realizations);
  const auto& counts = totals[batch_array::counts];
  const auto lines = std::llround(counts[0]);
  const auto samples = static_cast<std::int64_t>(counts[1]);
  ResultAttributes a;
  a.text = {{"title", "Light load: " + study.name + ", variant " + study.variant},
            {"source", std::string("sunload ") + version + " (" + commit + ")"},
            {"history", iso_utc(now()) + " sunload run " + fs::path(file.path).filename().string()},
            {"study", study.name},
            {"variant", study.variant},
            {"study_sha256", plan.content_hash},
            {"pairing_id", plan.pairing_id},
            {"isa", plan.isa},
            {"transport", study.solver.transport == Transport::shoot ? "shoot" : "gather"},
            {"timezone", study.site.timezone},
            {"site_source", plan.built.site_source},
            {"sun_sampling", std::holds_alternative<InstantsPeriod>(study.period.kind)
                                 ? "sun at the given instant"
                                 : "sun at the middle of the sunlit part of the interval"}};
  if (!plan.built.crs.empty()) a.text.emplace_back("crs", plan.built.crs);
  a.numbers = {{"latitude_deg", plan.built.site.latitude_deg},
               {"longitude_deg", plan.built.site.longitude_deg},
               {"elevation_m", plan.built.site.elevation_m},
               {"north_deg", plan.built.site.north_deg},
               {"reuse_bias_share", reuse_bias(totals, geometry, R)},
               {unit_names("residual_reuse_bias_kwh", study.light.quantity),
                residual_reuse_bias_kwh(totals, R)},
               {"runtime_lines_s", work.lines_s},
               {"runtime_direct_s", work.direct_s},
               {"runtime_mirror_s", work.mirror_s},
               {"runtime_solve_s", work.solve_s},
               {"runtime_realizations_s", work.realizations_s},
               {"runtime_sensors_s", work.sensors_s}};
  a.integers = {{"seed", static_cast<std::int64_t>(study.solver.seed)},
                {"realizations", study.solver.realizations},
                {"lines_per_patch", lines},
                {"direct_samples", samples},
                {"bounces", static_cast<std::int64_t>(totals[batch_array::bounces][0])},
                {"numerics_version", numerics_version},
                {"line_rays", static_cast<std::int64_t>(work.line_rays)},
                {"direct_rays", static_cast<std::int64_t>(work.direct_rays)},
                {"mirror_rays", static_cast<std::int64_t>(work.mirror_rays)},
                {"mirror_beams", static_cast<std::int64_t>(work.mirror_beams)},
                {"mirror_shots", static_cast<std::int64_t>(work.mirror_shots)},
                {"sensor_rays", static_cast<std::int64_t>(work.sensor_rays)}};
  if (study.solver.transport == Transport::shoot) {
    a.numbers.emplace_back("runtime_shoot_s", work.shoot_s);
    a.integers.emplace_back("samples_shot", static_cast<std::int64_t>(work.samples));
    a.integers.emplace_back("shot_rays", static_cast<std::int64_t>(work.shot_rays));
  }
  if (study.solver.accuracy) {
    if (const auto relative = study.solver.accuracy->light_load_relative) {
      a.numbers.emplace_back("accuracy_light_load_relative", *relative);
      a.numbers.emplace_back("accuracy_area_share", accuracy_share(totals, geometry, *relative));
    }
    if (const auto relative = study.solver.accuracy->irradiance_relative)
      a.numbers.emplace_back("accuracy_irradiance_relative", *relative);
    if (totals.has(batch_array::kept_area)) {
      const auto& area = totals[batch_array::kept_area];
      a.numbers.emplace_back("accuracy_irradiance_share", area[0] > 0 ? area[1] / area[0] : 1);
    }
    if (counts.size() > 2) a.numbers.emplace_back("samples_per_patch", counts[2]);
  }
  if (study.solver.bands == Bands::rgb) {
    a.text.emplace_back("bands", "rgb");
    a.text.emplace_back("light_colour", study.light.colour == LightColour::white ? "white" : "sky");
  }
  std::string weather;
  for (const auto& line : plan.light.weather) weather += line + "\n";
  if (!weather.empty()) a.text.emplace_back("weather", weather);
  std::string warnings;
  for (const auto& list : {file.warnings, plan.built.warnings, plan.light.notes})
    for (const auto& line : list) warnings += line + "\n";
  for (const auto& line : result_warnings(totals, geometry)) warnings += line + "\n";
  if (!warnings.empty()) a.text.emplace_back("warnings", warnings);
  return a;
}

/// Series of the batch files that the study does not want in its result.
std::vector<std::string> unwanted_series(const OutputStudy& output) {
  std::vector<std::string> unwanted;
  for (std::size_t p = 0; p < part_count; ++p)
    if (std::find(output.series.begin(), output.series.end(), part_names[p]) == output.series.end())
      for (const auto& prefix : {std::string(), sensor_prefix})
        unwanted.push_back(prefix + series_name(static_cast<Part>(p)));
  return unwanted;
}

}  // namespace

ResultGeometry result_geometry(const VariantPlan& plan, const Hierarchy& hierarchy) {
  const Scene& scene = plan.built.scene;
  const Mesh& mesh = scene.mesh;
  ResultGeometry g;
  g.vertices = hierarchy.vertices();
  for (std::size_t i = 0; i < hierarchy.patch_count(); ++i) {
    const Patch& patch = hierarchy.patches()[i];
    const auto t = static_cast<std::size_t>(patch.triangle);
    g.patch_vertices.push_back(patch.vertices);
    g.patch_area.push_back(hierarchy.area()[i]);
    g.patch_centroid.push_back(hierarchy.centroid(i));
    g.patch_normal.push_back(hierarchy.normal(i));
    g.patch_object.push_back(mesh.triangle_object[t].value);
    g.patch_facade.push_back(patch.side == 0 ? mesh.triangle_facade[t].value : -1);
    g.patch_material.push_back(scene.material[t].value);
    g.patch_input_triangle.push_back(patch.triangle);
    g.patch_surface.push_back(static_cast<std::uint8_t>(mesh.triangle_surface[t]));
    g.patch_side.push_back(patch.side);
  }
  g.input_triangle_vertices = mesh.triangles;
  g.object_name = mesh.object_names;
  for (const auto& m : scene.materials) g.material_name.push_back(m.name);
  for (const auto& f : mesh.facades) {
    g.facade_name.push_back(f.name);
    g.facade_area.push_back(f.area_m2);
    g.facade_azimuth_deg.push_back(wrapped_deg(f.azimuth_deg + plan.built.site.north_deg));
  }
  for (const auto& sensor : scene.sensors) {
    g.sensor_position.push_back(sensor.position);
    g.sensor_normal.push_back(sensor.normal);
  }
  g.origin = mesh.origin;
  return g;
}

MissingBatches missing_batches(const std::string& folder, const VariantPlan& plan) {
  MissingBatches missing;
  for (std::size_t b = 0; b < plan.batches(); ++b) {
    const auto check = check_batch(batch_path(folder, plan, b), plan.content_hash, b);
    if (check.valid) continue;
    missing.numbers.push_back(b);
    if (check.exists) missing.reasons.push_back(check.reason);
  }
  return missing;
}

std::vector<std::size_t> batches_not_there(const std::string& folder, const VariantPlan& plan) {
  std::vector<std::size_t> missing;
  for (std::size_t b = 0; b < plan.batches(); ++b)
    if (!fs::exists(batch_path(folder, plan, b))) missing.push_back(b);
  return missing;
}

std::vector<std::string> merge_variant(const std::string& folder, const VariantPlan& plan,
                                       const StudyFile& file, const Hierarchy& hierarchy,
                                       const std::string& path,
                                       const std::vector<std::size_t>& left_out) {
  const ResultGeometry geometry = result_geometry(plan, hierarchy);
  ResultWriter::Options options;
  options.chunk_intervals = plan.batch_suns();
  options.compression = plan.study.output.compression;
  options.realizations = static_cast<std::size_t>(plan.study.solver.realizations);
  options.times_are_synthetic = plan.light.times_are_synthetic;
  options.left_out = unwanted_series(plan.study.output);
  options.quantity = plan.study.light.quantity;
  options.bands = plan.study.solver.bands;
  ResultWriter writer(path, geometry, result_times(plan.light, options.quantity), options);
  Totals totals;
  for (std::size_t b = 0; b < plan.batches(); ++b) {
    if (std::find(left_out.begin(), left_out.end(), b) != left_out.end()) continue;
    const BatchReader batch(batch_path(folder, plan, b));
    writer.append(batch);
    totals.add(batch);
  }
  totals.add_means();
  BandWriter band_writer(writer, options.bands);
  write_loads(band_writer, totals, geometry, options.realizations);
  write_ledger_errors(band_writer, totals);
  writer.finish(result_attributes(plan, file, totals, geometry), file.yaml);
  return result_warnings(totals, geometry);
}

}  // namespace sunload
