#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/sampling/sampler.h>

namespace pharos::testing {

/// A sampler to be tested, with its defaults or, if it has none, with the first example that it
/// declares.
struct SamplerSubject {
  std::string name;
  std::string settings;  ///< with `type` and absolute paths, as YAML on one line
};

/// Returns every sampler of the build's modules, except stand-ins of tests.
std::vector<SamplerSubject> sampler_subjects();

/// A sampler that is ready for a film, unless it needs a probe of an integrand.
struct PreparedSubject {
  std::string name;
  std::unique_ptr<const PreparedSampler> sampler;
};

/// Returns every sampler of the build's modules, prepared for a square film of this many pixels
/// across.
std::vector<PreparedSubject> prepared_samplers(int pixels);

}  // namespace pharos::testing
