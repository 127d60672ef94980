#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/quadrature.h>

#include "../camera_mixture.h"
#include "../next_distribution.h"
#include "../truncated_normal.h"
#include "test_next_vertices.h"
#include "test_proposals.h"

namespace pharos::vertex_triplets {
namespace {

using namespace testing;

/// A phase function that scatters into a cone ahead. The mean cosine that it reports is a
/// parameter.
class Cone final : public PhaseFunction {
 public:
  explicit Cone(float stated_cosine) : stated_cosine_(stated_cosine) {}
  float evaluate(Vec3 wo, Vec3 wi) const override {
    return 1 - dot(-wo, wi) <= kOneMinusCos ? warp::cone_pdf(kOneMinusCos) : 0.0f;
  }
  Vec3 sample(Vec3 wo, Vec2 u) const override {
    return Frame::from_normal(-wo).to_world(warp::cone_from_square(u, kOneMinusCos));
  }
  float mean_cosine() const override { return stated_cosine_; }

 private:
  static constexpr float kOneMinusCos = 0.02f;
  float stated_cosine_;
};

constexpr Vec3 kBack{0, 0, -1};  // the direction to the previous vertex: the path goes along +z

NextVertex next_vertex(const Gaussian<3>& g, float share, Event event, VertexKind kind) {
  return {spatial(g, share), event, kind};
}

/// The distribution at the origin, in a medium of roughness 1 - g.
struct InMedium {
  InMedium(const std::vector<NextVertex>& next, float mean_cosine, StepRules rules = {})
      : groups(groups_of(next)),
        phase(mean_cosine),
        scattering(phase, Rgb(1), kBack, Transport::radiance),
        guide(NextDistribution::make(groups, scattering, {}, rules, 0, arena)) {}

  std::vector<NextGroup> groups;
  Cone phase;
  LocalScattering scattering;
  Arena arena;
  const NextDistribution* guide;
};

statistics::DensityFit fit_directions(const NextDistribution& guide, VertexKind kind) {
  const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
    const auto proposal = propose(guide, random);
    const bool fits = proposal && contains(proposal->targets, kind);
    return fits ? std::optional(proposal->direction) : std::nullopt;
  };
  const auto density = [&](Vec3 direction) -> double {
    return guide.density(
        {.direction = direction, .distance = 1, .kind = kind, .event = Event::scatter});
  };
  return statistics::fit_direction_density(draw, density);
}

TEST_CASE("on surfaces: directions follow their density, which integrates to one (2D)") {
  for (const auto technique :
       {SurfaceTechnique::projected, SurfaceTechnique::p0, SurfaceTechnique::p1}) {
    std::vector<NextVertex> next;
    for (const auto& g : any_gaussians(4, 1)) {
      next.push_back(next_vertex(g, 0.25f, Event::scatter, VertexKind::surface));
    }
    const InMedium at(next, 0, {.technique = technique});
    const auto fit = fit_directions(*at.guide, VertexKind::surface);
    CAPTURE(static_cast<int>(technique));
    CHECK(fit.is_density());
    CHECK(fit.missed == 0);
    CHECK(fit.integral == doctest::Approx(1).epsilon(1e-3));
    CHECK(fit.chi_square.p_value > 1e-4);
  }
}

TEST_CASE("surfaces and the environment are one set of directions") {
  std::vector<NextVertex> next;
  for (const auto& g : any_gaussians(4, 1)) {
    const VertexKind kind = next.size() % 2 == 0 ? VertexKind::surface : VertexKind::environment;
    next.push_back(next_vertex(g, 0.25f, Event::scatter, kind));
  }
  const InMedium at(next, 0);
  for (const VertexKind met : {VertexKind::surface, VertexKind::environment}) {
    const auto fit = fit_directions(*at.guide, met);
    CHECK(fit.is_density());
    CHECK(fit.missed == 0);
    CHECK(fit.integral == doctest::Approx(1).epsilon(1e-3));
    CHECK(fit.chi_square.p_value > 1e-4);
  }
}

TEST_CASE("near specular: shares of the phase function and of the Gaussians (eq. 22 to 25)") {
  std::vector<NextVertex> next;
  for (const auto& g : any_gaussians(3, 2)) {
    next.push_back(next_vertex(g, 1.0f / 3, Event::scatter, VertexKind::surface));
  }
  const float g = 0.99f;  // r = 0.1: the phase function gets half of the probability
  const InMedium at(next, g), rough(next, 0.9f), straight(next, 0.99999999f);
  const auto fit = fit_directions(*at.guide, VertexKind::surface);
  CHECK(fit.is_density());
  CHECK(fit.integral == doctest::Approx(1).epsilon(2e-3));
  CHECK(fit.chi_square.p_value > 1e-4);
  RandomStream random(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 direction = warp::cone_from_square(random.next_2d(), 0.3f);
    const auto density = [&](const InMedium& where) {
      return where.guide->density({.direction = direction, .event = Event::scatter});
    };
    const float phase = at.phase.evaluate(kBack, direction);
    CHECK(density(at) == doctest::Approx(0.5f * (phase + density(rough))).epsilon(1e-3));
  }
}

/// Returns the integral of the density over the distance along a direction.
double over_distances(const NextDistribution& guide, Vec3 direction, Event event) {
  constexpr int kSteps = 400;
  constexpr double kReach = 8;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const auto t = static_cast<float>((i + 0.5) * kReach / kSteps);
    sum += guide.density({.direction = direction,
                          .distance = t,
                          .position = t * direction,
                          .kind = VertexKind::volume,
                          .event = event}) *
           kReach / kSteps;
  }
  return sum;
}

TEST_CASE("in media: points follow their density, by Gaussians and along scattered rays") {
  for (const float g : {0.0f, 0.99f}) {
    std::vector<NextVertex> next;
    for (const auto& gaussian : any_gaussians(3, 4)) {
      next.push_back(next_vertex(gaussian, 1.0f / 3, Event::scatter, VertexKind::volume));
    }
    const InMedium at(next, g);
    int proposals = 0;
    const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
      const auto proposal = propose(*at.guide, random);
      if (!proposal) return std::nullopt;
      CHECK(proposal->reach == Proposal::Reach::distance);
      CHECK(proposal->distance > 0);
      proposals += 1;
      return proposal->direction;
    };
    const auto density = [&](Vec3 direction) {
      return over_distances(*at.guide, direction, Event::scatter);
    };
    const auto fit = statistics::fit_direction_density(
        draw, density, {.draws = 40'000, .cells = 60, .quadrature_tolerance = 1e-3});
    CAPTURE(g);
    CHECK(proposals > 39'000);
    CHECK(fit.is_density(3e-3));
    CHECK(fit.integral + fit.missed == doctest::Approx(1).epsilon(5e-3));
    CHECK(fit.chi_square.p_value > 1e-4);
  }
}

TEST_CASE("in media: points along the rays of narrow cones follow their density (3D)") {
  for (const float g : {0.0f, 0.99f}) {
    std::vector<NextVertex> next;
    for (const auto& gaussian : any_gaussians(3, 4)) {
      next.push_back(next_vertex(gaussian, 1.0f / 3, Event::scatter, VertexKind::volume));
    }
    const InMedium at(next, g);
    // The bins are boxes in (x / z, y / z) and distance; the density is integrated over each of
    // them.
    constexpr int kSides = 5, kLengths = 8;
    constexpr double kReach = 0.12, kFrom = 1, kTo = 3.4;
    const auto cell = [](Vec3 direction, double distance) {
      const int i =
          static_cast<int>(std::floor((direction.x / direction.z / kReach + 1) / 2 * kSides));
      const int j =
          static_cast<int>(std::floor((direction.y / direction.z / kReach + 1) / 2 * kSides));
      const int k = static_cast<int>(std::floor((distance - kFrom) / (kTo - kFrom) * kLengths));
      const bool is_within =
          direction.z > 0 && i >= 0 && i < kSides && j >= 0 && j < kSides && k >= 0 && k < kLengths;
      return is_within ? (i * kSides + j) * kLengths + k : kSides * kSides * kLengths;
    };
    constexpr int kDraws = 200'000;
    std::vector<double> observed(kSides * kSides * kLengths + 1, 0), expected(observed.size(), 0);
    RandomStream random(31);
    for (int i = 0; i < kDraws; ++i) {
      const auto proposal = propose(*at.guide, random);
      ++observed[proposal ? cell(proposal->direction, proposal->distance) : observed.size() - 1];
    }
    constexpr int kFine = 6;
    const double side = 2 * kReach / (kSides * kFine), step = (kTo - kFrom) / (kLengths * kFine);
    for (int i = 0; i < kSides * kFine; ++i) {
      for (int j = 0; j < kSides * kFine; ++j) {
        const double x = -kReach + (i + 0.5) * side, y = -kReach + (j + 0.5) * side;
        const double size = std::sqrt(x * x + y * y + 1);
        const Vec3 direction{static_cast<float>(x / size), static_cast<float>(y / size),
                             static_cast<float>(1 / size)};
        for (int k = 0; k < kLengths * kFine; ++k) {
          const auto t = static_cast<float>(kFrom + (k + 0.5) * step);
          expected[cell(direction, t)] += kDraws * side * side / (size * size * size) * step *
                                          at.guide->density({.direction = direction,
                                                             .distance = t,
                                                             .position = t * direction,
                                                             .kind = VertexKind::volume,
                                                             .event = Event::scatter});
        }
      }
    }
    double within = 0;
    for (const double count : expected) within += count;
    expected.back() = kDraws - within;
    CAPTURE(g);
    CHECK(within > 0.02 * kDraws);
    CHECK(expected.back() > 0);
    CHECK(statistics::chi_square_test(observed, expected).p_value > 1e-4);
  }
}

TEST_CASE("truncated Gaussians: points follow their density, which integrates to one (3D)") {
  RandomStream random(5);
  for (int run = 0; run < 3; ++run) {
    const SpatialGaussian g = spatial(any_gaussian<3>(random, 2, 0.1));
    // Whitened points are sorted into equally likely parts of each axis.
    constexpr int kParts = 6;
    constexpr int kDraws = 60'000;
    std::vector<double> observed(kParts * kParts * kParts, 0);
    const auto part_of = [](double z) {
      const double u = 0.5 * std::erfc(-z / std::sqrt(2.0));
      return std::min(kParts - 1, static_cast<int>(u * kParts));
    };
    for (int i = 0; i < kDraws; ++i) {
      const Vec2 u = random.next_2d();
      const Point3 p = truncated_point(g, u, random.next_1d());
      CHECK(box_around(g).contains(p));
      const Vec3 d = p - g.mean;
      const auto z = whitened(g, {d.x, d.y, d.z});
      ++observed[(part_of(z[0]) * kParts + part_of(z[1])) * kParts + part_of(z[2])];
    }
    const std::vector<double> expected(observed.size(),
                                       kDraws / static_cast<double>(observed.size()));
    CHECK(statistics::chi_square_test(observed, expected).p_value > 1e-4);
    NextGroup group;
    group.clear();
    group.set(3, g);
    const auto density_at = [&](Point3 p) { return truncated_densities(group, p)[3]; };
    constexpr int kSteps = 80;
    constexpr double kStep = 2.0 * kTruncation / kSteps;
    double integral = 0;
    for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
      const auto z = [&](int rest) {
        return static_cast<float>((rest % kSteps + 0.5) * kStep - kTruncation);
      };
      const Point3 p = g.mean + spread(g, {z(i), z(i / kSteps), z(i / kSteps / kSteps)});
      integral += density_at(p) * root_determinant(g) * kStep * kStep * kStep;
    }
    CHECK(integral == doctest::Approx(1).epsilon(1e-4));
    CHECK(density_at(g.mean + spread(g, {0, 4.001f, 0})) == 0);
  }
}

TEST_CASE("distances along rays: the Gaussian's own, cut and normalized (1D)") {
  RandomStream random(6);
  int possible = 0;
  for (int run = 0; run < 200; ++run) {
    const SpatialGaussian g = spatial(any_gaussian<3>(random, 1, 0.2));
    const Vec3 direction = warp::sphere_from_square(random.next_2d());
    const DistancesAlong distances(g, {}, direction);
    if (!distances.is_possible()) continue;
    ++possible;
    constexpr int kSteps = 4000;
    constexpr double kReach = 12;
    double integral = 0, log_ratio = 0;
    for (int i = 0; i < kSteps; ++i) {
      const auto t = static_cast<float>((i + 0.5) * kReach / kSteps);
      const double p = distances.density(t);
      integral += p * kReach / kSteps;
      // Along the ray, the density is proportional to the 3D density.
      const Vec3 d = t * direction - g.mean;
      const auto z = whitened(g, {d.x, d.y, d.z});
      const double exponent = -0.5 * (z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
      if (p > 0 && log_ratio == 0) log_ratio = std::log(p) - exponent;
      if (p > 0) CHECK(std::log(p) - exponent == doctest::Approx(log_ratio).epsilon(1e-3));
    }
    CHECK(integral == doctest::Approx(1).epsilon(2e-2));
    if (run >= 20) continue;
    std::vector<float> drawn(20'000);
    for (float& t : drawn) t = distances.sample(random.next_1d());
    const auto [low, high] = std::minmax_element(drawn.begin(), drawn.end());
    constexpr int kParts = 20, kInPart = 200;
    std::vector<double> observed(kParts, 0), expected(kParts, 0);
    const double width = (*high - *low) / kParts;
    for (const float t : drawn) {
      ++observed[static_cast<std::size_t>(std::min(kParts - 1.0, std::floor((t - *low) / width)))];
    }
    double all = 0;
    for (int i = 0; i < kParts * kInPart; ++i) {
      const double p = distances.density(static_cast<float>(*low + (i + 0.5) * width / kInPart));
      expected[i / kInPart] += p;
      all += p;
    }
    for (double& count : expected) count *= static_cast<double>(drawn.size()) / all;
    CHECK(statistics::chi_square_test(observed, expected).p_value > 1e-4);
  }
  CHECK(possible > 100);
  // Distances behind the origin are impossible.
  const SpatialGaussian ahead = spatial({Vector<3>(0, 0, 0.5), Matrix<3>::Identity()});
  const DistancesAlong around(ahead, {}, {0, 0, 1});
  for (int i = 0; i < 1000; ++i) CHECK(around.sample(random.next_1d()) > 0);
  const SpatialGaussian behind = spatial({Vector<3>(0, 0, -9), Matrix<3>::Identity()});
  CHECK(!DistancesAlong(behind, {}, {0, 0, 1}).is_possible());
}

TEST_CASE("discrete events: each as often as its components' shares, distances included") {
  const auto gaussians = any_gaussians(3, 8);
  const std::vector<NextVertex> next{
      next_vertex(gaussians[0], 0.35f, Event::discrete_reflect, VertexKind::surface),
      next_vertex(gaussians[1], 0.25f, Event::discrete_reflect, VertexKind::surface),
      next_vertex(gaussians[2], 0.4f, Event::discrete_transmit, VertexKind::volume)};
  const std::vector<NextGroup> groups = groups_of(next);
  const Pane pane;
  const SurfacePoint surface{.normal = {0, 0, -1}, .shading = Frame::from_normal({0, 0, -1})};
  const Vec3 back = normalize(Vec3{0.1f, -0.15f, -1});
  const LocalScattering scattering(surface, pane, back, Transport::radiance);
  Arena arena;
  const auto* guide = NextDistribution::make(groups, scattering, {}, {}, 0, arena);
  REQUIRE(guide != nullptr);
  const auto reflected = guide->density(
      {.distance = 1, .kind = VertexKind::surface, .event = Event::discrete_reflect});
  CHECK(reflected == doctest::Approx(0.6f));
  // The direction decides whether a surface or the environment is met.
  CHECK(guide->density({.kind = VertexKind::environment, .event = Event::discrete_reflect}) ==
        doctest::Approx(0.6f));
  CHECK(guide->density({.distance = 1,
                        .position = {0, 0, 2},
                        .kind = VertexKind::volume,
                        .event = Event::discrete_reflect}) == 0);
  CHECK(over_distances(*guide, -back, Event::discrete_transmit) ==
        doctest::Approx(0.4).epsilon(1e-2));
  RandomStream random(9);
  std::map<EventMask, int> counts;
  for (int i = 0; i < 20'000; ++i) {
    const auto proposal = propose(*guide, random);
    REQUIRE(proposal);
    ++counts[proposal->events];
  }
  const std::vector<double> observed{
      static_cast<double>(counts[mask_of(Event::discrete_reflect)]),
      static_cast<double>(counts[mask_of(Event::discrete_transmit)])};
  CHECK(statistics::chi_square_test(observed, std::vector<double>{12'000, 8'000}).p_value > 1e-4);
}

TEST_CASE("projections: seen from their own means there is no direction") {
  const SpatialGaussian g = spatial({Vector<3>(0, 0, 0), Matrix<3>::Identity()});
  const std::vector<NextGroup> groups = groups_of({{g, Event::scatter, VertexKind::surface}});
  const Cone phase(0);
  const LocalScattering scattering(phase, Rgb(1), kBack, Transport::radiance);
  Arena arena;
  CHECK(NextDistribution::make(groups, scattering, {}, {}, 1e-6f, arena) == nullptr);
  CHECK(NextDistribution::make(groups, scattering, {}, {.technique = SurfaceTechnique::p0}, 1e-6f,
                               arena) != nullptr);
}

}  // namespace
}  // namespace pharos::vertex_triplets
