// Random numbers need no heap memory: prepare() allocates everything that a sampler needs.

#include <cstdint>
#include <new>

#include <doctest/doctest.h>

#include <pharos/config/module_loader.h>
#include <pharos/conformance/subjects.h>
#include <pharos/sampling/sampler.h>

#include "allocation_count.h"

namespace pharos::testing {
namespace {

/// Returns the number of blocks that streams and their numbers allocate, for several sample numbers
/// of some pixels.
std::uint64_t allocations_of(const PreparedSampler& sampler) {
  const std::uint64_t before = allocation_count();
  float sum = 0;
  for (std::uint64_t pixel = 0; pixel < 10; ++pixel) {
    for (const std::uint32_t sample : {0u, 15u, 63u, 64u, 5000u, 1'000'000u}) {
      const SampleStream stream(sampler, {.seed = 1, .index = pixel, .sample = sample});
      for (int purpose = 0; purpose < kPurposeCount; ++purpose) {
        for (const std::uint16_t bounce : {1, 3}) {
          const Dimension dimension{static_cast<Purpose>(purpose), bounce, 1};
          sum += stream.get_1d(dimension) + stream.get_2d(dimension).x;
        }
      }
    }
  }
  CHECK(sum > 0);
  return allocation_count() - before;
}

}  // namespace

TEST_CASE("samplers: no number takes memory from the heap") {
  const std::uint64_t before = allocation_count();
  ::operator delete(::operator new(8));
  CHECK(allocation_count() > before);

  Registry registry;
  load_modules(registry, PHAROS_PLUGINS, true);
  const conformance::ExampleFolder folder;
  int tested = 0;
  for (const std::string& name : registry.names(Sampler::contract_name)) {
    const PluginInfo& plugin = *registry.find(Sampler::contract_name, name);
    for (const auto& s : conformance::cases_of(registry, plugin, folder.path()).subjects) {
      const auto& sampler = static_cast<const Sampler&>(*s.component);
      if (sampler.needs_probe()) continue;
      CAPTURE(name);
      CAPTURE(s.settings);
      for (const std::uint32_t samples : {0u, 64u}) {
        const auto prepared = sampler.prepare({64, 64}, {1, samples}, nullptr);
        const std::uint64_t taken = allocations_of(*prepared);
        CHECK(taken == 0);
        ++tested;
      }
    }
  }
  CHECK(tested >= 20);
}

}  // namespace pharos::testing
