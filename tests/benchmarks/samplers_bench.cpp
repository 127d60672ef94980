// What numbers cost, for every sampler that is registered, with its defaults or its first example:
// `value_ns` is the time of a 2D number on one thread, of paths that ask for eleven: the pixel's,
// and those of a light and a BSDF at five vertices. A path's share of beginning its stream is in
// it; `begin_ns` is that beginning by itself. `allocations` counts blocks taken from the heap after
// prepare().

#include <cstdio>
#include <ctime>

#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/conformance/subjects.h>
#include <pharos/sampling/sampler.h>

#include "allocation_count.h"
#include "bench.h"

namespace pharos::bench {
namespace {

constexpr PixelGrid kGrid{1280, 720};
/// Paths run through a tile of the film as a render does: pixel by pixel, all samples of each.
constexpr int kTile = 64;
constexpr SamplePlan kPlan{.seed = 1, .samples_per_pixel = 64};

constexpr std::uint16_t kVertices = 5;  // with a light and a BSDF each
constexpr int kValues = 1 + 2 * kVertices;

/// Keeps results from being optimised away.
volatile float sink;

/// Processor time of this thread [ns]: what other programs take does not count.
double thread_ns() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// The mean time of a path [ns], of which `use` makes a number from the path's stream.
template <class Use>
double time_paths(const PreparedSampler& sampler, Use&& use) {
  const double start = thread_ns();
  float sum = 0;
  for (int pixel = 0; pixel < kTile * kTile; ++pixel) {
    const int x = 320 + pixel % kTile, y = 320 + pixel / kTile;
    for (std::uint32_t sample = 0; sample < kPlan.samples_per_pixel; ++sample) {
      sum += use(SampleStream(sampler, {.seed = kPlan.seed,
                                        .index = static_cast<std::uint64_t>(y * kGrid.width + x),
                                        .sample = sample}));
    }
  }
  sink = sum;
  return (thread_ns() - start) / (kTile * kTile * kPlan.samples_per_pixel);
}

float first_bits(const SampleStream& stream) {
  return static_cast<float>(stream.state() & 1);
}

float all_values(const SampleStream& stream) {
  const Vec2 pixel = stream.get_2d({Purpose::pixel});
  float sum = pixel.x + pixel.y;
  for (std::uint16_t bounce = 1; bounce <= kVertices; ++bounce) {
    const VertexStream vertex(stream, bounce);
    const Vec2 light = vertex.get_2d(Purpose::light_position);
    const Vec2 bsdf = vertex.get_2d(Purpose::bsdf_direction);
    sum += (light.x + light.y) + (bsdf.x + bsdf.y);
  }
  return sum;
}

std::vector<Measurement> measure_sampler(const std::string& name, const Sampler& sampler,
                                         int repeats) {
  const auto prepared = sampler.prepare(kGrid, kPlan, nullptr);
  Measurement value{"sampler." + name + ".value_ns", "ns", {}},
      begin{"sampler." + name + ".begin_ns", "ns", {}},
      allocations{"sampler." + name + ".allocations", "1", {}};
  for (int i = 0; i < repeats; ++i) {
    const std::uint64_t before = testing::allocation_count();
    const double beginning = time_paths(*prepared, first_bits);
    const double path = time_paths(*prepared, all_values);
    allocations.runs.push_back(static_cast<double>(testing::allocation_count() - before));
    begin.runs.push_back(beginning);
    value.runs.push_back(path / kValues);
  }
  return {value, begin, allocations};
}

}  // namespace

std::vector<Measurement> bench_samplers(int repeats) {
  const Registry registry = load_default_modules();
  const conformance::ExampleFolder folder;
  std::vector<Measurement> all;
  for (const auto& s : conformance::first_cases(registry, Sampler::contract_name, folder.path())) {
    const auto& sampler = static_cast<const Sampler&>(*s.component);
    if (sampler.needs_probe()) {
      fmt::print(stderr, "{} is left out: it needs an integrand\n", s.plugin->name);
      continue;
    }
    for (Measurement& m : measure_sampler(s.plugin->name, sampler, repeats)) all.push_back(m);
  }
  return all;
}

}  // namespace pharos::bench
