#pragma once

#include <functional>
#include <string>

#include <pharos/rendering/ranks.h>
#include <pharos/rendering/render_job.h>

namespace pharos::testing {

/// Runs `work` as several ranks, each on a thread of its own in this process, and waits for all.
void as_ranks(int count, const std::function<void(Ranks&)>& work);

/// Renders a config that is given as text on `ranks` ranks, with `threads` threads each. Rank 0
/// goes on from `state` if it is not empty, and `control` is its control.
RenderResult render_on_ranks(const std::string& yaml, int ranks, int threads,
                             RenderControl control = {}, const std::string& state = {});

}  // namespace pharos::testing
