// Tests of recorded paths: links between vertices, techniques, and logs that are saved and loaded.

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/guiding/record/path_record.h>
#include <pharos/guiding/toolkit/guidable_steps.h>
#include <pharos/tests/fixtures.h>
#include <pharos/transport/scatter_step.h>

namespace pharos {
namespace {

using test::saved;

using Indices = std::vector<std::uint32_t>;

/// Returns the vertices that a step from vertex `i` led to, by following links.
Indices linked_children(const PathView& path, std::uint32_t i) {
  Indices children;
  for (std::uint32_t k = path.vertices[i].next; k != kNoVertex; k = path.vertices[k].twin) {
    children.push_back(k);
  }
  return children;
}

/// Returns the same vertices by checking the parent of every vertex.
Indices scanned_children(const PathView& path, std::uint32_t i) {
  Indices children;
  for (std::uint32_t k = 0; k < path.vertices.size(); ++k) {
    if (path.vertices[k].parent == i) children.push_back(k);
  }
  return children;
}

/// Adds a path whose vertices have these parents.
void add_tree(PathLog& log, const Indices& parents) {
  log.begin_path({}, Transport::radiance);
  for (const std::uint32_t parent : parents) log.add(RecordedVertex{.parent = parent});
}

/// Returns the parents of a random tree of `count` vertices.
Indices random_parents(std::uint32_t count, RandomStream& random) {
  Indices parents{kNoVertex};
  while (parents.size() < count) {
    parents.push_back(static_cast<std::uint32_t>(random() % parents.size()));
  }
  return parents;
}

/// A sequence of different numbers.
class Numbers {
 public:
  float next() { return 0.25f * static_cast<float>(++count_); }
  Vec3 vector() { return {next(), next(), next()}; }
  Rgb color() { return {next(), next(), next()}; }

 private:
  int count_ = 0;
};

/// Returns a vertex in which all fields have different values.
RecordedVertex full_vertex(Numbers& numbers, std::uint32_t parent) {
  return {.position = numbers.vector(),
          .normal = numbers.vector(),
          .kind = VertexKind::volume,
          .event = Event::smooth_transmit,
          .guidable = true,
          .roughness = numbers.next(),
          .eta = numbers.next(),
          .parent = parent,
          .throughput = numbers.color(),
          .local_weight = numbers.color(),
          .direction = numbers.vector(),
          .pdf = numbers.next(),
          .continuation = numbers.next(),
          .branch = 5,
          .mixing_key = 17,
          .transmittance = numbers.color(),
          .medium_density = numbers.next(),
          .emission = numbers.color(),
          .joint_emission = numbers.color(),
          .unguided_emission = numbers.color()};
}

RecordedLightSample full_light_sample(Numbers& numbers, std::uint32_t vertex) {
  return {.vertex = vertex,
          .position = numbers.vector(),
          .kind = VertexKind::environment,
          .event = Event::smooth_reflect,
          .discrete = true,
          .direction = numbers.vector(),
          .contribution = numbers.color(),
          .joint_contribution = numbers.color(),
          .mis_weight = numbers.next(),
          .unguided_mis_weight = numbers.next()};
}

/// Adds a path that goes two ways from its second vertex, with light samples and techniques.
void add_branching_path(PathLog& log, Numbers& numbers) {
  log.begin_path({numbers.next(), numbers.next()}, Transport::radiance);
  const std::uint32_t lens = log.add(RecordedVertex{.kind = VertexKind::sensor});
  for (int copy = 0; copy < 2; ++copy) {
    const std::uint32_t wall = log.add(full_vertex(numbers, lens));
    log.set_techniques(wall, std::array{Technique{numbers.next(), numbers.next()},
                                        Technique{numbers.next(), numbers.next()},
                                        Technique{numbers.next(), numbers.next()}});
    log.add(full_light_sample(numbers, wall));
    const std::uint32_t end = log.add(full_vertex(numbers, wall));
    log.set_techniques(end, std::array{Technique{1, numbers.next()}});
    log.add(full_light_sample(numbers, end));
    log.add(full_light_sample(numbers, end));
  }
}

/// Adds a path from a light, which finds the lens.
void add_light_path(PathLog& log, Numbers& numbers) {
  log.begin_path({}, Transport::importance);
  const std::uint32_t light = log.add(full_vertex(numbers, kNoVertex));
  const std::uint32_t wall = log.add(full_vertex(numbers, light));
  log.add(full_light_sample(numbers, wall));
}

/// Returns a branching path, a path that ends on the lens, and a path from a light.
PathLog example() {
  Numbers numbers;
  PathLog log;
  add_branching_path(log, numbers);
  log.begin_path({3, 4}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor});
  add_light_path(log, numbers);
  return log;
}

PathLog loaded(const std::string& bytes) {
  std::istringstream in(bytes);
  PathLog log;
  load(in, log);
  return log;
}

void check_equal(const RecordedVertex& a, const RecordedVertex& b) {
  CHECK(a.position == b.position);
  CHECK(a.normal == b.normal);
  CHECK(a.kind == b.kind);
  CHECK(a.event == b.event);
  CHECK(a.guidable == b.guidable);
  CHECK(a.roughness == b.roughness);
  CHECK(a.eta == b.eta);
  CHECK(a.parent == b.parent);
  CHECK(a.next == b.next);
  CHECK(a.twin == b.twin);
  CHECK(a.throughput == b.throughput);
  CHECK(a.local_weight == b.local_weight);
  CHECK(a.direction == b.direction);
  CHECK(a.pdf == b.pdf);
  CHECK(a.continuation == b.continuation);
  CHECK(a.branch == b.branch);
  CHECK(a.mixing_key == b.mixing_key);
  CHECK(a.transmittance == b.transmittance);
  CHECK(a.medium_density == b.medium_density);
  CHECK(a.emission == b.emission);
  CHECK(a.joint_emission == b.joint_emission);
  CHECK(a.unguided_emission == b.unguided_emission);
}

void check_equal(const RecordedLightSample& a, const RecordedLightSample& b) {
  CHECK(a.vertex == b.vertex);
  CHECK(a.position == b.position);
  CHECK(a.kind == b.kind);
  CHECK(a.event == b.event);
  CHECK(a.discrete == b.discrete);
  CHECK(a.direction == b.direction);
  CHECK(a.contribution == b.contribution);
  CHECK(a.joint_contribution == b.joint_contribution);
  CHECK(a.mis_weight == b.mis_weight);
  CHECK(a.unguided_mis_weight == b.unguided_mis_weight);
}

void check_equal(std::span<const Technique> a, std::span<const Technique> b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].share == b[i].share);
    CHECK(a[i].density == b[i].density);
  }
}

void check_equal(const PathView& a, const PathView& b) {
  CHECK(a.film == b.film);
  CHECK(a.transport == b.transport);
  REQUIRE(a.vertices.size() == b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    check_equal(a.vertices[i], b.vertices[i]);
    check_equal(a.techniques(a.vertices[i]), b.techniques(b.vertices[i]));
  }
  REQUIRE(a.light_samples.size() == b.light_samples.size());
  for (std::size_t i = 0; i < a.light_samples.size(); ++i) {
    check_equal(a.light_samples[i], b.light_samples[i]);
  }
}

/// Checks that no link, technique or light sample of a path leads outside it.
void check_within(const PathView& path) {
  const auto count = static_cast<std::uint32_t>(path.vertices.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const RecordedVertex& vertex = path.vertices[i];
    REQUIRE((vertex.parent == kNoVertex || vertex.parent < i));
    for (std::uint32_t at = i, k = vertex.next; k != kNoVertex; k = path.vertices[k].twin) {
      REQUIRE(k < count);
      REQUIRE(k > at);  // links lead to later vertices, so following them ends
      at = k;
    }
    const std::span<const Technique> techniques = path.techniques(vertex);
    const std::span<const Technique> all = path.log_techniques;
    REQUIRE(techniques.data() >= all.data());
    REQUIRE(techniques.data() + techniques.size() <= all.data() + all.size());
  }
  for (const RecordedLightSample& sample : path.light_samples) REQUIRE(sample.vertex < count);
}

/// Uses a path as learners do.
void learn_from(const PathView& path) {
  std::vector<Rgb> incident;
  estimate_incident_radiance(path, incident);
  estimate_incident_radiance(path, incident, WeightedAmong::both_ends);
  for_each_guidable_step(path, incident, [&](const GuidableStep& step) {
    REQUIRE(step.from.next < path.vertices.size());
  });
}

/// Visits everything in a log that was loaded from `bytes` bytes. The records of a path must follow
/// the records of the previous path, and there cannot be more records than bytes.
void walk(const PathLog& log, std::size_t bytes) {
  const RecordedVertex* vertex = log.size() > 0 ? log[0].vertices.data() : nullptr;
  const RecordedLightSample* light = log.size() > 0 ? log[0].light_samples.data() : nullptr;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const PathView path = log[i];
    REQUIRE(path.vertices.data() == vertex);
    REQUIRE(path.light_samples.data() == light);
    REQUIRE(path.vertices.size() + path.light_samples.size() <= bytes);
    vertex += path.vertices.size();
    light += path.light_samples.size();
    check_within(path);
    learn_from(path);
  }
}

/// A guiding distribution with the same density everywhere.
class ConstantDistribution final : public GuidingDistribution {
 public:
  explicit ConstantDistribution(float density) : density_(density) {}
  std::optional<Proposal> propose(const VertexStream&) const override { return std::nullopt; }
  float density(const ResolvedVertex&) const override { return density_; }

 private:
  float density_;
};

}  // namespace

TEST_CASE("a branching path is followed by its links") {
  PathLog log;
  add_tree(log, {kNoVertex, 0, 1});
  // Vertex 1 is recorded three times, as 1, 3 and 6. The third step from it hit nothing.
  add_tree(log, {kNoVertex, 0, 1, 0, 3, 4, 0});
  const PathView path = log[1];
  CHECK(linked_children(path, 0) == Indices{1, 3, 6});
  CHECK(linked_children(path, 1) == Indices{2});
  CHECK(linked_children(path, 3) == Indices{4});
  CHECK(linked_children(path, 4) == Indices{5});
  for (const std::uint32_t end : {2u, 5u, 6u}) CHECK(path.vertices[end].next == kNoVertex);
  for (const std::uint32_t only : {0u, 2u, 4u, 5u}) CHECK(path.vertices[only].twin == kNoVertex);
  // The previous path has its own links.
  CHECK(linked_children(log[0], 0) == Indices{1});
  CHECK(linked_children(log[0], 1) == Indices{2});
}

TEST_CASE("links find the same vertices as a scan of the path") {
  RandomStream random(1);
  PathLog log;
  for (const std::uint32_t count : {1u, 2u, 10u, 100u}) {
    add_tree(log, random_parents(count, random));
    const PathView path = log[log.size() - 1];
    for (std::uint32_t i = 0; i < count; ++i) {
      CHECK(linked_children(path, i) == scanned_children(path, i));
    }
  }
}

TEST_CASE("techniques: those of each step, in any path of the log") {
  PathLog log;
  add_tree(log, {kNoVertex, 0, 1});
  log.set_techniques(1, std::array{Technique{0.5f, 2}, Technique{0.25f, 3}, Technique{0.25f, 4}});
  log.set_techniques(0, std::array{Technique{1, 7}});
  add_tree(log, {kNoVertex, 0});
  log.set_techniques(1, std::array{Technique{0.75f, 5}, Technique{0.25f, 6}});
  const auto of = [&](std::size_t path, std::size_t vertex) {
    return log[path].techniques(log[path].vertices[vertex]);
  };
  check_equal(of(0, 0), std::array{Technique{1, 7}});
  check_equal(of(0, 1), std::array{Technique{0.5f, 2}, Technique{0.25f, 3}, Technique{0.25f, 4}});
  CHECK(of(0, 2).empty());  // no step was taken
  CHECK(of(1, 0).empty());
  check_equal(of(1, 1), std::array{Technique{0.75f, 5}, Technique{0.25f, 6}});
}

TEST_CASE("techniques: unguided sampling and every method, those that know nothing included") {
  const ConstantDistribution first(4), third(10);
  const std::array parts{
      GuidePart{.distribution = &first, .share = 0.25f, .method = 0, .steers_distance = true},
      GuidePart{.distribution = &third, .share = 0.75f, .method = 2}};
  const Guidance guidance{.parts = parts, .unguided_share = 0.2f, .methods = 3};
  const ResolvedVertex vertex{.event = Event::smooth_reflect, .medium_density = 0.5f};
  const StepDensity density = step_density(guidance, vertex, 3);
  std::array<Technique, GuidingSettings::kMostMethods + 1> memory;
  const auto techniques = guidance.techniques(density.unguided, density.of_parts, memory);
  REQUIRE(techniques.size() == 4);
  CHECK(techniques[0].share == 0.2f);
  CHECK(techniques[0].density == 1.5f);
  CHECK(techniques[1].share == doctest::Approx(0.8 * 0.25));
  CHECK(techniques[1].density == 4);  // this guide's density contains the medium's factor
  CHECK(techniques[2].share == 0);
  CHECK(techniques[3].share == doctest::Approx(0.8 * 0.75));
  CHECK(techniques[3].density == 5);
  double total = 0;
  for (const Technique& t : techniques) total += double{t.share} * t.density;
  CHECK(total == doctest::Approx(density.total));
}

TEST_CASE("techniques: unguided sampling alone if no guide took part") {
  std::array<Technique, GuidingSettings::kMostMethods + 1> memory;
  const auto techniques = Guidance{.methods = 3}.techniques(2, {}, memory);
  REQUIRE(techniques.size() == 1);
  CHECK(techniques[0].share == 1);
  CHECK(techniques[0].density == 2);
}

TEST_CASE("path logs: what is loaded is what was saved, field by field") {
  const PathLog original = example();
  const PathLog copy = loaded(saved(original));
  REQUIRE(copy.size() == 3);
  for (std::size_t i = 0; i < copy.size(); ++i) check_equal(original[i], copy[i]);
  CHECK(copy[2].transport == Transport::importance);
  CHECK(linked_children(copy[0], 0) == Indices{1, 3});
  CHECK(loaded(saved(PathLog())).size() == 0);
}

TEST_CASE("path logs: a loaded log goes on") {
  PathLog original = example(), copy;
  copy.begin_path({}, Transport::radiance);  // loading replaces the previous content of a log
  std::istringstream in(saved(original));
  load(in, copy);
  for (PathLog* log : {&original, &copy}) {
    Numbers numbers;
    log->add(RecordedVertex{.parent = 0});  // the last path now branches at its first vertex
    add_branching_path(*log, numbers);
  }
  REQUIRE(copy.size() == original.size());
  for (std::size_t i = 0; i < copy.size(); ++i) check_equal(original[i], copy[i]);
}

TEST_CASE("path logs: no path begins in a full log") {
  PathLog log;
  log.set_most_records(6);
  CHECK(log.begin_path({}, Transport::radiance));
  for (int i = 0; i < 3; ++i) log.add(RecordedVertex{});
  for (int i = 0; i < 2; ++i) log.add(RecordedLightSample{.vertex = 1});
  CHECK(log.begin_path({}, Transport::radiance));  // there are five records
  for (int i = 0; i < 20; ++i) log.add(RecordedVertex{.throughput = Rgb(1)});
  CHECK_FALSE(log.begin_path({}, Transport::radiance));
  log.blacken_last_path();  // which was left out
  REQUIRE(log.size() == 2);
  CHECK(log[1].vertices.size() == 20);
  CHECK(log[1].vertices[0].throughput == Rgb(1));
  log.clear();
  CHECK(log.begin_path({}, Transport::radiance));
}

TEST_CASE("path logs: cut off anywhere, they are refused") {
  const std::string bytes = saved(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    CHECK_THROWS_AS(loaded(bytes.substr(0, size)), InputError);
  }
}

TEST_CASE("path logs: links that lead outside the path, or back, are refused") {
  const auto load_changed = [](auto&& change) {
    PathLog log;
    add_tree(log, {kNoVertex, 0, 1});
    add_tree(log, {kNoVertex, 0, 1, 0});
    change(log);
    loaded(saved(log));
  };
  const char* damaged = "the path log is damaged";
  CHECK_NOTHROW(load_changed([](PathLog&) {}));
  for (const std::uint32_t parent : {2u, 3u, 4u, 1000u}) {
    const auto change = [&](PathLog& log) { log.vertex(2).parent = parent; };
    CHECK_THROWS_WITH_AS(load_changed(change), damaged, InputError);
  }
  for (const std::uint32_t link : {0u, 2u, 4u, 1000u}) {
    const auto change_next = [&](PathLog& log) { log.vertex(2).next = link; };
    const auto change_twin = [&](PathLog& log) { log.vertex(2).twin = link; };
    CHECK_THROWS_WITH_AS(load_changed(change_next), damaged, InputError);
    CHECK_THROWS_WITH_AS(load_changed(change_twin), damaged, InputError);
  }
  for (const std::uint32_t vertex : {4u, kNoVertex}) {
    const auto change = [&](PathLog& log) { log.add(RecordedLightSample{.vertex = vertex}); };
    CHECK_THROWS_WITH_AS(load_changed(change), damaged, InputError);
  }
}

TEST_CASE("path logs: whatever byte is damaged, the log is refused or leads nowhere outside") {
  const std::string bytes = saved(example());
  int refused = 0, sound = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const int flipped : {0x01, 0x04, 0x80, 0xff}) {
      CAPTURE(at);
      CAPTURE(flipped);
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ flipped);
      try {
        walk(loaded(damaged), bytes.size());
        ++sound;
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  // Most bytes belong to floating-point numbers, and a changed number is usually valid.
  CHECK(sound > 1000);
  CHECK(refused > 500);
}

}  // namespace pharos
