// Tests of recorded paths. The records must add up to the contributions of the paths.

#include <pharos/rendering/integrator.h>

#include "made_up.h"

namespace pharos::testing {
namespace {

/// One work unit that covers the whole film of a config, with or without recording.
struct Unit {
  explicit Unit(const std::string& yaml)
      : loaded(config_from(yaml)),
        config(loaded.config),
        scene(config.scene),
        sensor(scene.sensor().prepare(config.film.width, config.film.height)),
        integrator(
            config.integrator->prepare({scene, *sensor, config.film.width, config.film.height})),
        sampler(config.sampler->prepare({config.film.width, config.film.height}, {}, nullptr)),
        film(config.film.width, config.film.height, config.film.filter) {}

  WorkResult render(bool record, const GuidingFrame* guides = nullptr,
                    const TerminationRule* rule = nullptr) {
    const PixelRect all{0, 0, config.film.width, config.film.height};
    WorkResult result{.film = film.make_tile(all)};
    integrator->render(
        {all, 0, 0, 2},
        {.sampler = *sampler, .seed = 7, .guiding = guides, .record = record, .termination = rule},
        result);
    return result;
  }

  LoadedConfig loaded;
  const RenderConfig& config;
  Scene scene;
  std::unique_ptr<const PreparedSensor> sensor;
  std::unique_ptr<const PreparedIntegrator> integrator;
  std::unique_ptr<const PreparedSampler> sampler;
  Film film;
};

/// Checks that the density of a step is the sum of its techniques' densities times their shares.
/// Returns the number of steps in which guides took part.
int check_techniques(const PathView& path) {
  int guided = 0;
  for (const RecordedVertex& vertex : path.vertices) {
    double shares = 0, pdf = 0;
    for (const Technique& technique : path.techniques(vertex)) {
      shares += technique.share;
      pdf += double{technique.share} * technique.density;
    }
    CHECK(vertex.pdf == doctest::Approx(pdf).epsilon(1e-4));
    if (vertex.next != kNoVertex) CHECK(shares == doctest::Approx(1).epsilon(1e-4));
    const bool takes_part = path.techniques(vertex).size() > 1;
    if (takes_part) CHECK(vertex.mixing_key != kNoMixing);
    guided += takes_part ? 1 : 0;
  }
  return guided;
}

/// Numbers of MIS weights that would be different without guides.
struct DifferentWeights {
  int of_emission = 0, of_light_samples = 0;
};

/// Checks MIS weights without guides: light that a path hits weighs less than with guides exactly
/// if unguided sampling is less likely to hit it.
void check_unguided_weights(const PathView& path, DifferentWeights& different) {
  for (const RecordedVertex& vertex : path.vertices) {
    const double with = mean(vertex.emission), without = mean(vertex.unguided_emission);
    if (with == without) continue;
    ++different.of_emission;
    REQUIRE(vertex.parent != kNoVertex);
    const RecordedVertex& parent = path.vertices[vertex.parent];
    CHECK((without < with) == (path.techniques(parent)[0].density < parent.pdf));
  }
  for (const RecordedLightSample& light : path.light_samples) {
    CHECK(light.mis_weight > 0);
    CHECK(light.mis_weight <= 1);
    CHECK(light.unguided_mis_weight > 0);
    CHECK(light.unguided_mis_weight <= 1);
    different.of_light_samples += light.unguided_mis_weight != light.mis_weight ? 1 : 0;
  }
}

void check_record(const std::string& yaml, const GuidingFrame* guides = nullptr) {
  Unit unit(yaml);
  WorkResult recorded = unit.render(true, guides);
  CHECK(recorded.log.size() == 2u * 32 * 32);

  double sum = 0, sum_of_unguided_weights = 0;
  int guided = 0;
  DifferentWeights different;
  std::vector<Rgb> incident;
  for (std::size_t p = 0; p < recorded.log.size(); ++p) {
    const PathView path = recorded.log[p];
    estimate_incident_radiance(path, incident);
    guided += check_techniques(path);
    check_unguided_weights(path, different);
    const auto& vertices = path.vertices;
    REQUIRE(vertices.front().kind == VertexKind::sensor);
    Rgb direct, with_unguided_weights;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      direct += vertices[i].throughput * vertices[i].emission;
      with_unguided_weights += vertices[i].throughput * vertices[i].unguided_emission;
      if (i == 0) continue;
      const RecordedVertex& parent = vertices[vertices[i].parent];
      const Rgb arrived = parent.throughput * parent.local_weight;
      CHECK(mean(arrived) == doctest::Approx(mean(vertices[i].throughput)).epsilon(1e-4));
      CHECK(length(vertices[i].position - parent.position) > 0);
    }
    for (const RecordedLightSample& light : path.light_samples) {
      direct += vertices[light.vertex].throughput * light.contribution;
      with_unguided_weights += vertices[light.vertex].throughput * light.contribution *
                               (light.unguided_mis_weight / light.mis_weight);
    }
    // All light that a camera path finds arrives through its first segment.
    const Rgb through_first = vertices[0].local_weight * incident[0];
    CHECK(mean(through_first) == doctest::Approx(mean(direct)).epsilon(1e-4));
    sum += mean(direct);
    sum_of_unguided_weights += mean(with_unguided_weights);
  }
  // MIS weights of unguided paths sum to 1, too, so they estimate the same image.
  CHECK(sum_of_unguided_weights == doctest::Approx(sum).epsilon(0.05));
  CHECK((guided > 0) == (guides != nullptr));
  CHECK((different.of_emission > 0) == (guides != nullptr));
  CHECK((different.of_light_samples > 0) == (guides != nullptr));

  unit.film.merge(recorded.film);
  unit.film.end_pass(2);
  CHECK(image_mean(unit.film.layers()) == doctest::Approx(sum / (2.0 * 32 * 32)).epsilon(1e-4));
}

/// The mean over all pixels of the config's image, and the recorded paths.
struct Rendered {
  explicit Rendered(const std::string& yaml) : unit(yaml), result(unit.render(true)) {
    unit.film.merge(result.film);
    unit.film.end_pass(2);
    mean = image_mean(unit.film.layers());
  }
  Unit unit;
  WorkResult result;
  double mean = 0;
};

/// Returns the same config with another integrator.
std::string with_integrator(std::string config, const std::string& integrator) {
  const std::string path = "type: path\n";
  return config.replace(config.find(path), path.size(), "type: " + integrator + "\n");
}

/// Returns the contribution to the image of a path's vertices from number `first` on, and of its
/// light samples.
double value_of(const PathView& path, std::size_t first, WeightedAmong among) {
  const bool jointly = among == WeightedAmong::both_ends;
  Rgb sum;
  for (std::size_t i = first; i < path.vertices.size(); ++i) {
    const RecordedVertex& v = path.vertices[i];
    sum += v.throughput * (jointly ? v.joint_emission : v.emission);
  }
  for (const RecordedLightSample& light : path.light_samples) {
    sum += path.vertices[light.vertex].throughput *
           (jointly ? light.joint_contribution : light.contribution);
  }
  return mean(sum);
}

/// Checks that paths from both ends add up to the image. Lights that are seen directly are not
/// recorded from the light's side, so only paths of more than one segment count.
void check_joint_record(const std::string& scene, int depth) {
  const std::string guiding =
      "{ learner: { type: vertex_triplets, light_paths: true }, guider: { type: vertex_triplets, "
      "guide_camera: false } }";
  const auto config = [&](int d) { return path_config(scene, d, guiding, 2); };
  const Rendered all(with_integrator(config(depth), "bidirectional"));
  const Rendered direct(with_integrator(config(1), "bidirectional"));
  const std::string plain = "{ learner: uniform, guider: uniform }";
  const Rendered path(path_config(scene, depth, plain, 2));
  double jointly = 0, from_lens = 0;
  int from_lights = 0;
  std::vector<Rgb> incident;
  for (std::size_t p = 0; p < all.result.log.size(); ++p) {
    const PathView view = all.result.log[p];
    jointly += value_of(view, 2, WeightedAmong::both_ends);
    if (view.transport == Transport::radiance) {
      from_lens += value_of(view, 0, WeightedAmong::own_end);
    } else {
      ++from_lights;
    }
    estimate_incident_radiance(view, incident, WeightedAmong::both_ends);
    for (std::size_t i = 1; i < view.vertices.size(); ++i) {
      const RecordedVertex& parent = view.vertices[view.vertices[i].parent];
      CHECK(mean(parent.throughput * parent.local_weight) ==
            doctest::Approx(mean(view.vertices[i].throughput)).epsilon(1e-4));
    }
  }
  constexpr double kPaths = 2.0 * 32 * 32;
  CHECK(from_lights == kPaths);
  CHECK(jointly / kPaths == doctest::Approx(all.mean - direct.mean).epsilon(1e-3));
  CHECK(from_lens / kPaths == doctest::Approx(path.mean).epsilon(1e-4));
}

TEST_CASE("records of paths from both ends add up to the image") {
  check_joint_record(kDiffuseScene, 4);
  check_joint_record(kGlassInFogScene, 20);
}

TEST_CASE("records add up to the image") {
  check_record(path_config(kDiffuseScene, 4, "", 2));
  check_record(path_config(kGlassInFogScene, 20, "", 2));
}

TEST_CASE("records of guided paths add up to the image, too") {
  const MadeUpLearning learning(
      "{ methods: [ { learner: stub_direction, guider: stub_direction }, "
      "{ learner: stub_vertices, guider: stub_vertices } ] }");
  GuidingState state = learning.begin();
  state.absorb(lit_path());
  state.update({0, 0});
  check_record(path_config(kDiffuseScene, 4, "", 2), state.frame().get());
  check_record(path_config(kGlassInFogScene, 20, "", 2), state.frame().get());
}

/// Returns a config of path tracing with a factor at every vertex.
std::string with_factor(std::string config, double factor, double lights = 1) {
  const std::string path = "type: path\n";
  return config.insert(
      config.find(path) + path.size(),
      fmt::format("  termination: {{ type: stub_factor, factor: {}, lights: {} }}\n", factor,
                  lights));
}

TEST_CASE("records of paths that split or survive roulette add up to the image") {
  for (const double factor : {0.6, 1.4, 3.0}) {
    CAPTURE(factor);
    for (const double lights : {0.5, 1.0, 2.3}) {
      check_record(with_factor(path_config(kDiffuseScene, 4, "", 2), factor, lights));
    }
  }
  for (const double factor : {0.8, 1.2}) {
    CAPTURE(factor);
    check_record(with_factor(path_config(kGlassInFogScene, 20, "", 2), factor));
  }
}

TEST_CASE("records of branches: one for each step, with its weight and random numbers") {
  Unit unit(with_factor(path_config(kDiffuseScene, 3, "", 2), 2.5));
  const WorkResult result = unit.render(true);
  double weights = 0;
  std::size_t steps = 0, firsts = 0;
  for (std::size_t p = 0; p < result.log.size(); ++p) {
    const PathView path = result.log[p];
    std::uint32_t branches = 0;
    for (const RecordedVertex& vertex : path.vertices) {
      if (vertex.twin != kNoVertex) {
        const RecordedVertex& twin = path.vertices[vertex.twin];
        CHECK(twin.position == vertex.position);
        CHECK(twin.parent == vertex.parent);
        CHECK(twin.branch > branches);
        CHECK(twin.direction != vertex.direction);
        CHECK(is_black(twin.emission));
        branches = twin.branch;
      }
      if (vertex.parent != 0) continue;  // the first vertex after the lens
      CHECK(vertex.continuation == doctest::Approx(1 / 2.5));
      firsts += path.vertices[0].next == &vertex - path.vertices.data() ? 1 : 0;
      weights += vertex.continuation;
      ++steps;
    }
    for (std::size_t i = 1; i < path.light_samples.size(); ++i) {
      CHECK(path.light_samples[i - 1].vertex <= path.light_samples[i].vertex);
    }
  }
  CHECK(static_cast<double>(steps) / firsts == doctest::Approx(2.5).epsilon(0.02));
  CHECK(weights / firsts == doctest::Approx(1).epsilon(0.02));
}

TEST_CASE("records of light samples that split: their numbers, weights and copies") {
  Unit unit(with_factor(path_config(kDiffuseScene, 3, "", 2), 1.5, 1.5));
  const WorkResult result = unit.render(true);
  double lights = 0;
  std::size_t firsts = 0;
  for (std::size_t p = 0; p < result.log.size(); ++p) {
    const PathView path = result.log[p];
    for (std::uint32_t i = 1; i < path.vertices.size(); ++i) {
      const RecordedVertex& vertex = path.vertices[i];
      const bool is_first = path.vertices[vertex.parent].next == i;
      if (!is_first) CHECK(vertex.light_samples == 0);
      if (!is_first || vertex.light_samples == 0) continue;
      std::uint32_t records = 0;
      for (std::uint32_t k = i; k != kNoVertex; k = path.vertices[k].twin) ++records;
      CHECK(vertex.light_samples == records);  // each step has a light sample
      lights += vertex.light_samples;
      ++firsts;
    }
    for (const RecordedLightSample& sample : path.light_samples) {
      CHECK(sample.continuation == doctest::Approx(1 / 1.5));
      CHECK(sample.copy < path.vertices[sample.vertex].light_samples);
    }
  }
  CHECK(lights / static_cast<double>(firsts) == doctest::Approx(1.5).epsilon(0.02));
}

/// Splits nothing. Checks that without light or media on the way, the throughput at the first
/// vertex is the weight of the film position, and that the rest of the path keeps it.
class FilmWeights final : public TerminationRule {
 public:
  BranchFactors factors(const TerminationQuery& query) const override {
    if (query.bounce == 1) {
      weight_ = query.throughput.g;
      different_ += weight_ != 1 ? 1 : 0;
    }
    CHECK(query.film_weight == doctest::Approx(weight_));
    return {};
  }
  int different() const { return different_; }

 private:
  mutable float weight_ = 0;
  mutable int different_ = 0;
};

TEST_CASE("terminations are told how much more often a guide of the camera chooses a position") {
  const MadeUpLearning learning("{ learner: stub_camera, guider: stub_camera }");
  GuidingState state = learning.begin();
  state.update({0, 0});
  Unit unit(path_config(kDiffuseScene, 4, "", 2));
  FilmWeights even, guided;
  unit.render(false, nullptr, &even);
  CHECK(even.different() == 0);
  unit.render(false, state.frame().get(), &guided);
  CHECK(guided.different() > 100);
}

TEST_CASE("records have the features of the first surface") {
  Unit unit(path_config(kDiffuseScene, 3, "", 2));
  const WorkResult result = unit.render(true);
  for (std::size_t p = 0; p < result.log.size(); ++p) {
    const PathView path = result.log[p];
    const bool hits = path.vertices.size() > 1 && path.vertices[1].kind == VertexKind::surface;
    CHECK(length(path.normal) == doctest::Approx(hits ? 1 : 0));
    CHECK(is_black(path.albedo) == !hits);
  }
}

TEST_CASE("recording changes nothing") {
  Unit unit(path_config(kGlassInFogScene, 20, "", 2));
  Film silent = unit.film, recorded = unit.film;
  const WorkResult quiet = unit.render(false);
  CHECK(quiet.log.size() == 0);
  silent.merge(quiet.film);
  recorded.merge(unit.render(true).film);
  silent.end_pass(2);
  recorded.end_pass(2);
  const Image a = silent.layers(), b = recorded.layers();
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) REQUIRE(a.rgb(x, y) == b.rgb(x, y));
  }
}

TEST_CASE("records of a unit have a limit, which changes nothing else") {
  const std::string config = with_factor(path_config(kDiffuseScene, 4, "", 2), 2.5);
  const std::string path = "type: path\n";
  std::string limited = config;
  limited.insert(config.find(path) + path.size(), "  most_records: 5000\n");
  const Rendered all(config), first(limited);
  CHECK(all.result.log.size() == 2u * 32 * 32);
  REQUIRE(first.result.log.size() > 10);
  CHECK(first.result.log.size() < all.result.log.size() / 2);
  CHECK(first.mean == all.mean);
  std::size_t records = 0;
  for (std::size_t i = 0; i + 1 < first.result.log.size(); ++i) {
    records += first.result.log[i].vertices.size() + first.result.log[i].light_samples.size();
  }
  CHECK(records < 5000);
}

TEST_CASE("incident radiance follows branches") {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .local_weight = Rgb(1)});
  // A vertex from which two steps were taken is recorded twice.
  log.add(RecordedVertex{.parent = 0, .local_weight = Rgb(0.25f)});
  log.add(RecordedVertex{.parent = 0, .local_weight = Rgb(0.75f)});
  log.add(RecordedVertex{.parent = 1, .emission = Rgb(4)});
  log.add(RecordedVertex{.parent = 2, .emission = Rgb(8)});
  log.add(RecordedLightSample{.vertex = 4, .contribution = Rgb(2)});
  const std::span<const RecordedVertex> vertices = log[0].vertices;
  CHECK(vertices[0].next == 1);
  CHECK(vertices[1].twin == 2);
  CHECK(vertices[2].twin == kNoVertex);
  CHECK(vertices[1].next == 3);
  CHECK(vertices[2].next == 4);
  std::vector<Rgb> incident;
  estimate_incident_radiance(log[0], incident);
  CHECK(incident[1] == Rgb(4));
  CHECK(incident[2] == Rgb(10));
  CHECK(incident[0] == Rgb(0.25f * 4 + 0.75f * 10));
  CHECK(incident[4] == Rgb());
}

}  // namespace
}  // namespace pharos::testing
