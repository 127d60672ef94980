#include <cmath>
#include <functional>
#include <sstream>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <pharos/conformance/fit.h>
#include <pharos/conformance/guided.h>
#include <pharos/conformance/numbers_check.h>
#include <pharos/conformance/resampling_check.h>
#include <pharos/conformance/suites.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::conformance {
namespace {

constexpr std::uint32_t kTrainingSamples = 48;

/// Tests directions that end on a surface against their density [1/sr].
void test_surfaces(const Guided& guide, std::uint64_t seed, Check& chi_square, Check& integral) {
  const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
    const auto v = guide.draw(random);
    if (!v || v->kind == VertexKind::volume || is_discrete(v->event)) return std::nullopt;
    return v->direction;
  };
  const auto density = [&](Vec3 direction) {
    return guide.scatters_into(direction) ? guide.density(guide.end_along(direction)) : 0.0;
  };
  test_directions({draw, density, guide.vertex().text(), 0, 1e-3, 40'000}, seed, chi_square,
                  integral);
}

/// Tests vertices in a medium against their density [1/(sr m)]. Draws are counted in eight octants
/// of directions and two halves of distances. Their shares must match the mean of the density over
/// uniform vertices in the same cells.
void test_volumes(const Guided& guide, std::uint64_t seed, Check& chi_square, Check& integral) {
  constexpr std::size_t kCells = 16, kDraws = 30'000;
  const auto cell_of = [&](const ResolvedVertex& v, float whole) {
    const Vec3 d = v.direction;
    return static_cast<std::size_t>((d.x > 0) | (d.y > 0) << 1 | (d.z > 0) << 2 |
                                    (v.distance > 0.5f * whole) << 3);
  };
  std::vector<std::vector<double>> drawn(kCells + 1, std::vector<double>(kDraws));
  std::vector<std::vector<double>> claimed = drawn;
  // The share of the medium in a cell, estimated from the density at a vertex on a line that long.
  const auto share_at = [&](const ResolvedVertex& v, float whole) {
    return guide.density(v) * whole / warp::sphere_pdf();
  };
  // Sums of these shares over draws.
  std::vector<double> shares(kCells + 1, 0);
  RandomStream random(seed, 1);
  for (std::size_t i = 0; i < kDraws; ++i) {
    if (const auto v = guide.draw(random); v && v->kind == VertexKind::volume) {
      const float whole = guide.end_along(v->direction).distance;
      for (const std::size_t cell : {cell_of(*v, whole), kCells}) {
        drawn[cell][i] = 1;
        shares[cell] += share_at(*v, whole);
      }
    }
    const ResolvedVertex end = guide.end_along(warp::sphere_from_square(random.next_2d()));
    const ResolvedVertex v = guide.stopped(end, random.next_1d() * end.distance);
    if (!guide.scatters_into(v.direction)) continue;
    claimed[cell_of(v, end.distance)][i] = claimed[kCells][i] = share_at(v, end.distance);
  }
  for (std::size_t cell = 0; cell <= kCells; ++cell) {
    auto a = statistics::estimate(statistics::moments(drawn[cell]));
    auto b = statistics::estimate(statistics::moments(claimed[cell]));
    // The variance of rare draws is estimated too low. Without any draw it would be zero.
    constexpr double kFew = 5;
    a.squared_error = std::max(a.squared_error, std::max(b.mean, kFew / kDraws) / kDraws);
    // Uniform vertices may miss a narrow lobe, and then show nothing of their variance. Draws find
    // the lobe. Their mean share is the mean squared share of uniform vertices.
    b.squared_error = std::max(b.squared_error, shares[cell] / kDraws / kDraws);
    (cell == kCells ? integral : chi_square)
        .add_p_value(
            statistics::welch_test(a, b).p_value,
            fmt::format("{}: a share {:.4f} of draws ends in the medium ({}), the density "
                        "says {:.4f}",
                        guide.vertex().text(), a.mean,
                        cell == kCells ? "anywhere" : fmt::format("cell {}", cell), b.mean));
  }
}

/// Tests the frequencies of discrete events that end on a surface against their probabilities [1].
void test_outcomes(const Guided& guide, std::uint64_t seed, Check& chi_square, Check& integral) {
  constexpr int kDraws = 20'000;
  const DiscreteOutcomes outcomes = guide.vertex().scattering().discrete();
  std::vector<double> expected, observed(static_cast<std::size_t>(outcomes.count) + 1);
  double rest = 1;
  for (const DiscreteOutcome& o : outcomes) {
    const double p = guide.density(guide.vertex().surface_along(o.direction, o.event));
    expected.push_back(kDraws * p);
    rest -= p;
  }
  integral.expect(rest >= -1e-4, [&] {
    return fmt::format("{}: probabilities of discrete events add up to {}", guide.vertex().text(),
                       1 - rest);
  });
  RandomStream random(seed, 2);
  for (int i = 0; i < kDraws; ++i) {
    std::size_t which = static_cast<std::size_t>(outcomes.count);
    if (const auto v = guide.draw(random); v && v->kind != VertexKind::volume) {
      for (int k = 0; k < outcomes.count; ++k) {
        if (outcomes.outcomes[static_cast<std::size_t>(k)].event == v->event) {
          which = static_cast<std::size_t>(k);
        }
      }
    }
    ++observed[which];
  }
  expected.push_back(kDraws * std::max(rest, 0.0));
  chi_square.add_p_value(statistics::chi_square_test(observed, expected).p_value,
                         guide.vertex().text() + ": frequencies of discrete events");
}

/// Tests the densities at all vertices of the stage. Returns at how many of them the guide has an
/// answer.
int check_densities(const GuidingFrame& frame, const Scene& scene, std::uint64_t seed,
                    Transport transport, Check& chi_square, Check& integral) {
  int answers = 0;
  for (const auto& vertex : stage_vertices(scene, seed, transport)) {
    const Guided guide(frame, *vertex);
    if (guide.declines()) continue;
    ++answers;
    if (vertex->scattering().purely_discrete()) {
      test_outcomes(guide, seed, chi_square, integral);
      continue;
    }
    test_surfaces(guide, seed, chi_square, integral);
    if (vertex->medium() != nullptr) test_volumes(guide, seed, chi_square, integral);
  }
  return answers;
}

/// Tests the guide's proposals for the first vertex: directions from the lens that lie on the film.
/// Returns whether the guide has an answer.
bool check_camera(const GuidingFrame& frame, const Scene& scene, std::uint64_t seed,
                  Check& chi_square, Check& integral) {
  const auto sensor = scene.sensor().prepare(16, 16);
  const LensPoint lens = sensor->sample_lens({0.5f, 0.5f});
  Arena arena;
  GuidingQuery query{.current = {.position = lens.position,
                                 .normal = lens.normal,
                                 .shading_normal = lens.normal,
                                 .kind = VertexKind::sensor},
                     .towards_previous = lens.normal,
                     .bounce = 0};
  const Guidance guide = frame.query(query, arena);
  if (!guide.is_guided()) return false;
  const KeyedSampler numbers;
  const auto seen = [&](Vec3 direction) -> std::optional<ResolvedVertex> {
    if (!sensor->response(lens, direction)) return std::nullopt;
    SurfacePoint hit;
    const float distance = scene.intersect({lens.position, direction}, hit);
    return ResolvedVertex{
        .direction = direction,
        .distance = distance,
        .position = hit.position,
        .kind = std::isinf(distance) ? VertexKind::environment : VertexKind::surface,
        .event = Event::smooth_reflect};
  };
  const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
    const SampleStream path(numbers, {.seed = 78, .index = random()});
    const VertexStream stream(path, 0);
    const auto proposal = guide.propose(stream, stream.get_1d(Purpose::guide_choice));
    const auto first = proposal ? seen(proposal->direction) : std::nullopt;
    if (!first || !proposal->accepts(first->kind, first->position)) return std::nullopt;
    return first->direction;
  };
  const auto density = [&](Vec3 direction) -> double {
    const auto first = seen(direction);
    return first ? guide.density(*first) : 0;
  };
  test_directions({draw, density, "from the lens", 0, 1e-3, 40'000}, seed, chi_square, integral);
  return true;
}

/// Tests what a model reports about vertices before its guider is asked.
void check_places(const GuidingModel& model, const Scene& scene, std::uint64_t seed, Check& check) {
  const std::uint32_t regions = model.info().regions;
  for (const auto& vertex : stage_vertices(scene, seed)) {
    const Place place = model.place(vertex->query().current);
    check.expect(place.region < regions, [&] {
      return fmt::format("{}: region {} of {}", vertex->text(), place.region, regions);
    });
    check.expect(is_non_negative(place.evidence),
                 [&] { return fmt::format("{}: evidence {}", vertex->text(), place.evidence); });
  }
}

bool same(const std::optional<Proposal>& a, const std::optional<Proposal>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->direction == b->direction && a->events == b->events && a->reach == b->reach &&
         a->distance == b->distance && a->targets == b->targets &&
         (a->within == nullptr) == (b->within == nullptr);
}

/// Tests that two guides give the same answers at every vertex of a scene.
void expect_alike(const GuidingFrame& a, const GuidingFrame& b, const Scene& scene,
                  std::uint64_t seed, const char* difference, Check& check) {
  for (const auto& vertex : stage_vertices(scene, seed)) {
    const Guided first(a, *vertex), second(b, *vertex);
    const auto fault = [&] { return vertex->text() + ": " + difference; };
    check.expect(first.declines() == second.declines(), fault);
    if (first.declines() || second.declines()) continue;
    for (std::uint64_t path = 0; path < 100; ++path) {
      const auto p = first.propose(path), q = second.propose(path);
      check.expect(same(p, q), fault);
      if (!p || is_empty(p->events & EventMask::smooth)) continue;
      const ResolvedVertex v = first.end_along(p->direction);
      check.expect(close(first.density(v), second.density(v), 1e-5), fault);
    }
  }
}

std::shared_ptr<const GuidingModel> saved_and_loaded(const GuidingModel& model,
                                                     const Learner& learner) {
  std::stringstream file;
  save(file, model);
  const std::shared_ptr<GuidingModel> loaded = learner.empty_model();
  load(file, *loaded);
  return loaded;
}

void check_save_load(const GuidedPair& pair, const std::shared_ptr<const GuidingModel>& model,
                     const Scene& scene, std::uint64_t seed, Check& check) {
  const ModelInfo learned = model->info(), stated = pair.the_learner().empty_model()->info();
  check.expect(learned.name == stated.name && learned.version == stated.version, [&] {
    return fmt::format("the model is '{}' of version {}, empty_model() is '{}' of version {}",
                       learned.name, learned.version, stated.name, stated.version);
  });
  try {
    const auto loaded = saved_and_loaded(*model, pair.the_learner());
    expect_alike(frame_of(pair.the_guider(), model), frame_of(pair.the_guider(), loaded), scene,
                 seed, "a model that was saved and loaded is sampled otherwise", check);
  } catch (const Error& e) {
    check.expect(false,
                 [&] { return std::string("what was saved cannot be loaded: ") + e.what(); });
  }
}

/// Tests that guided and unguided renders of a furnace have the same mean.
void check_furnace(const GuidedPair& pair, const Ref<Integrator>& guided, bool foggy,
                   std::uint64_t seed, Check& check) {
  const Ref<Integrator> plain = unguided(pair, *guided);
  compare_in_furnace(pair.registry, {guided, "guided"}, {plain, "unguided"}, foggy, seed, check);
}

}  // namespace

void check_guider(const Registry& registry, const Subject& guider, const Subject& learner,
                  Suite& suite) {
  const GuidedPair pair{registry, guider, learner};
  Check& answers = suite.check("answers");
  Check& chi_square = suite.check("chi_square");
  Check& integral = suite.check("integral");
  Check& determinism = suite.check("determinism");
  Check& save_load = suite.check("save_load");
  Check& furnace = suite.check("furnace");
  Check& places = suite.check("places");
  Check& resampling = suite.check("resampling");
  Check& numbers = suite.check("numbers");
  std::string why_not;
  const std::vector<Ref<Integrator>> integrators = integrators_for(pair, why_not);
  if (integrators.empty()) {
    why_not = "no integrator can follow: " + why_not;
    for (Check* c : {&answers, &chi_square, &integral, &determinism, &save_load, &furnace, &places,
                     &resampling, &numbers}) {
      c->not_applicable(why_not);
    }
    return;
  }
  for (Check* c : {&chi_square, &integral, &determinism, &save_load, &numbers}) {
    c->not_applicable("the guide knows nothing at any vertex");
  }
  places.not_applicable("there is no model");
  const bool steers_distance = pair.the_guider().traits().steers_distance;
  resampling.not_applicable(steers_distance ? "the guider steers distances"
                                            : "the model knows no radiance around vertices");
  const bool guides_light_paths = pair.the_guider().traits().guides_light_paths;
  int answered = 0;
  for (const bool foggy : {false, true}) {
    check_furnace(pair, integrators.front(), foggy, suite.seed(), furnace);
    for (std::size_t i = 1; guides_light_paths && i < integrators.size(); ++i) {
      check_furnace(pair, integrators[i], foggy, suite.seed(), furnace);
    }
    const auto model = render_room(registry, integrators.front(), Room::lamp, foggy,
                                   kTrainingSamples, suite.seed())
                           .model;
    answers.expect(model != nullptr, [] { return "there is no model after training"; });
    if (model == nullptr) continue;
    const Scene scene(room_parts(Room::lamp, foggy));
    check_places(*model, scene, suite.seed(), places);
    if (!steers_distance) {
      check_resampling(pair.the_guider(), model, scene, suite.seed(), resampling);
    }
    const GuidingFrame frame = frame_of(pair.the_guider(), model);
    answered +=
        check_densities(frame, scene, suite.seed(), Transport::radiance, chi_square, integral);
    check_numbers(frame, scene, suite.seed(), Transport::radiance, numbers);
    if (guides_light_paths) {
      check_densities(frame, scene, suite.seed(), Transport::importance, chi_square, integral);
      check_numbers(frame, scene, suite.seed(), Transport::importance, numbers);
    }
    if (!foggy) answered += check_camera(frame, scene, suite.seed(), chi_square, integral) ? 1 : 0;
    expect_alike(frame, frame_of(pair.the_guider(), model), scene, suite.seed(),
                 "asked again, the guide answers otherwise", determinism);
    check_save_load(pair, model, scene, suite.seed(), save_load);
  }
  answers.expect(answered > 0, [] { return "the guide declines at every vertex"; });
}

void check_learner(const Registry& registry, const Subject& learner, const Subject& guider,
                   Suite& suite) {
  const GuidedPair pair{registry, guider, learner};
  Check& check = suite.check("determinism");
  std::string why_not;
  const std::vector<Ref<Integrator>> integrators = integrators_for(pair, why_not);
  if (integrators.empty()) return check.not_applicable("no integrator can follow: " + why_not);
  const auto trained = [&] {
    const auto model = render_room(registry, integrators.front(), Room::lamp, false,
                                   kTrainingSamples, suite.seed())
                           .model;
    check.expect(model != nullptr, [] { return "there is no model after training"; });
    std::ostringstream file;
    if (model != nullptr) save(file, *model);
    return file.str();
  };
  tbb::task_arena one_thread(1);
  check.expect(one_thread.execute(trained) == trained(), [] {
    return "the models of two trainings, with one thread and with all, are saved as other bytes";
  });
}

}  // namespace pharos::conformance
