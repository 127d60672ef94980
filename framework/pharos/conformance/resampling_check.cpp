#include <array>
#include <vector>

#include <fmt/format.h>

#include <pharos/conformance/guided.h>
#include <pharos/conformance/resampling_check.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/hypothesis.h>
#include <pharos/transport/scatter_step.h>

namespace pharos::conformance {
namespace {

constexpr std::uint32_t kCandidates = 4;
constexpr std::size_t kDraws = 20'000;
/// The octants of directions, and all directions together.
constexpr std::size_t kOctants = 8, kCells = kOctants + 1;

/// Estimates of one integral for each cell: what each draw contributes.
class CellEstimates {
 public:
  void add(std::size_t draw, Vec3 direction, double contribution) {
    const auto octant = static_cast<std::size_t>((direction.x > 0) | (direction.y > 0) << 1 |
                                                 (direction.z > 0) << 2);
    values_[octant][draw] = values_[kOctants][draw] = contribution;
  }
  statistics::Estimate estimate(std::size_t cell) const {
    return statistics::estimate(statistics::moments(values_[cell]));
  }

 private:
  std::vector<std::vector<double>> values_{kCells, std::vector<double>(kDraws)};
};

/// Compares the integral of BSDF times cosine over each octant: by resampled steps and by unguided
/// ones.
void compare_integrals(const StageVertex& vertex, const Guidance& guidance, std::uint64_t seed,
                       Check& check) {
  const KeyedSampler numbers;
  const auto bounce = vertex.query().bounce;
  CellEstimates resampled, unguided;
  for (std::size_t i = 0; i < kDraws; ++i) {
    ScatterStep step;
    const SampleStream path(numbers, {.seed = seed, .index = i});
    if (sample_step(vertex.scattering(), guidance, VertexStream(path, bounce), step)) {
      const ResolvedVertex end{.direction = step.direction, .event = step.event};
      const double density = step_density(guidance, end, step.unguided_pdf).total;
      resampled.add(i, step.direction, mean(step.value) / density * step.resampling);
    }
    const SampleStream other(numbers, {.seed = seed, .iteration = 1, .index = i});
    if (sample_unguided_step(vertex.scattering(), VertexStream(other, bounce), step)) {
      unguided.add(i, step.direction, mean(step.unguided_weight));
    }
  }
  // Rounding is no bias. Unguided weights may all be the same.
  constexpr double kRounding = 1e-4;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    statistics::Estimate a = resampled.estimate(cell), b = unguided.estimate(cell);
    b.squared_error += square(kRounding * b.mean);
    // Too few draws for an estimate of the variance.
    constexpr double kRare = 0.01;
    if (b.mean < kRare * unguided.estimate(kOctants).mean) continue;
    check.add_p_value(
        statistics::welch_test(a, b).p_value,
        fmt::format("{}: integral over {}: {:.5f} by resampled steps, {:.5f} by "
                    "unguided ones",
                    vertex.text(),
                    cell == kOctants ? "all directions" : fmt::format("octant {}", cell), a.mean,
                    b.mean));
  }
}

/// Tests that the radiance around a vertex has the mean 1 over all directions, which are drawn from
/// the guide and uniformly in turn.
void check_mean(const StageVertex& vertex, const Guidance& guidance, std::uint64_t seed,
                Check& check) {
  const KeyedSampler numbers;
  RandomStream random(seed, 5);
  const RadianceAround& radiance = *guidance.parts[0].radiance;
  std::vector<double> values(kDraws);
  for (std::size_t i = 0; i < kDraws; ++i) {
    Vec3 direction = warp::sphere_from_square(random.next_2d());
    if (i % 2 == 0) {
      const SampleStream path(numbers, {.seed = seed, .iteration = 2, .index = i});
      const VertexStream stream(path, vertex.query().bounce);
      const auto proposal = guidance.propose(stream, stream.get_1d(Purpose::guide_choice));
      if (!proposal) continue;
      direction = proposal->direction;
    }
    const float relative = radiance.relative(direction);
    check.expect(is_non_negative(relative),
                 [&] { return fmt::format("{}: radiance {}", vertex.text(), relative); });
    const double guided = guidance.density(
        {.direction = direction, .event = vertex.scattering().smooth_event(direction)});
    values[i] = relative * warp::sphere_pdf() / (0.5 * guided + 0.5 * warp::sphere_pdf());
  }
  const statistics::Estimate found = statistics::estimate(statistics::moments(values));
  constexpr double kRounding = 1e-3;
  const statistics::Estimate expected{.mean = 1, .squared_error = square(kRounding)};
  check.add_p_value(
      statistics::welch_test(found, expected).p_value,
      fmt::format("{}: the mean of the radiance around the vertex, which should be 1, is {:.4f} +- "
                  "{:.4f}",
                  vertex.text(), found.mean, std::sqrt(found.squared_error)));
}

}  // namespace

void check_resampling(const Guider& guider, const std::shared_ptr<const GuidingModel>& model,
                      const Scene& scene, std::uint64_t seed, Check& check) {
  const GuidingFrame frame = frame_of(guider, model, kCandidates);
  for (const auto& vertex : stage_vertices(scene, seed)) {
    GuidingQuery query = vertex->query();
    Arena arena;
    const Guidance guidance = frame.query(query, arena);
    if (guidance.candidates == 1) continue;
    check_mean(*vertex, guidance, seed, check);
    compare_integrals(*vertex, guidance, seed, check);
  }
}

}  // namespace pharos::conformance
