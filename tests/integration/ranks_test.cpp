// A render on several ranks gives the same bits as a render in one process. The ranks are threads
// here; tests/command_line has a render by mpirun.

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <pharos/core/error.h>
#include <pharos/rendering/rank_helper.h>
#include <pharos/rendering/rank_leader.h>

#include "renders.h"
#include "thread_ranks.h"

namespace pharos::testing {
namespace {

/// A small render of 24 tiles in `scene`.
std::string config_in(const char* scene, const std::string& rest, int spp = 16) {
  return fmt::format(
      "scene: {}/{}/scene.yaml\nfilm: {{ width: 48, height: 32, tile: 8, filter: gaussian }}\n"
      "budget: {{ spp: {} }}\n{}",
      PHAROS_SCENES, scene, spp, rest);
}

std::string guided_by(const char* preset) {
  return fmt::format("integrator: {{ type: path, guiding: {} }}\n", preset);
}

void check_same_on_ranks(const std::string& config) {
  const RenderResult alone = render(config);
  for (const int ranks : {1, 2, 3, 4}) {
    for (const int threads : {1, 2}) {
      CAPTURE(ranks);
      CAPTURE(threads);
      const RenderResult together = render_on_ranks(config, ranks, threads);
      const bool same = bits_of(together) == bits_of(alone);
      CHECK(same);
      CHECK(together.counters.paths == alone.counters.paths);
      CHECK(together.counters.rays == alone.counters.rays);
    }
  }
}

TEST_CASE("ranks: unguided, and light paths that splat") {
  for (const char* integrator : {"path", "bidirectional", "light"}) {
    check_same_on_ranks(config_in("cornell-box", fmt::format("integrator: {}\n", integrator)));
  }
}

TEST_CASE("ranks: terminations that learn") {
  check_same_on_ranks(
      config_in("cornell-box",
                "integrator: { type: path, termination: adjoint, training: { iterations: 3 } }\n"));
  check_same_on_ranks(
      config_in("cornell-box",
                "integrator: { type: path, termination: efficiency, guiding: { learner: "
                "stub_direction, guider: stub_direction, training: { iterations: 3 } } }\n"));
}

TEST_CASE("ranks: four methods and the robust mixture") {
  for (const char* preset :
       {"focal", "ppg-improved", "pavmm-robust", "spatial-gaussians", "triplets", "robust"}) {
    CAPTURE(preset);
    check_same_on_ranks(config_in("cornell-box", guided_by(preset)));
  }
}

TEST_CASE("ranks: light paths that train triplets in fog, and a camera that is guided") {
  check_same_on_ranks(config_in("fog-box", R"(
integrator:
  type: bidirectional
  light_paths: training
  guiding: { learner: { type: vertex_triplets, light_paths: true }, guider: vertex_triplets,
             training: { schedule: geometric } }
)"));
  check_same_on_ranks(
      config_in("cornell-box", "integrator: { type: bidirectional, guiding: triplets-flt }\n"));
}

TEST_CASE("ranks: pixels with different numbers of samples, and paths from both ends") {
  check_same_on_ranks(
      config_in("cornell-box", "integrator: { type: bidirectional, guiding: robust }\n", 64));
}

TEST_CASE("ranks: a sampler that probes the integrand") {
  check_same_on_ranks(config_in("cornell-box", "sampler: aligned\n"));
}

TEST_CASE("ranks: a render goes on with another number of ranks") {
  const std::string config = config_in("cornell-box", guided_by("robust"), 32);
  int count = 0;
  RenderControl counting;
  counting.checkpoint.is_due = [&] {
    ++count;
    return false;
  };
  render_on_ranks(config, 1, 1, counting);
  const std::string whole = bits_of(render(config));
  for (const int stop_after : {count / 10, count / 2, count - 5}) {
    std::atomic<bool> stop{false};
    int units = 0;
    std::string state;
    RenderControl control;
    control.stop = &stop;
    control.checkpoint.is_due = [&] {
      stop = ++units >= stop_after;
      return false;
    };
    control.checkpoint.take = [&](std::string taken, bool) { state = std::move(taken); };
    CHECK(render_on_ranks(config, 3, 1, control).stopped);
    REQUIRE_FALSE(state.empty());
    for (const int ranks : {1, 2, 4}) {
      CAPTURE(ranks);
      const bool same = bits_of(render_on_ranks(config, ranks, 1, {}, state)) == whole;
      CHECK(same);
    }
  }
}

TEST_CASE("ranks: every rank gets units, and the slow one fewer") {
  const LoadedConfig loaded = config_from(config_in("cornell-box", "", 64));
  const Film film(48, 32, loaded.config.film.filter);
  std::vector<int> units(3);
  as_ranks(3, [&](Ranks& ranks) {
    if (ranks.rank() == 0) {
      RenderJob(loaded.config).run({.ranks = &ranks});
      return dismiss_helpers(ranks);
    }
    // One thread, as the count is not guarded.
    tbb::task_arena(1).execute([&] {
      help(ranks, "",
           {.begin_iteration = [](bool, const std::string&) {},
            .render = [&](const WorkUnit& unit, bool) -> WorkResult {
              std::this_thread::sleep_for(std::chrono::milliseconds(5 * ranks.rank()));
              ++units[static_cast<std::size_t>(ranks.rank())];
              return {.film = film.make_tile(unit.pixels)};
            }});
    });
  });
  CHECK(units[2] > 0);
  CHECK(units[1] > units[2]);
}

TEST_CASE("ranks: a rank that loads slowly costs a time budget nothing") {
  const LoadedConfig loaded = config_from(config_in("cornell-box", "", 1));
  as_ranks(2, [&](Ranks& ranks) {
    RenderJob job(loaded.config);
    if (ranks.rank() == 1) {
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      return job.help(ranks, "");
    }
    const RenderTimes times = job.run({.ranks = &ranks}).times;
    dismiss_helpers(ranks);
    CHECK(times.budgeted() < 0.4);
  });
}

TEST_CASE("ranks: a stop is noticed while other ranks load or render") {
  const LoadedConfig loaded = config_from(config_in("cornell-box", "", 16));
  const Film film(48, 32, loaded.config.film.filter);
  for (const bool during_load : {true, false}) {
    CAPTURE(during_load);
    std::atomic<bool> stop{during_load};
    std::atomic<bool> is_released{false};
    const auto wait_for_release = [&] {
      while (!is_released) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    as_ranks(2, [&](Ranks& ranks) {
      if (ranks.rank() == 0) {
        const RenderResult result = RenderJob(loaded.config).run({.stop = &stop, .ranks = &ranks});
        CHECK(result.stopped);
        is_released = true;
        return dismiss_helpers(ranks);
      }
      if (during_load) wait_for_release();
      help(ranks, "",
           {.begin_iteration = [](bool, const std::string&) {},
            .render = [&](const WorkUnit& unit, bool) -> WorkResult {
              stop = true;
              wait_for_release();
              return {.film = film.make_tile(unit.pixels)};
            }});
    });
  }
}

TEST_CASE("ranks: guides that cannot be saved end the render") {
  as_ranks(2, [&](Ranks& ranks) {
    if (ranks.rank() == 1) {
      return help(ranks, "",
                  {.begin_iteration = [](bool, const std::string&) {},
                   .render = [](const WorkUnit&, bool) -> WorkResult {
                     throw std::logic_error("no unit should come");
                   }});
    }
    RankLeader leader(ranks, "", [] { return true; });
    const auto fail = []() -> std::string { throw RunError("no memory"); };
    CHECK_THROWS_AS(leader.begin_iteration(true, fail), RunError);
    dismiss_helpers(ranks);
  });
}

TEST_CASE("ranks: results that wait for an earlier unit take bounded memory") {
  constexpr std::size_t kUnits = 200, kVertices = 300, kWaiting = 2;
  const Film film(4, 4, config_from(config_in("cornell-box", "")).config.film.filter);
  const auto blank = [&](std::size_t) { return WorkResult{.film = film.make_tile({0, 0, 4, 4})}; };
  std::atomic<std::size_t> elsewhere{0};
  const auto render_elsewhere = [&](const WorkUnit&, bool) {
    ++elsewhere;
    WorkResult result = blank(0);
    result.log.begin_path({}, Transport::radiance);
    for (std::size_t i = 0; i < kVertices; ++i) result.log.add(RecordedVertex());
    return result;
  };
  as_ranks(2, [&](Ranks& ranks) {
    if (ranks.rank() == 1) {
      return tbb::task_arena(4).execute([&] {
        help(ranks, "",
             {.begin_iteration = [](bool, const std::string&) {}, .render = render_elsewhere});
      });
    }
    tbb::task_arena(1).execute([&] {
      RankLeader leader(
          ranks, "", [] { return true; }, kWaiting * kVertices * sizeof(RecordedVertex));
      std::size_t most = 0;
      leader.run({.count = kUnits,
                  .unit =
                      [](std::size_t) {
                        return WorkUnit{.pixels = {0, 0, 4, 4}};
                      },
                  .is_recorded = [](std::size_t) { return true; },
                  .blank = blank,
                  .render =
                      [&](std::size_t i) {
                        // Meanwhile the others could finish all units.
                        if (i == 0) std::this_thread::sleep_for(std::chrono::seconds(1));
                        return blank(i);
                      },
                  .merge =
                      [&](std::size_t i, WorkResult&) {
                        if (i == 0) most = elsewhere;
                      },
                  .keeps_going = [] { return true; }});
      // Four more units may be ahead for the thread here.
      CHECK(most > 0);
      CHECK(most <= kWaiting + 4);
      dismiss_helpers(ranks);
    });
  });
}

/// Returns the message of the error with which rank 0 ends if rank 1 does `work`.
std::string error_with(const std::function<void(Ranks&)>& work) {
  const LoadedConfig loaded = config_from(config_in("cornell-box", ""));
  std::string message;
  as_ranks(3, [&](Ranks& ranks) {
    if (ranks.rank() == 1) return work(ranks);
    RenderJob job(loaded.config);
    if (ranks.rank() == 2) return job.help(ranks, "");
    try {
      job.run({.ranks = &ranks});
    } catch (const RunError& error) {
      message = error.what();
    }
    dismiss_helpers(ranks);
  });
  return message;
}

TEST_CASE("ranks: a rank that cannot take part, or fails later, ends the render with its reason") {
  CHECK(error_with([](Ranks& ranks) { refuse_to_help(ranks, "no scene here"); }) ==
        "rank 1: no scene here");
  CHECK(error_with([](Ranks& ranks) { help(ranks, "another", {}); }) ==
        "rank 1 has another config, another file that it names, or another build of Pharos");
  CHECK(error_with([](Ranks& ranks) {
          help(ranks, "",
               {.begin_iteration = [](bool, const std::string&) {},
                .render = [](const WorkUnit&, bool) -> WorkResult {
                  throw std::runtime_error("out of light");
                }});
        }) == "rank 1: out of light");
  CHECK(error_with([](Ranks& ranks) {
          help(ranks, "",
               {.begin_iteration =
                    [](bool, const std::string&) { throw std::runtime_error("out of memory"); },
                .render = [](const WorkUnit&, bool) -> WorkResult {
                  throw std::runtime_error("no unit should come");
                }});
        }).starts_with("rank 1: "));
}

}  // namespace
}  // namespace pharos::testing
