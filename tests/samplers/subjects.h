#pragma once

#include <string>
#include <vector>

namespace pharos::testing {

/// A sampler to be tested, with its defaults or, if it has none, with the first example that it
/// declares.
struct SamplerSubject {
  std::string name;
  std::string settings;  ///< with `type`, as YAML on one line
};

/// Returns every sampler of the build's modules, except stand-ins of tests.
std::vector<SamplerSubject> sampler_subjects();

}  // namespace pharos::testing
