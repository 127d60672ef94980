#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/experiments/pictures/sampled_points.h>
#include <pharos/laboratory/integrand.h>

/// What a file of the laboratory says: samplers x integrands at growing numbers of points.
namespace pharos::laboratory {

/// Numbers of points from 2^from to 2^to.
struct PowerRange {
  std::uint32_t from = 4, to = 16;

  static void describe(Schema<PowerRange>& schema);
};

struct NamedIntegrand {
  std::string name;
  Ref<Integrand> integrand;

  static void describe(Schema<NamedIntegrand>& schema);
};

/// The pictures of power spectra.
struct SpectrumSettings {
  std::uint32_t points = 1024;      ///< of each set, a power of two; 0: no pictures
  std::uint32_t realizations = 32;  ///< that a picture is the mean of
  int max_frequency = 64;           ///< [cycles per side of the square]

  static void describe(Schema<SpectrumSettings>& schema);
};

struct LaboratoryConfig {
  std::string title, description;
  std::vector<NamedIntegrand> integrands;
  std::vector<NamedSampler> samplers;  ///< in the file empty or left out: all that are registered
  std::string baseline;                ///< sampler that ratios are to; empty: there is none
  PowerRange samples;
  std::optional<PowerRange> fit;  ///< what slopes are fitted to; none: all of `samples`
  std::uint32_t realizations = 1000;
  std::uint32_t preparations = 64;
  std::uint64_t seed = 1;
  SpectrumSettings spectrum;
  std::string output;  ///< folder, relative to the current one

  std::filesystem::path source;       ///< the file it was read from, absolute
  std::string resolved;               ///< the file with every value in force, as YAML
  std::vector<std::string> left_out;  ///< registered samplers that cannot be had by name alone

  PowerRange fitted() const { return fit.value_or(samples); }
  /// Into so many groups of one preparation each the realizations fall.
  std::uint32_t groups() const { return std::min(preparations, realizations); }
  static void describe(Schema<LaboratoryConfig>& schema);
};

/// Reads a file, follows `extends`, applies `overrides` and checks what no single value shows:
/// names are different, the baseline is a sampler, ranges are in order, no sampler needs a scene.
/// Without `samplers` all registered ones are taken that need neither settings nor a scene; without
/// `baseline` the first sampler of type `independent`. `registry` holds the integrands, too. Throws
/// InputError.
LaboratoryConfig load_laboratory(const std::filesystem::path& path,
                                 const std::vector<std::string>& overrides,
                                 const Registry& registry);

}  // namespace pharos::laboratory
