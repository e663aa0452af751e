// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The files of one variant: where its result and its work lie, and in what state they are
/// (docs/batch-file.md).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/batch/file.h"
#include "io/study/study.h"

namespace sunload {

/// `<folder>/<study>/<variant>.h5`; `folder` is that of all results.
std::string result_path(const std::string& folder, const Study& study);

/// Numbers of batches that are missing or not valid, and why a file that is there cannot be used.
struct MissingBatches {
  std::vector<std::size_t> numbers;
  std::vector<std::string> reasons;
};

/// What a result is of.
struct ResultState {
  std::string content_hash;
  std::string measures_hash;  ///< of measures and selections, where there are any
  bool lacks_series = false;  ///< that the study stores

  bool operator==(const ResultState&) const = default;
};

/// Result, batches, prepared file, locks of one variant at one content hash. Knows names alone: no
/// scene, no light. Nothing is made or removed but by the functions that say so.
class WorkFolder {
 public:
  /// `folder`: of all results; `batches`: how many the variant has.
  WorkFolder(const std::string& folder, const Study& study, std::string content_hash,
             std::size_t batches);
  /// The same variant at another content hash.
  WorkFolder with_hash(const std::string& content_hash) const;

  const std::string& content_hash() const { return content_hash_; }
  std::size_t batch_count() const { return batches_; }

  const std::string& result() const { return result_; }
  const std::string& path() const { return path_; }  ///< of the work
  std::string batch(std::size_t number) const;
  std::string prepared() const { return path_ + "/prepared"; }
  std::string prepared_lock() const { return path_ + "/prepared.lock"; }
  std::string partial() const { return path_ + "/partial.h5"; }
  std::string merge_lock() const;

  bool is_there() const;
  /// Whether the variant has work at other content hashes, too.
  bool has_others() const;
  /// Of the finished result; none where there is no result. Throws InputError where it cannot be
  /// read.
  std::optional<ResultState> state() const;
  /// What it is to be.
  ResultState wanted_state() const { return {content_hash_, measures_hash_, false}; }
  /// A batch's file, all of it read.
  BatchCheck check(std::size_t number) const;
  /// All batches' files, all of them read.
  MissingBatches missing_batches() const;
  /// Numbers of the batches whose file is not there at all: a look at the folder.
  std::vector<std::size_t> batches_not_there() const;
  /// Size of batches and prepared file.
  double bytes_there() const;

  /// Makes it where it is missing. Throws MachineError.
  void make() const;
  /// Marks the batches as wanted (--keep-batches): later runs leave them. Throws MachineError.
  void keep_work() const;
  /// Removes batches, lines and all that belongs to them.
  void remove_work() const;
  /// Removes the folders of the work where nothing is in them.
  void remove_empty_folders() const;
  /// Removes work whose result is there: a process was killed while it removed it, or two
  /// processes computed the same. Does nothing where the work was kept on purpose, where another
  /// process merges just now, or without the right to write.
  void remove_finished_work() const;

 private:
  std::string work_, variant_, content_hash_, measures_hash_, result_, path_;
  std::vector<std::string> unwanted_;  ///< series that batches and result may lack
  std::size_t batches_;
};

/// Below `<folder>/<study>`, whatever the content hash: removes parts of files whose writers are
/// gone (`remove_left_aside`), locks that nobody holds, folders of work with nothing in them.
void remove_left_over(const std::string& folder, const std::string& study);

}  // namespace sunload
