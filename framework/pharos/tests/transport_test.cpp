// Tests of paths in flight. They are values: copies and batches of them continue to the same bits.

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/conformance/guide_stage.h>
#include <pharos/conformance/guided.h>
#include <pharos/tests/fixtures.h>
#include <pharos/transport/counterparts.h>
#include <pharos/transport/light_walk.h>
#include <pharos/transport/path_loop.h>
#include <pharos/transport/splats.h>

#include "allocation_count.h"

namespace pharos {
namespace {

constexpr int kEdge = 8;

/// Everything that a walk through a foggy room needs.
struct Stage {
  Scene scene{conformance::room_parts(conformance::Room::lamp, true)};
  std::unique_ptr<const PreparedSensor> sensor = scene.sensor().prepare(kEdge, kEdge);
  RenderTarget target{scene, *sensor, kEdge, kEdge};
  PathSettings settings{.roulette = Roulette::throughput, .roulette_depth = 2};
  LightSelector lights{scene, LightSelection::one};
  std::shared_ptr<const TerminationRule> roulette = settings.first_rule();
  CameraScene shared{target, settings, lights, roulette.get()};
  conformance::KeyedSampler sampler;
  IterationContext context{.sampler = sampler, .seed = 3};
  TransportArenas arenas;
  RenderCounters counters;
  SilentRecorder recorder;

  SampleStream stream(std::uint64_t index) const {
    return {sampler, {.seed = 3, .index = index % (kEdge * kEdge), .sample = 0}};
  }
};

using Walk = CameraWalk<SilentRecorder>;
using Flight = Walk::InFlight;

/// The same factor at every vertex.
struct Factor final : TerminationRule {
  explicit Factor(float f) : value(f) {}
  BranchFactors factors(const TerminationQuery&) const override { return {value}; }
  float value;
};

/// Returns the number of branches in the records of all paths of a stage, and checks that no path
/// has more than the settings allow.
std::uint32_t branches_of(Stage& stage, const Factor& rule) {
  stage.shared.termination = &rule;
  PathLog log;
  LogRecorder recorder(log);
  const CameraWalk<LogRecorder> walk(stage.shared, stage.context, stage.arenas, stage.counters,
                                     recorder);
  std::uint32_t all = 0;
  for (int i = 0; i < kEdge * kEdge; ++i) {
    walk.run(stage.stream(i), stage.settings.max_depth);
    std::uint32_t most = 0;
    for (const RecordedVertex& vertex : log[log.size() - 1].vertices) {
      most = std::max(most, vertex.branch);
    }
    CHECK(most <= stage.settings.most_branches);
    all += most;
  }
  return all;
}

Flight begun(const Stage& stage, std::uint64_t index) {
  return {Path(stage.stream(index)), {}, {}};
}

}  // namespace

TEST_CASE("a batch of paths, advanced in turn, finds what the paths find one by one") {
  Stage stage;
  const Walk walk(stage.shared, stage.context, stage.arenas, stage.counters, stage.recorder);
  std::vector<Rgb> alone;
  for (int i = 0; i < kEdge * kEdge; ++i) {
    alone.push_back(walk.run(stage.stream(i), stage.settings.max_depth).radiance);
  }
  std::vector<Flight> batch;
  std::vector<bool> goes;
  for (int i = 0; i < kEdge * kEdge; ++i) {
    batch.push_back(begun(stage, i));
    goes.push_back(walk.begin(batch.back()));
  }
  for (int round = 0; round <= stage.settings.max_depth; ++round) {
    for (std::size_t i = batch.size(); i-- > 0;) {
      if (goes[i]) goes[i] = walk.proceed(batch[i], stage.settings.max_depth);
    }
  }
  int bright = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    CHECK_FALSE(goes[i]);
    CHECK(batch[i].found.radiance == alone[i]);
    bright += is_black(alone[i]) ? 0 : 1;
  }
  CHECK(bright > 10);
}

TEST_CASE("a copy of a path continues as the path does, and apart from it") {
  Stage stage;
  const Walk walk(stage.shared, stage.context, stage.arenas, stage.counters, stage.recorder);
  int split = 0;
  for (int i = 0; i < kEdge * kEdge; ++i) {
    Flight flight = begun(stage, i);
    if (!walk.begin(flight) || !walk.proceed(flight, 12)) continue;
    Flight copy = flight;
    Flight other = flight;
    other.path.first_bounce = 100;  // selects other random numbers
    while (walk.proceed(other, 12)) continue;
    while (walk.proceed(flight, 12)) continue;
    while (walk.proceed(copy, 12)) continue;
    CHECK(copy.found.radiance == flight.found.radiance);
    CHECK(copy.path.bounce == flight.path.bounce);
    split += other.found.radiance == flight.found.radiance ? 0 : 1;
  }
  CHECK(split > 10);
}

TEST_CASE("a path has at most as many branches as the settings allow") {
  Stage stage;
  for (const std::uint32_t most : {0u, 1u, 5u, 100u}) {
    stage.settings.most_branches = most;
    const std::uint32_t branches = branches_of(stage, Factor(1.7f));
    CHECK((branches > 0) == (most > 0));
  }
  CHECK(branches_of(stage, Factor(0.7f)) == 0);
}

TEST_CASE("paths of a unit are recorded until its log is full, and traced in any case") {
  Stage stage;
  stage.settings.most_branches = 20;
  const Factor rule(2.5f);
  stage.shared.termination = &rule;
  constexpr std::size_t kMost = 1000;
  PathLog all, first;
  first.set_most_records(kMost);
  const auto record = [&](PathLog& log) {
    LogRecorder recorder(log);
    const CameraWalk<LogRecorder> walk(stage.shared, stage.context, stage.arenas, stage.counters,
                                       recorder);
    std::vector<Rgb> found;
    for (int i = 0; i < kEdge * kEdge; ++i) {
      found.push_back(walk.run(stage.stream(i), stage.settings.max_depth).radiance);
    }
    return found;
  };
  CHECK(record(all) == record(first));
  REQUIRE(first.size() > 1);
  CHECK(first.size() < all.size());
  std::size_t before_last = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].film == all[i].film);
    CHECK(first[i].vertices.size() == all[i].vertices.size());
    CHECK(first[i].light_samples.size() == all[i].light_samples.size());
    if (i + 1 == first.size()) break;
    before_last += first[i].vertices.size() + first[i].light_samples.size();
  }
  CHECK(before_last < kMost);
  // Logs are saved as they lie in memory.
  const PathView last = first[first.size() - 1];
  const std::size_t records = before_last + last.vertices.size() + last.light_samples.size();
  CHECK(test::saved(first).size() < 200 * records);
}

TEST_CASE("branches take nothing from the heap once a work unit has served its largest path") {
  Stage stage;
  stage.settings.most_branches = 200;
  const Factor rule(2.5f);
  stage.shared.termination = &rule;
  const Walk walk(stage.shared, stage.context, stage.arenas, stage.counters, stage.recorder);
  const auto run = [&] {
    for (int i = 0; i < kEdge * kEdge; ++i) walk.run(stage.stream(i), stage.settings.max_depth);
  };
  run();
  const std::uint64_t before = testing::allocation_count();
  run();
  CHECK(testing::allocation_count() == before);
}

TEST_CASE("a path with what is known of its counterparts can be copied, too") {
  Stage stage;
  Arena backward;
  LightSelector emitting(stage.scene, LightSelection::one);
  const LightChoices choices{stage.lights, emitting};
  using Counterparts = LightCounterparts<>;
  using BidirectionalWalk = CameraWalk<SilentRecorder, Counterparts>;
  const BidirectionalWalk walk(stage.shared, stage.context, stage.arenas, stage.counters,
                               stage.recorder);
  for (int i = 0; i < kEdge * kEdge; ++i) {
    const SampleStream stream = stage.stream(i);
    BidirectionalWalk::InFlight flight{Path(stream),
                                       {},
                                       Counterparts(stage.target, choices, stage.context,
                                                    stream.get_2d({Purpose::lens}), backward)};
    if (!walk.begin(flight)) continue;
    BidirectionalWalk::InFlight copy(flight);
    while (walk.proceed(flight, 12)) continue;
    while (walk.proceed(copy, 12)) continue;
    CHECK(copy.found.radiance == flight.found.radiance);
  }
}

TEST_CASE("records of paths from lights are linked and weighted like those from the sensor") {
  Stage stage;
  const LightScene lights{stage.target, stage.lights, 6};
  PathLog log;
  SplatRecorder<LogRecorder> recorder(6, log);
  const LightWalk<SplatRecorder<LogRecorder>> walk(lights, stage.context, stage.arenas,
                                                   stage.counters, recorder);
  for (int i = 0; i < 32; ++i) walk.run(stage.stream(i));
  REQUIRE(log.size() == 32);
  int longer = 0;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const PathView path = log[i];
    CHECK(path.transport == Transport::importance);
    longer += path.vertices.size() > 2 ? 1 : 0;
    for (std::size_t k = 1; k < path.vertices.size(); ++k) {
      const RecordedVertex& parent = path.vertices[path.vertices[k].parent];
      CHECK(parent.next == k);
      CHECK(mean(parent.throughput * parent.local_weight) ==
            doctest::Approx(mean(path.vertices[k].throughput)).epsilon(1e-4));
    }
  }
  CHECK(longer > 10);
}

}  // namespace pharos
