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

/// The config of the laboratory: samplers x integrands at growing numbers of points.
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

/// The settings of the pictures of power spectra.
struct SpectrumSettings {
  std::uint32_t points = 1024;      ///< points of each set, a power of two; 0: no pictures
  std::uint32_t realizations = 32;  ///< number of sets that are averaged
  int max_frequency = 64;           ///< largest frequency [cycles per side of the square]

  static void describe(Schema<SpectrumSettings>& schema);
};

struct LaboratoryConfig {
  std::string title, description;
  std::vector<NamedIntegrand> integrands;
  std::vector<NamedSampler> samplers;  ///< if the file has none: all registered ones
  std::string baseline;                ///< denominator of ratios; empty: none
  PowerRange samples;
  std::optional<PowerRange> fit;  ///< range that slopes are fitted to; none: all of `samples`
  std::uint32_t realizations = 1000;
  std::uint32_t preparations = 64;
  std::uint64_t seed = 1;
  SpectrumSettings spectrum;
  std::string output;  ///< folder, relative to the current one

  std::filesystem::path source;       ///< absolute path of the file it was read from
  std::string resolved;               ///< the file with every value in force, as YAML
  std::vector<std::string> left_out;  ///< registered samplers that need settings or a scene

  PowerRange fitted() const { return fit.value_or(samples); }
  /// Returns the number of groups of realizations. Each group shares one preparation.
  std::uint32_t groups() const { return std::min(preparations, realizations); }
  static void describe(Schema<LaboratoryConfig>& schema);
};

/// Reads a file, follows `extends`, applies `overrides` and makes the checks that concern several
/// values: names are unique, the baseline is a sampler, ranges are in order, no sampler needs a
/// scene. Without `samplers`, all registered samplers are used that need neither settings nor a
/// scene. Without `baseline`, the first sampler of type `independent` is used. `registry` must also
/// hold the integrands. Throws InputError.
LaboratoryConfig load_laboratory(const std::filesystem::path& path,
                                 const std::vector<std::string>& overrides,
                                 const Registry& registry);

}  // namespace pharos::laboratory
