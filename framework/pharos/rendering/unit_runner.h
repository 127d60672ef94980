#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include <pharos/rendering/integrator.h>

namespace pharos {

/// The work units of one or several passes that are left to render. The functions may be called by
/// any thread.
struct UnitPass {
  std::size_t count = 0;
  std::function<WorkUnit(std::size_t i)> unit;
  std::function<bool(std::size_t i)> is_recorded;   ///< whether its result has a log
  std::function<WorkResult(std::size_t i)> blank;   ///< an empty result for unit `i`
  std::function<WorkResult(std::size_t i)> render;  ///< renders unit `i` in this process
  /// Takes the results, in order of `i`, one call at a time.
  std::function<void(std::size_t i, WorkResult& result)> merge;
  /// Whether further units may begin. Once false, it stays false.
  std::function<bool()> keeps_going;
};

/// Decides where work units are rendered. Results are merged in order, so that they do not depend
/// on this decision.
class UnitRunner {
 public:
  virtual ~UnitRunner() = default;

  /// Begins an iteration, of training or of the final image. `save_frozen` saves what others need
  /// to render its units: what stays the same during the iteration, such as the guides.
  virtual void begin_iteration(bool trains, const std::function<std::string()>& save_frozen) = 0;
  /// Runs a pass to its end, or until it must not go on. Throws what a unit has thrown.
  virtual void run(const UnitPass& pass) = 0;
  /// Runs `work` between two passes, on all cores that would render otherwise. It gives the same
  /// result with any number of threads.
  virtual void on_idle_cores(const std::function<void()>& work) = 0;
};

/// Renders all units in this process, on TBB.
class LocalUnits final : public UnitRunner {
 public:
  void begin_iteration(bool, const std::function<std::string()>&) override {}
  void run(const UnitPass& pass) override;
  void on_idle_cores(const std::function<void()>& work) override { work(); }
};

}  // namespace pharos
