#pragma once

#include <string>
#include <vector>

namespace pharos::testing {

/// A sampler to render with: its defaults or, where it has none, the first example it states.
struct SamplerSubject {
  std::string name;
  std::string settings;  ///< with `type`, as YAML on one line
};

/// Every sampler of the build's modules; stand-ins of tests are left out.
std::vector<SamplerSubject> sampler_subjects();

}  // namespace pharos::testing
