// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What commands on results and scenes do, and what they are asked for in words. The commands on
/// studies are in io/run/run.h and io/command/check_study.h.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/picture/render.h"
#include "io/result/named_parts.h"
#include "io/result/schema.h"
#include "io/view/view.h"

namespace sunload {

/// A result file as a command names it.
struct NamedResult {
  std::string path;
  std::string band;  ///< red, green or blue of a result in bands; empty: their mean
  PeriodChoice period;
};
/// Open, with the band and the part of the period that are chosen. Throws InputError.
std::unique_ptr<const ResultReader> opened(const NamedResult& named, Opens opens = Opens::results);

struct InfoOptions {
  NamedResult result;
  enum class What {
    screen,
    patches,
    facades,
    objects,
    orientations,
    selections,
    sensors,
    measures
  };
  std::vector<What> what;  ///< that was asked for; empty: what the names are of, or the screen
  NamedParts parts;
  enum class Format { text, csv, json } format = Format::text;
};
/// What a result holds, on stdout. Throws InputError for words that contradict each other.
int print_info(const InfoOptions& options);

struct CompareOptions {
  std::string base;                   ///< result file, or a study
  std::vector<std::string> variants;  ///< result files, or names of variants of the study
  std::string output;                 ///< folder of the study's results; empty: as it says
  std::string band;
  PeriodChoice period;
  std::string quantity = std::string(usual_compared);  ///< dataset per patch
  NamedParts parts;          ///< rows of these alone; sensors are not compared
  double least_percent = 0;  ///< what matters, as share of the base
  double storey_m = 0;       ///< height of a storey, for rows of storeys; 0: none
  enum class Format { table, csv, json } format = Format::table;
  std::string differences;  ///< HDF5 file of the differences, besides; empty: none
};
/// Compares results with a base, on stdout. Of a study's variants the first name is the base; a
/// single one is compared with the study's first variant. Throws InputError.
int compare(const CompareOptions& options);

struct ExplainOptions {
  NamedResult result;
  std::string against;       ///< result of the base; empty: none
  std::string study_folder;  ///< that files named in the study are relative to; empty: this one
  NamedParts parts;          ///< the place
  enum class What { rows, painting } what = What::rows;
  enum class Format { text, csv, json } format = Format::text;
  std::string picture;  ///< waterfall of the rows (.png), besides; empty: none
  std::string map;      ///< file of what each patch gives and takes (.h5), besides; empty: none
};
/// Who takes and gives the light of a place, on stdout. Throws InputError.
int explain(const ExplainOptions& options);

struct RenderOptions {
  NamedResult result;        ///< or a comparison, or a study, whose scene is drawn without light
  std::string variant;       ///< of a study; empty: its first
  bool has_colours = false;  ///< whether rules.colours was asked for
  RenderRules rules;
  std::string size = "1600x1000";
  std::string picture;  ///< file to write
  bool animate = false;
};
/// Throws InputError for words that do not say what they should.
int render(RenderOptions options);

struct ViewOptions {
  std::vector<std::string> inputs;    ///< results; or one study, shown without light
  std::vector<std::string> variants;  ///< of the study; empty: its first two
  ViewRules rules;
  std::string page;  ///< file to write
};
/// Throws InputError, also for variants of what is no study.
int view(const ViewOptions& options);

struct FormFactorOptions {
  std::string input;         ///< result file, or a study
  std::string variant;       ///< of a study; empty: its first
  std::string study_folder;  ///< that files named in a result's study are relative to
  std::string of;            ///< rows and columns: patch (where left out), facade, object, surface
  std::string output;        ///< .h5 or .csv; empty: the standard output
};
/// Form factors of a scene. Throws InputError.
int export_form_factors(const FormFactorOptions& options);

struct BuiltinOptions {
  std::string name;                     ///< of a built-in scene, or a study (.yaml)
  std::string variant;                  ///< of the study; empty: its first
  std::vector<std::string> parameters;  ///< parameter=value
  std::string path;                     ///< .obj or .city.json
};
/// Writes a built-in scene, or the model of a study with its edits, as read and before it is
/// prepared, to a file. Throws InputError.
int write_builtin(const BuiltinOptions& options);

/// Number of a named band; none of an empty name. Throws InputError.
std::optional<std::size_t> chosen_band(const std::string& name);

}  // namespace sunload
