#pragma once

#include <array>

#include <pharos/scene/local_scattering.h>

#include "seen_lobes.h"

namespace pharos::parallax_aware_mixtures {

/// Concentration of the lobe that approximates a clamped cosine about the normal (Ruppert et al.
/// 2020).
inline constexpr float kCosineKappa = 2.18853f;

/// At most two lobes that approximate the smooth scattering at a vertex, including the cosine.
struct ScatteringLobes {
  std::array<Factor, 2> lobes;
  std::size_t count = 0;
};

inline constexpr std::uint32_t kMostScatteringSamples = 64;

/// Parameters of fit_scattering().
struct ScatteringFit {
  std::uint32_t samples = 16;  ///< directions, at most kMostScatteringSamples
  float tail = 0.1f;           ///< densities below this share of the largest make the second lobe
};

/// Fits lobes to directions that the scattering samples with a fixed point set. The result is
/// always the same for the same vertex. It is empty if the scattering samples no directions.
ScatteringLobes fit_scattering(const LocalScattering& scattering, const ScatteringFit& rule);

}  // namespace pharos::parallax_aware_mixtures
