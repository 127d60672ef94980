#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include <pharos/config/schema.h>
#include <pharos/sampling/sampler.h>

#include "keyed_seeds.h"

/// The parameter `samples` of samplers that arrange their samples in sets of a fixed size.
namespace pharos {

/// The size of a set if neither the settings nor the plan (a time budget) determine one.
inline constexpr std::uint32_t kDefaultSetSize = 16;

/// Declares the parameter `samples` for settings with a member of this name.
template <class Settings>
void describe_samples(Schema<Settings>& s) {
  s.field("samples", &Settings::samples,
          "Size of a set; default: the samples per pixel, or 16 with a time budget")
      .at_least(1)
      .at_most(SetPlace::kMostSamples);
}

/// Settings of a sampler with no other parameter.
struct SetSettings {
  std::optional<std::uint32_t> samples;

  static void describe(Schema<SetSettings>& s) {
    describe_samples(s);
    s.example("{ samples: 7 }");
    s.example("{ samples: 32 }");
  }
};

/// Returns the stated size, or else the planned samples of a pixel, at most SetPlace::kMostSamples.
inline std::uint32_t set_size(std::optional<std::uint32_t> stated, const SamplePlan& plan) {
  if (stated) return *stated;
  if (plan.samples_per_pixel == 0) return kDefaultSetSize;
  return std::min(plan.samples_per_pixel, SetPlace::kMostSamples);
}

/// Returns whether passes must be sets of set_size(). Otherwise an iteration is a set, or a part of
/// one.
inline bool sets_are_passes(std::optional<std::uint32_t> stated, const SamplePlan& plan) {
  return stated || plan.samples_per_pixel == 0;
}

}  // namespace pharos
