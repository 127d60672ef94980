#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <pharos/rendering/ranks.h>
#include <pharos/rendering/unit_runner.h>

namespace pharos {

/// Renders units in this process, which is rank 0, and on the other ranks. Every rank gets a new
/// unit when it has finished one, so that a fast rank renders more of them. Results are merged
/// here, in order.
class RankLeader final : public UnitRunner {
 public:
  /// Waits until all ranks are ready, or until `keeps_going()` is false. `render` is a key of what
  /// is rendered. The results of other ranks that wait for an earlier unit take about
  /// `waiting_bytes` at most. Throws RunError if a rank has failed, or if it renders something
  /// else.
  RankLeader(Ranks& ranks, const std::string& render, const std::function<bool()>& keeps_going,
             std::size_t waiting_bytes = std::size_t{1} << 30);

  void begin_iteration(bool trains, const std::function<std::string()>& save_frozen) override;
  /// A pass that must not go on does not wait for what other ranks still render.
  void run(const UnitPass& pass) override;
  /// The ranks that share the cores of this one are idle between two passes, so `work` gets their
  /// threads too.
  void on_idle_cores(const std::function<void()>& work) override;

 private:
  class Pass;
  struct Helper {
    std::size_t threads = 0;
    std::size_t units = 0;  ///< that it has at the moment
  };

  Ranks& ranks_;
  std::size_t waiting_bytes_;
  std::vector<Helper> helpers_;  ///< by rank; the first one is not used
  /// The size of the largest result of other ranks, without and with a log [bytes]; 0: unknown.
  std::array<std::size_t, 2> largest_result_{};
};

/// Tells the other ranks that there is no more work, and waits until they have left. Rank 0 calls
/// it once, after the render or instead of it.
void dismiss_helpers(Ranks& ranks);

}  // namespace pharos
