// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Results are read by the tools of their users without help.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

/// Dimensions and units of docs/result-file.md; empty units: an index, a flag or a text.
const nlohmann::json promised = {
    {"time", {"time", "seconds since 1970-01-01T00:00:00Z"}},
    {"time_bounds", {"time bounds", ""}},
    {"sun_azimuth", {"time", "degree"}},
    {"sun_elevation", {"time", "degree"}},
    {"sun_direction", {"time xyz", "1"}},
    {"dni", {"time", "W m-2"}},
    {"dhi", {"time", "W m-2"}},
    {"ghi", {"time", "W m-2"}},
    {"vertex_position", {"vertex xyz", "m"}},
    {"patch_vertices", {"patch corner", ""}},
    {"patch_area", {"patch", "m2"}},
    {"patch_centroid", {"patch xyz", "m"}},
    {"patch_normal", {"patch xyz", "1"}},
    {"patch_object", {"patch", ""}},
    {"patch_facade", {"patch", ""}},
    {"patch_material", {"patch", ""}},
    {"patch_surface", {"patch", ""}},
    {"patch_side", {"patch", ""}},
    {"input_triangle_vertices", {"input_triangle corner", ""}},
    {"patch_input_triangle", {"patch", ""}},
    {"object", {"object", ""}},
    {"facade", {"facade", ""}},
    {"material", {"material", ""}},
    {"object_name", {"object", ""}},
    {"facade_name", {"facade", ""}},
    {"material_name", {"material", ""}},
    {"facade_area", {"facade", "m2"}},
    {"facade_azimuth", {"facade", "degree"}},
    {"irradiance", {"time patch", "W m-2"}},
    {"irradiance_direct", {"time patch", "W m-2"}},
    {"irradiance_sky", {"time patch", "W m-2"}},
    {"irradiance_mirror", {"time patch", "W m-2"}},
    {"irradiance_reflected", {"time patch", "W m-2"}},
    {"light_load", {"patch", "kWh m-2"}},
    {"light_load_direct", {"patch", "kWh m-2"}},
    {"light_load_sky", {"patch", "kWh m-2"}},
    {"light_load_mirror", {"patch", "kWh m-2"}},
    {"light_load_reflected", {"patch", "kWh m-2"}},
    {"light_load_se", {"patch", "kWh m-2"}},
    {"light_load_realization", {"realization patch", "kWh m-2"}},
    {"facade_light_load_realization", {"realization facade", "kWh m-2"}},
    {"sun_hours", {"patch", "h"}},
    {"irradiance_max", {"patch", "W m-2"}},
    {"sky_view_factor", {"patch", "1"}},
    {"sky_view_factor_se", {"patch", "1"}},
    {"power_load", {"patch", "kWh m-2"}},
    {"diffuse_reflectance", {"patch", "1"}},
    {"facade_irradiance", {"time facade", "W m-2"}},
    {"facade_light_load", {"facade", "kWh m-2"}},
    {"facade_light_load_se", {"facade", "kWh m-2"}},
    {"power_sun", {"time", "W"}},
    {"power_sky", {"time", "W"}},
    {"power_ground", {"time", "W"}},
    {"power_emitted", {"time", "W"}},
    {"power_absorbed", {"time", "W"}},
    {"power_transmitted", {"time", "W"}},
    {"power_escaped", {"time", "W"}},
    {"power_unshot", {"time", "W"}},
    {"power_residual", {"time", "W"}},
    {"power_residual_se", {"", "kWh"}},
    {"study_yaml", {"", ""}}};

constexpr const char* check = R"(
import json, sys, xarray
data = xarray.open_dataset(sys.argv[1], engine='h5netcdf')
for name, (dims, units) in json.loads(sys.argv[2]).items():
    if name not in data.variables:
        print(name, 'is missing')
        continue
    variable = data[name]
    found = variable.attrs.get('units', variable.encoding.get('units', ''))
    if name != 'time_bounds' and found != units:
        print(name, 'has the unit', found, 'instead of', units)
    if ' '.join(variable.dims) != dims:
        print(name, 'has the dimensions', variable.dims, 'instead of', dims)
    if 'long_name' not in variable.attrs:
        print(name, 'has no long_name')
assert data.time.dtype.kind == 'M' and data.sun_hours.dtype.kind == 'f'
assert data.time.values[0] >= data.time_bounds.values[0][0]
for name in ('title', 'source', 'history', 'Conventions', 'sunload_format', 'study_sha256', 'variant',
             'seed', 'realizations', 'isa', 'timezone', 'sun_sampling'):
    assert name in data.attrs, name
# Names are labels; indices count in the datasets of names, as ever.
facades = data.facade_irradiance.to_pandas()
assert list(facades.columns) == list(data.facade_name.values) and len(facades.columns) > 4
assert facades.columns.name == 'facade' and facades.index.name == 'time'
south = data.facade_light_load.sel(facade='house_1/south_1')
assert south == data.facade_light_load[list(data.facade_name.values).index('house_1/south_1')]
assert list(data.object.values) == list(data.object_name.values)
assert list(data.material.values) == list(data.material_name.values)
assert open(sys.argv[3]).read() == str(data.study_yaml.values)
data.load()
for name, variable in data.variables.items():
    # What a measure does not choose has none of it.
    if variable.dtype.kind == 'f' and 'measure_' not in name and variable.isnull().any():
        print(name, 'has missing values')
)";

TEST(Xarray, ListsTheVariablesOfTheDesign) {
  const WorkFolder folder;
  const std::string study = folder.write("street.yaml", street_study());
  const Ran ran = program(folder, {"run", "street.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ledger_problem(folder / "results/street/baseline.h5"), "");
  const Ran listing = python(folder,
                             "import xarray; print(xarray.open_dataset("
                             "'results/street/baseline.h5', engine='h5netcdf'))");
  EXPECT_EQ(listing.code, 0) << listing.err;
  EXPECT_NE(listing.out.find("sun_azimuth"), std::string::npos) << listing.out;
  // What is printed leaves out most of the many variables, unless one asks for all.
  const Ran all = python(folder,
                         "import xarray; xarray.set_options(display_max_rows=200); print("
                         "xarray.open_dataset('results/street/baseline.h5', engine='h5netcdf'))");
  for (const auto& [name, words] : promised.items())
    EXPECT_NE(all.out.find(name.substr(0, 20)), std::string::npos) << name;
  const Ran checked = python(folder, check, {"results/street/baseline.h5", promised.dump(), study});
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_EQ(checked.out, "");
}

}  // namespace
}  // namespace sunload::test
