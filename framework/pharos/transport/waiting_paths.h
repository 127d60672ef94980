#pragma once

#include <cstdint>
#include <vector>

#include <pharos/transport/path.h>

namespace pharos {

/// The number of steps that a path takes from a vertex, the number of times that it samples lights
/// there, and the weight of each.
struct Branching {
  std::uint32_t count = 1;
  float weight = 1;  ///< 1 over the expected number of steps
  std::uint32_t lights = 1;
  float light_weight = 1;  ///< 1 over the expected value of `lights`

  /// Whether steps are taken as if there were no rule.
  bool is_plain() const { return count == 1 && weight == 1; }
};

/// The branches of one path from the sensor that wait until the current branch has ended. The last
/// one that came is the first one to go on, so few of them wait at a time. The memory is used again
/// for the following paths.
class WaitingPaths {
 public:
  /// Begins a path that may have `most` branches beside the first one.
  void begin(std::uint32_t most) {
    waiting_.clear();
    most_ = most;
    begun_ = 0;
  }
  /// Returns how many more branches may begin.
  std::uint32_t left() const { return most_ - begun_; }
  /// Adds a copy of `trunk` under the next number and returns it. The reference is valid until the
  /// next call.
  Path& add(const Path& trunk) {
    Path& branch = waiting_.emplace_back(trunk);
    branch.branch = ++begun_;
    return branch;
  }
  /// Removes the branch that was added last, because it has ended.
  void drop() { waiting_.pop_back(); }
  /// Moves the next branch into `path`. Returns false if none waits.
  bool take(Path& path) {
    if (waiting_.empty()) return false;
    path = waiting_.back();
    waiting_.pop_back();
    return true;
  }

 private:
  std::vector<Path> waiting_;
  std::uint32_t most_ = 0, begun_ = 0;
};

}  // namespace pharos
