#pragma once

#include <functional>
#include <string>

#include <pharos/rendering/integrator.h>
#include <pharos/rendering/ranks.h>

namespace pharos {

/// The work of a rank other than 0, which messages from rank 0 ask for.
struct HelperWork {
  /// Begins an iteration whose units are to be rendered. `frozen` is what rank 0 has saved of the
  /// things that stay the same during the iteration. No unit is in progress.
  std::function<void(bool trains, const std::string& frozen)> begin_iteration;
  /// Renders a unit, and records its paths if `records` is set. Called by several threads at a
  /// time.
  std::function<WorkResult(const WorkUnit& unit, bool records)> render;
};

/// Renders what rank 0 hands out, with as many threads as the arena has, until rank 0 says that
/// there is no more. `render` is a key of what is rendered, which all ranks must have in common.
/// If the work throws, rank 0 learns why, and the function returns as usual.
void help(Ranks& ranks, const std::string& render, const HelperWork& work);

/// Tells rank 0 that this rank cannot take part, and waits until rank 0 knows.
void refuse_to_help(Ranks& ranks, const std::string& reason);

}  // namespace pharos
