#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include <pharos/config/schema.h>
#include <pharos/sampling/sampler.h>

#include "keyed_seeds.h"

/// The parameter `samples` of samplers that arrange their samples in sets of a fixed size.
namespace pharos {

/// Where neither the settings nor the plan (a time budget) tell a set's size.
inline constexpr std::uint32_t kDefaultSetSize = 16;

/// Settings of such a sampler.
struct SetSettings {
  std::optional<std::uint32_t> samples;

  static void describe(Schema<SetSettings>& s) {
    s.field("samples", &SetSettings::samples,
            "Size of a set; without it the samples a pixel, or 16 with a time budget")
        .at_least(1)
        .at_most(SetPlace::kMostSamples);
    s.example("{ samples: 7 }");
    s.example("{ samples: 32 }");
  }
};

/// The stated size; without one the planned samples of a pixel, at most a set's most.
inline std::uint32_t set_size(const SetSettings& settings, const SamplePlan& plan) {
  if (settings.samples) return *settings.samples;
  if (plan.samples_per_pixel == 0) return kDefaultSetSize;
  return std::min(plan.samples_per_pixel, SetPlace::kMostSamples);
}

}  // namespace pharos
