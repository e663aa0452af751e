/// One merge at a time: a lock that the system lets go when its holder dies.
#pragma once

#include <string>

namespace sunload {

class MergeLock {
 public:
  /// Tries to take the lock file `path` (made if missing); does not wait.
  explicit MergeLock(const std::string& path);
  ~MergeLock();
  MergeLock(const MergeLock&) = delete;
  MergeLock& operator=(const MergeLock&) = delete;
  bool is_held() const { return held_; }

 private:
  int file_ = -1;
  bool held_ = false;
};

}  // namespace sunload
