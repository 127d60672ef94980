#include "sampler_costs.h"

#include <ctime>

#include "allocation_count.h"

namespace pharos::bench {
namespace {

volatile float sink;

constexpr std::uint16_t kVertices = 5;  // each with a light and a BSDF
constexpr int kValues = 1 + 2 * kVertices;

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

}  // namespace

double thread_ns() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

void keep(float result) {
  sink = result;
}

std::vector<Measurement> measure_sampler(const std::string& name, const Sampler& sampler,
                                         int repeats) {
  const auto prepared = sampler.prepare(kTimedFilm, kTimedPlan, nullptr);
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

}  // namespace pharos::bench
