// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/schema.h"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

namespace sunload {
namespace {

using h5::Type;
using enum ResultPart;

constexpr std::string_view w_m2 = "W m-2", kwh_m2 = "kWh m-2", interval_mean = "time: mean";
constexpr std::string_view kwh_m4 = "kWh m-4";
constexpr std::string_view facade_mean = "time: mean area: mean";

constexpr auto float32 = Type::float32;
constexpr auto float64 = Type::float64;
constexpr auto int32 = Type::int32;
constexpr auto flags = Type::int8;
constexpr auto text = Type::text;

// clang-format off
constexpr std::array table{
    // Times and sun: one row per interval.
    ResultVariable{"time", "time", float64, time_units, coordinate, "instant of the sun that stands for the interval", "time"},
    ResultVariable{"time_bounds", "time,bounds", float64, time_units, coordinate, "begin and end of the interval"},
    ResultVariable{"sun_azimuth", "time", float64, "degree", sun, "azimuth of the sun, clockwise from true north", "solar_azimuth_angle", "time: point"},
    ResultVariable{"sun_elevation", "time", float64, "degree", sun, "apparent elevation of the sun above the horizon", "solar_elevation_angle", "time: point"},
    ResultVariable{"sun_direction", "time,xyz", float64, "1", sun, "unit vector to the sun in the scene frame", "", "time: point"},
    ResultVariable{"dni", "time", float64, w_m2, sun, "direct normal irradiance", "surface_direct_along_beam_shortwave_flux_in_air", interval_mean},
    ResultVariable{"dhi", "time", float64, w_m2, sun, "diffuse horizontal irradiance", "surface_diffuse_downwelling_shortwave_flux_in_air", interval_mean},
    ResultVariable{"ghi", "time", float64, w_m2, sun, "global horizontal irradiance", "surface_downwelling_shortwave_flux_in_air", interval_mean},
    ResultVariable{"direct_normal_illuminance", "time", float64, "lx", sun, "direct normal illuminance (light.quantity: illuminance)", "", interval_mean},
    ResultVariable{"diffuse_horizontal_illuminance", "time", float64, "lx", sun, "diffuse horizontal illuminance (light.quantity: illuminance)", "", interval_mean},
    ResultVariable{"global_horizontal_illuminance", "time", float64, "lx", sun, "global horizontal illuminance (light.quantity: illuminance)", "", interval_mean},

    ResultVariable{"study_seasons", "time", int32, "", sun, "seasons of the study that hold in the interval, a bit each (seasons)"},

    ResultVariable{"band", "band", text, "", coordinate, "band of the light: red, green, blue (solver.bands: rgb)"},
    ResultVariable{"object", "object", text, "", coordinate, "name of the object, as label of its dimension"},
    ResultVariable{"facade", "facade", text, "", coordinate, "name of the facade, as label of its dimension"},
    ResultVariable{"selection", "selection", text, "", coordinate, "name of the selection, as label of its dimension"},
    ResultVariable{"material", "material", text, "", coordinate, "name of the material, as label of its dimension"},

    // Mesh: patches are the leaves of the frozen hierarchy.
    ResultVariable{"vertex_position", "vertex,xyz", float64, "m", coordinate, "position in the scene frame, relative to the attribute origin"},
    ResultVariable{"vertex_x", "vertex", float64, "m", coordinate, "x of vertex_position, as UGRID wants node coordinates"},
    ResultVariable{"vertex_y", "vertex", float64, "m", coordinate, "y of vertex_position"},
    ResultVariable{"vertex_z", "vertex", float64, "m", coordinate, "z of vertex_position"},
    ResultVariable{"mesh", "", int32, "", geometry, "topology of the patches"},
    ResultVariable{"patch_vertices", "patch,corner", int32, "", geometry, "vertices of the patch, counter-clockwise seen from its front"},
    ResultVariable{"patch_area", "patch", float64, "m2", geometry, "area"},
    ResultVariable{"patch_centroid", "patch,xyz", float64, "m", geometry, "centroid in the scene frame"},
    ResultVariable{"patch_normal", "patch,xyz", float64, "1", geometry, "unit normal of the side that the values belong to"},
    ResultVariable{"patch_object", "patch", int32, "", geometry, "index into object_name"},
    ResultVariable{"patch_facade", "patch", int32, "", geometry, "index into facade_name, -1: none"},
    ResultVariable{"patch_material", "patch", int32, "", geometry, "index into material_name, -1: none"},
    ResultVariable{"patch_surface", "patch", flags, "", geometry, "kind of surface"},
    ResultVariable{"patch_side", "patch", flags, "", geometry, "side of a two-sided surface"},
    ResultVariable{"patch_input_triangle", "patch", int32, "", geometry, "index of the input triangle that the patch is part of"},
    ResultVariable{"input_triangle_vertices", "input_triangle,corner", int32, "", geometry, "vertices of the triangle before refinement"},
    ResultVariable{"object_name", "object", text, "", geometry, "name of the object"},
    ResultVariable{"facade_name", "facade", text, "", geometry, "name of the facade"},
    ResultVariable{"material_name", "material", text, "", geometry, "name of the material"},
    ResultVariable{"facade_area", "facade", float64, "m2", geometry, "area"},
    ResultVariable{"facade_azimuth", "facade", float64, "degree", geometry, "azimuth of the outward normal, clockwise from true north"},
    ResultVariable{"selection_name", "selection", text, "", geometry, "name of the selection"},
    ResultVariable{"selection_area", "selection", float64, "m2", geometry, "area"},
    ResultVariable{"patch_selected", "selection,patch", flags, "", geometry, "1 where the patch is of the selection"},

    // Series: what falls on a patch, mean over the interval.
    ResultVariable{"irradiance", "time,patch", float32, w_m2, series, "incident irradiance, all light", "", interval_mean},
    ResultVariable{"irradiance_direct", "time,patch", float32, w_m2, series, "irradiance straight from the sun", "", interval_mean},
    ResultVariable{"irradiance_sky", "time,patch", float32, w_m2, series, "irradiance straight from the sky", "", interval_mean},
    ResultVariable{"irradiance_mirror", "time,patch", float32, w_m2, series, "irradiance from sun and sky by way of mirrors only", "", interval_mean},
    ResultVariable{"irradiance_lamps", "time,patch", float32, w_m2, series, "irradiance from emitters, luminaires and parallel sources, straight or by mirrors", "", interval_mean},
    ResultVariable{"irradiance_reflected", "time,patch", float32, w_m2, series, "irradiance after a diffuse reflection, and from the far ground", "", interval_mean},
    ResultVariable{"irradiance_se", "time,patch", float32, w_m2, series, "standard error of irradiance", "", interval_mean},
    ResultVariable{"facade_irradiance", "time,facade", float32, w_m2, series, "incident irradiance, mean over the facade", "", facade_mean},

    // Totals of the whole period.
    ResultVariable{"light_load", "patch", float64, kwh_m2, total, "incident energy per area over the period"},
    ResultVariable{"light_load_direct", "patch", float64, kwh_m2, total, "light load straight from the sun"},
    ResultVariable{"light_load_sky", "patch", float64, kwh_m2, total, "light load straight from the sky"},
    ResultVariable{"light_load_mirror", "patch", float64, kwh_m2, total, "light load from sun and sky by way of mirrors only"},
    ResultVariable{"light_load_lamps", "patch", float64, kwh_m2, total, "light load from emitters and parallel sources"},
    ResultVariable{"light_load_reflected", "patch", float64, kwh_m2, total, "light load after a diffuse reflection, and from the far ground"},
    ResultVariable{"light_load_se", "patch", float64, kwh_m2, total, "standard error of light_load"},
    ResultVariable{"light_load_direct_se", "patch", float64, kwh_m2, total, "standard error of light_load_direct"},
    ResultVariable{"light_load_sky_se", "patch", float64, kwh_m2, total, "standard error of light_load_sky"},
    ResultVariable{"light_load_mirror_se", "patch", float64, kwh_m2, total, "standard error of light_load_mirror"},
    ResultVariable{"light_load_lamps_se", "patch", float64, kwh_m2, total, "standard error of light_load_lamps"},
    ResultVariable{"light_load_reflected_se", "patch", float64, kwh_m2, total, "standard error of light_load_reflected"},
    ResultVariable{"light_load_realization", "realization,patch", float64, kwh_m2, total, "light load of each realization"},
    ResultVariable{"sun_hours", "patch", float64, "h", total, "time in the sun, regardless of weather"},
    ResultVariable{"irradiance_max", "patch", float64, w_m2, total, "largest irradiance of the series", "", "time: maximum"},
    ResultVariable{"irradiance_max_of_mean", "patch", float64, w_m2, total, "largest irradiance of the bands' mean, of light in bands", "", "time: maximum"},
    ResultVariable{"sky_view_factor", "patch", float64, "1", total, "cosine-weighted share of the hemisphere that is sky"},
    ResultVariable{"sky_view_factor_se", "patch", float64, "1", total, "standard error of sky_view_factor"},
    ResultVariable{"patch_lines", "patch", float64, "1", total, "lines that the patch cast, over all realizations"},
    ResultVariable{"power_load", "patch", float64, kwh_m2, total, "outgoing diffuse energy per area: reflected and emitted"},
    ResultVariable{"diffuse_reflectance", "patch", float64, "1", total, "share of incident light that is reflected diffusely; not where seasons change it"},
    ResultVariable{"emitted_exitance", "patch", float64, w_m2, total, "diffuse light that emitters send of their own, where there are any"},
    ResultVariable{"facade_light_load", "facade", float64, kwh_m2, total, "light load, mean over the facade", "", "area: mean"},
    ResultVariable{"facade_light_load_se", "facade", float64, kwh_m2, total, "standard error of facade_light_load"},
    ResultVariable{"facade_light_load_realization", "realization,facade", float64, kwh_m2, total, "light load of the facade in each realization", "", "area: mean"},
    ResultVariable{"selection_light_load", "selection", float64, kwh_m2, total, "light load, mean over the selection", "", "area: mean"},
    ResultVariable{"selection_light_load_se", "selection", float64, kwh_m2, total, "standard error of selection_light_load"},
    ResultVariable{"selection_light_load_realization", "realization,selection", float64, kwh_m2, total, "light load of the selection in each realization", "", "area: mean"},

    // Sensors: points that receive, where the study has any.
    ResultVariable{"sensor_position", "sensor,xyz", float64, "m", geometry, "position of the sensor in the scene frame, relative to the attribute origin"},
    ResultVariable{"sensor_normal", "sensor,xyz", float64, "1", geometry, "unit normal of the sensor: it receives from the hemisphere about it"},
    ResultVariable{"sensor_irradiance", "time,sensor", float32, w_m2, series, "incident irradiance of the sensor, all light", "", interval_mean},
    ResultVariable{"sensor_irradiance_direct", "time,sensor", float32, w_m2, series, "irradiance of the sensor straight from the sun", "", interval_mean},
    ResultVariable{"sensor_irradiance_sky", "time,sensor", float32, w_m2, series, "irradiance of the sensor straight from the sky", "", interval_mean},
    ResultVariable{"sensor_irradiance_mirror", "time,sensor", float32, w_m2, series, "irradiance of the sensor from sun and sky by way of mirrors only", "", interval_mean},
    ResultVariable{"sensor_irradiance_lamps", "time,sensor", float32, w_m2, series, "irradiance of the sensor from emitters, luminaires and parallel sources, straight or by mirrors (luminaires: by one; parallel sources: straight)", "", interval_mean},
    ResultVariable{"sensor_irradiance_reflected", "time,sensor", float32, w_m2, series, "irradiance of the sensor after a diffuse reflection, and from the far ground", "", interval_mean},
    ResultVariable{"sensor_irradiance_se", "time,sensor", float32, w_m2, series, "standard error of sensor_irradiance", "", interval_mean},
    ResultVariable{"sensor_light_load", "sensor", float64, kwh_m2, total, "incident energy per area of the sensor over the period"},
    ResultVariable{"sensor_light_load_direct", "sensor", float64, kwh_m2, total, "light load of the sensor straight from the sun"},
    ResultVariable{"sensor_light_load_sky", "sensor", float64, kwh_m2, total, "light load of the sensor straight from the sky"},
    ResultVariable{"sensor_light_load_mirror", "sensor", float64, kwh_m2, total, "light load of the sensor from sun and sky by way of mirrors only"},
    ResultVariable{"sensor_light_load_lamps", "sensor", float64, kwh_m2, total, "light load of the sensor from emitters and parallel sources"},
    ResultVariable{"sensor_light_load_reflected", "sensor", float64, kwh_m2, total, "light load of the sensor after a diffuse reflection, and from the far ground"},
    ResultVariable{"sensor_light_load_se", "sensor", float64, kwh_m2, total, "standard error of sensor_light_load"},
    ResultVariable{"sensor_light_load_direct_se", "sensor", float64, kwh_m2, total, "standard error of sensor_light_load_direct"},
    ResultVariable{"sensor_light_load_sky_se", "sensor", float64, kwh_m2, total, "standard error of sensor_light_load_sky"},
    ResultVariable{"sensor_light_load_mirror_se", "sensor", float64, kwh_m2, total, "standard error of sensor_light_load_mirror"},
    ResultVariable{"sensor_light_load_lamps_se", "sensor", float64, kwh_m2, total, "standard error of sensor_light_load_lamps"},
    ResultVariable{"sensor_light_load_reflected_se", "sensor", float64, kwh_m2, total, "standard error of sensor_light_load_reflected"},
    ResultVariable{"sensor_light_load_realization", "realization,sensor", float64, kwh_m2, total, "light load of the sensor in each realization"},
    ResultVariable{"sensor_sun_hours", "sensor", float64, "h", total, "time of the sensor in the sun, regardless of weather"},
    ResultVariable{"sensor_irradiance_max", "sensor", float64, w_m2, total, "largest irradiance of the sensor's series", "", "time: maximum"},
    ResultVariable{"sensor_irradiance_max_of_mean", "sensor", float64, w_m2, total, "largest irradiance of the bands' mean", "", "time: maximum"},
    ResultVariable{"sensor_sky_view_factor", "sensor", float64, "1", total, "cosine-weighted share of the sensor's hemisphere that is sky"},
    ResultVariable{"sensor_sky_view_factor_se", "sensor", float64, "1", total, "standard error of sensor_sky_view_factor"},

    // Totals of parts of the period.
    ResultVariable{"month", "month", text, "", division, "month of the site's civil time, as 2026-06"},
    ResultVariable{"month_bounds", "month,bounds", float64, time_units, division, "begin and end of the month in the calendar"},
    ResultVariable{"month_duration", "month", float64, "h", division, "time of the period in the month"},
    ResultVariable{"light_load_by_month", "month,patch", float32, kwh_m2, total, "light load of the month"},
    ResultVariable{"light_load_direct_by_month", "month,patch", float32, kwh_m2, total, "light load of the month straight from the sun"},
    ResultVariable{"light_load_by_month_se", "month,patch", float32, kwh_m2, total, "standard error of light_load_by_month"},
    ResultVariable{"light_load_by_month_realization", "month,realization,patch", float32, kwh_m2, total, "light load of the month in each realization"},
    ResultVariable{"sun_hours_by_month", "month,patch", float32, "h", total, "time of the month in the sun, regardless of weather"},
    ResultVariable{"facade_light_load_by_month", "month,facade", float32, kwh_m2, total, "light load of the month, mean over the facade", "", "area: mean"},
    ResultVariable{"facade_light_load_by_month_se", "month,facade", float32, kwh_m2, total, "standard error of facade_light_load_by_month"},
    ResultVariable{"facade_light_load_by_month_realization", "month,realization,facade", float32, kwh_m2, total, "light load of the facade in the month in each realization", "", "area: mean"},
    ResultVariable{"sensor_light_load_by_month", "month,sensor", float32, kwh_m2, total, "light load of the sensor in the month"},
    ResultVariable{"sensor_light_load_direct_by_month", "month,sensor", float32, kwh_m2, total, "light load of the sensor in the month straight from the sun"},
    ResultVariable{"sensor_light_load_by_month_se", "month,sensor", float32, kwh_m2, total, "standard error of sensor_light_load_by_month"},
    ResultVariable{"sensor_light_load_by_month_realization", "month,realization,sensor", float32, kwh_m2, total, "light load of the sensor in the month in each realization"},
    ResultVariable{"sensor_sun_hours_by_month", "month,sensor", float32, "h", total, "time of the sensor in the sun in the month, regardless of weather"},
    ResultVariable{"season", "season", text, "", division, "season: spring, summer, autumn, winter (December to February; June to August south of the equator), of all years together"},
    ResultVariable{"season_duration", "season", float64, "h", division, "time of the period in the season"},
    ResultVariable{"light_load_by_season", "season,patch", float32, kwh_m2, total, "light load of the season"},
    ResultVariable{"light_load_direct_by_season", "season,patch", float32, kwh_m2, total, "light load of the season straight from the sun"},
    ResultVariable{"light_load_by_season_se", "season,patch", float32, kwh_m2, total, "standard error of light_load_by_season"},
    ResultVariable{"light_load_by_season_realization", "season,realization,patch", float32, kwh_m2, total, "light load of the season in each realization"},
    ResultVariable{"sun_hours_by_season", "season,patch", float32, "h", total, "time of the season in the sun, regardless of weather"},
    ResultVariable{"facade_light_load_by_season", "season,facade", float32, kwh_m2, total, "light load of the season, mean over the facade", "", "area: mean"},
    ResultVariable{"facade_light_load_by_season_se", "season,facade", float32, kwh_m2, total, "standard error of facade_light_load_by_season"},
    ResultVariable{"facade_light_load_by_season_realization", "season,realization,facade", float32, kwh_m2, total, "light load of the facade in the season in each realization", "", "area: mean"},
    ResultVariable{"sensor_light_load_by_season", "season,sensor", float32, kwh_m2, total, "light load of the sensor in the season"},
    ResultVariable{"sensor_light_load_direct_by_season", "season,sensor", float32, kwh_m2, total, "light load of the sensor in the season straight from the sun"},
    ResultVariable{"sensor_light_load_by_season_se", "season,sensor", float32, kwh_m2, total, "standard error of sensor_light_load_by_season"},
    ResultVariable{"sensor_light_load_by_season_realization", "season,realization,sensor", float32, kwh_m2, total, "light load of the sensor in the season in each realization"},
    ResultVariable{"sensor_sun_hours_by_season", "season,sensor", float32, "h", total, "time of the sensor in the sun in the season, regardless of weather"},
    ResultVariable{"day", "day", text, "", division, "day of the site's civil time, as 2026-06-21"},
    ResultVariable{"day_bounds", "day,bounds", float64, time_units, division, "begin and end of the day in the calendar"},
    ResultVariable{"day_duration", "day", float64, "h", division, "time of the period in the day"},
    ResultVariable{"light_load_by_day", "day,patch", float32, kwh_m2, total, "light load of the day"},
    ResultVariable{"light_load_direct_by_day", "day,patch", float32, kwh_m2, total, "light load of the day straight from the sun"},
    ResultVariable{"light_load_by_day_se", "day,patch", float32, kwh_m2, total, "standard error of light_load_by_day"},
    ResultVariable{"light_load_by_day_realization", "day,realization,patch", float32, kwh_m2, total, "light load of the day in each realization"},
    ResultVariable{"sun_hours_by_day", "day,patch", float32, "h", total, "time of the day in the sun, regardless of weather"},
    ResultVariable{"facade_light_load_by_day", "day,facade", float32, kwh_m2, total, "light load of the day, mean over the facade", "", "area: mean"},
    ResultVariable{"facade_light_load_by_day_se", "day,facade", float32, kwh_m2, total, "standard error of facade_light_load_by_day"},
    ResultVariable{"facade_light_load_by_day_realization", "day,realization,facade", float32, kwh_m2, total, "light load of the facade in the day in each realization", "", "area: mean"},
    ResultVariable{"sensor_light_load_by_day", "day,sensor", float32, kwh_m2, total, "light load of the sensor in the day"},
    ResultVariable{"sensor_light_load_direct_by_day", "day,sensor", float32, kwh_m2, total, "light load of the sensor in the day straight from the sun"},
    ResultVariable{"sensor_light_load_by_day_se", "day,sensor", float32, kwh_m2, total, "standard error of sensor_light_load_by_day"},
    ResultVariable{"sensor_light_load_by_day_realization", "day,realization,sensor", float32, kwh_m2, total, "light load of the sensor in the day in each realization"},
    ResultVariable{"sensor_sun_hours_by_day", "day,sensor", float32, "h", total, "time of the sensor in the sun in the day, regardless of weather"},
    ResultVariable{"hour_of_day", "hour_of_day", int32, "", division, "hour of the site's civil time, 0 to 23, of all days together"},
    ResultVariable{"hour_of_day_duration", "hour_of_day", float64, "h", division, "time of the period in the hour of day"},
    ResultVariable{"light_load_by_hour_of_day", "hour_of_day,patch", float32, kwh_m2, total, "light load of the hour of day"},
    ResultVariable{"light_load_direct_by_hour_of_day", "hour_of_day,patch", float32, kwh_m2, total, "light load of the hour of day straight from the sun"},
    ResultVariable{"light_load_by_hour_of_day_se", "hour_of_day,patch", float32, kwh_m2, total, "standard error of light_load_by_hour_of_day"},
    ResultVariable{"light_load_by_hour_of_day_realization", "hour_of_day,realization,patch", float32, kwh_m2, total, "light load of the hour of day in each realization"},
    ResultVariable{"sun_hours_by_hour_of_day", "hour_of_day,patch", float32, "h", total, "time of the hour of day in the sun, regardless of weather"},
    ResultVariable{"facade_light_load_by_hour_of_day", "hour_of_day,facade", float32, kwh_m2, total, "light load of the hour of day, mean over the facade", "", "area: mean"},
    ResultVariable{"facade_light_load_by_hour_of_day_se", "hour_of_day,facade", float32, kwh_m2, total, "standard error of facade_light_load_by_hour_of_day"},
    ResultVariable{"facade_light_load_by_hour_of_day_realization", "hour_of_day,realization,facade", float32, kwh_m2, total, "light load of the facade in the hour of day in each realization", "", "area: mean"},
    ResultVariable{"sensor_light_load_by_hour_of_day", "hour_of_day,sensor", float32, kwh_m2, total, "light load of the sensor in the hour of day"},
    ResultVariable{"sensor_light_load_direct_by_hour_of_day", "hour_of_day,sensor", float32, kwh_m2, total, "light load of the sensor in the hour of day straight from the sun"},
    ResultVariable{"sensor_light_load_by_hour_of_day_se", "hour_of_day,sensor", float32, kwh_m2, total, "standard error of sensor_light_load_by_hour_of_day"},
    ResultVariable{"sensor_light_load_by_hour_of_day_realization", "hour_of_day,realization,sensor", float32, kwh_m2, total, "light load of the sensor in the hour of day in each realization"},
    ResultVariable{"sensor_sun_hours_by_hour_of_day", "hour_of_day,sensor", float32, "h", total, "time of the sensor in the sun in the hour of day, regardless of weather"},

    // Energy ledger.
    ResultVariable{"power_sun", "time", float64, "W", ledger, "sun's power that meets fronts for the first time", "", interval_mean},
    ResultVariable{"power_sky", "time", float64, "W", ledger, "sky's power that meets fronts for the first time", "", interval_mean},
    ResultVariable{"power_ground", "time", float64, "W", ledger, "far ground's power that meets fronts for the first time", "", interval_mean},
    ResultVariable{"power_emitted", "time", float64, "W", ledger, "power of emitters, and of lamps what arrives in the scene", "", interval_mean},
    ResultVariable{"power_absorbed", "time", float64, "W", ledger, "power absorbed", "", interval_mean},
    ResultVariable{"power_transmitted", "time", float64, "W", ledger, "power that leaves through panes", "", interval_mean},
    ResultVariable{"power_escaped", "time", float64, "W", ledger, "power that leaves the scene", "", interval_mean},
    ResultVariable{"power_unshot", "time", float64, "W", ledger, "power not followed further", "", interval_mean},
    ResultVariable{"power_residual", "time", float64, "W", ledger, "power in minus power out", "", interval_mean},
    ResultVariable{"power_estimated", "time", float64, "W", ledger, "power that patches receive of light not followed: an estimate, part of the irradiance, beside the balance", "", interval_mean},
    ResultVariable{"power_sun_se", "", float64, "kWh", ledger, "standard error of the time sum of power_sun"},
    ResultVariable{"power_sky_se", "", float64, "kWh", ledger, "standard error of the time sum of power_sky"},
    ResultVariable{"power_ground_se", "", float64, "kWh", ledger, "standard error of the time sum of power_ground"},
    ResultVariable{"power_emitted_se", "", float64, "kWh", ledger, "standard error of the time sum of power_emitted"},
    ResultVariable{"power_absorbed_se", "", float64, "kWh", ledger, "standard error of the time sum of power_absorbed"},
    ResultVariable{"power_transmitted_se", "", float64, "kWh", ledger, "standard error of the time sum of power_transmitted"},
    ResultVariable{"power_escaped_se", "", float64, "kWh", ledger, "standard error of the time sum of power_escaped"},
    ResultVariable{"power_unshot_se", "", float64, "kWh", ledger, "standard error of the time sum of power_unshot at the number of bounces that were followed, which other lines may make one more or less"},
    ResultVariable{"power_residual_se", "", float64, "kWh", ledger, "standard error of the time sum of power_residual, without what exchange with whole elements makes (mesh.link_threshold; up to 1e-4 of what comes in); far too small now and then with fewer than 4 lines per patch and realization"},
    ResultVariable{"power_estimated_se", "", float64, "kWh", ledger, "standard error of the time sum of power_estimated, without that of the share that lines tell (nearly twice as large), and at the number of bounces that were followed"},

    ResultVariable{"study_yaml", "", text, "", study, "the study, verbatim"},
};

constexpr std::array measure_table{
    ResultVariable{measure_prefix, "patch", float64, "", total, "measure, at the centre of the patch"},
    ResultVariable{"facade_measure_", "facade", float64, "", total, "measure, mean over what is measured of the facade", "", "area: mean"},
    ResultVariable{"selection_measure_", "selection", float64, "", total, "measure, mean over what is measured of the selection", "", "area: mean"},
    ResultVariable{"sensor_measure_", "sensor", float64, "", total, "measure, at the sensor"},
};

constexpr std::array comparison_table{
    ResultVariable{"base_light_load", "patch", float64, kwh_m2, total, "light load of the base"},
    ResultVariable{"variant_light_load", "patch", float64, kwh_m2, total, "light load of the variant"},
    ResultVariable{"light_load_difference", "patch", float64, kwh_m2, total, "variant minus base"},
    ResultVariable{"light_load_difference_se", "patch", float64, kwh_m2, total, "standard error of the difference"},
    ResultVariable{"facade_light_load_difference", "facade", float64, kwh_m2, total, "variant minus base, area-weighted means"},
    ResultVariable{"facade_light_load_difference_se", "facade", float64, kwh_m2, total, "standard error of the difference"},
};

constexpr std::array place_map_table{
    ResultVariable{given_dataset, "patch", float64, kwh_m4, total, "what the place has by each square metre of the patch: reflected, mirrored and shone"},
    ResultVariable{"light_given_se", "patch", float64, kwh_m4, total, "standard error of light_given"},
    ResultVariable{"light_given_reflected", "patch", float64, kwh_m4, total, "the part that the patch reflects diffusely, seen straight"},
    ResultVariable{"light_given_mirror", "patch", float64, kwh_m4, total, "the part that is seen by way of the patch as a mirror or pane"},
    ResultVariable{"light_given_lamps", "patch", float64, kwh_m4, total, "the part that the patch shines by itself"},
    ResultVariable{"light_taken", "patch", float64, kwh_m4, total, "what each square metre of the patch takes from the place by standing before sun, sky and far ground"},
    ResultVariable{"light_taken_sun", "patch", float64, kwh_m4, total, "the part of the sun"},
    ResultVariable{"light_taken_sky", "patch", float64, kwh_m4, total, "the part of the sky"},
    ResultVariable{"light_taken_ground", "patch", float64, kwh_m4, total, "the part of the far ground"},
    ResultVariable{"place_weight", "patch", float64, "1", total, "share of the place that the patch is, 0 outside of it"},
};
// clang-format on

/// A table for illuminance, or of another dataset than the light load, which owns its texts.
class OwnTable {
 public:
  explicit OwnTable(std::span<const ResultVariable> of_irradiance) {
    for (ResultVariable row : of_irradiance) {
      if (row.part != sun) {
        row.name = kept(dataset_name(std::string(row.name), Quantity::illuminance));
        row.units = kept(light_units(row.units, Quantity::illuminance));
        row.long_name = kept(light_words(std::string(row.long_name), Quantity::illuminance));
      }
      rows_.push_back(row);
    }
  }
  OwnTable(std::span<const ResultVariable> of_light_load, const std::string& compared) {
    for (ResultVariable row : of_light_load) {
      std::string name(row.name);
      name.replace(name.find(usual_compared), usual_compared.size(), compared);
      row.name = kept(std::move(name));
      rows_.push_back(row);
    }
  }
  std::span<const ResultVariable> rows() const { return rows_; }

 private:
  std::string_view kept(std::string words) { return texts_.emplace_back(std::move(words)); }
  std::deque<std::string> texts_;
  std::vector<ResultVariable> rows_;
};

}  // namespace

std::span<const ResultVariable> result_schema(Quantity quantity) {
  static const OwnTable illuminance(table);
  return quantity == Quantity::illuminance ? illuminance.rows() : table;
}

std::span<const ResultVariable> comparison_schema(Quantity quantity, const std::string& compared) {
  static const OwnTable illuminance(comparison_table);
  if (compared == usual_compared)
    return quantity == Quantity::illuminance ? illuminance.rows() : comparison_table;
  static std::mutex one_at_a_time;
  static std::map<std::string, OwnTable> others;
  const std::lock_guard lock(one_at_a_time);
  return others.try_emplace(compared, comparison_table, compared).first->second.rows();
}

std::string difference_dataset(const std::string& compared) { return compared + "_difference"; }

std::string realizations_of(const std::string& total) {
  const std::string name = total + "_realization";
  const ResultVariable* found = find_result_variable(name);
  return found && found->name == name ? name : std::string();
}

std::span<const ResultVariable> place_map_schema(Quantity quantity) {
  static const OwnTable illuminance(place_map_table);
  return quantity == Quantity::illuminance ? illuminance.rows() : place_map_table;
}

const ResultVariable* find_result_variable(std::string_view name, Quantity quantity) {
  for (const auto& variable : result_schema(quantity)) {
    if (variable.name == name) return &variable;
  }
  for (const auto& variable : measure_table)
    if (name.starts_with(variable.name)) return &variable;
  return nullptr;
}

bool is_coordinate_of_itself(const ResultVariable& variable) {
  return variable.dims == variable.name;
}

std::vector<std::string> dimension_names(const ResultVariable& variable) {
  std::vector<std::string> names;
  std::string_view rest = variable.dims;
  while (!rest.empty()) {
    const auto end = std::min(rest.find(','), rest.size());
    names.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return names;
}

bool is_of_scene(std::string_view dataset) {
  return dataset.ends_with("sky_view_factor") || dataset.ends_with("sky_view_factor_se") ||
         dataset == "patch_lines" || dataset == "diffuse_reflectance" ||
         dataset == "emitted_exitance";
}

std::string largest_of_mean_dataset(const std::string& largest) { return largest + "_of_mean"; }

bool is_of_mean(std::string_view dataset) { return dataset.ends_with("_of_mean"); }

bool has_bands(const ResultVariable& variable) {
  const std::string_view name = variable.name;
  if (name == "diffuse_reflectance") return true;
  if (is_of_mean(name)) return false;
  if (name.find("sun_hours") != std::string_view::npos || is_of_scene(name) ||
      name.find(measure_prefix) != std::string_view::npos)
    return false;
  return variable.part == ResultPart::series || variable.part == ResultPart::ledger ||
         variable.part == ResultPart::total;
}

std::vector<std::string> with_band(std::vector<std::string> dimensions) {
  const bool in_space = !dimensions.empty() && dimensions.back() != "time";
  dimensions.insert(in_space ? dimensions.end() - 1 : dimensions.end(), "band");
  return dimensions;
}

}  // namespace sunload
