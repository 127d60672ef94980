#include <algorithm>

#include <pharos/core/error.h>
#include <pharos/guiding/toolkit/mixture_learning.h>

namespace pharos {

void MixtureLearningSettings::check() const {
  if (components > most_components) {
    throw InputError("expected at least as many `most_components` as `components`");
  }
}

std::size_t MixtureLearningSettings::most_fit_samples() const {
  constexpr std::size_t kPerComponent = 32;
  return std::max<std::size_t>(fit_samples, kPerComponent * most_components);
}

}  // namespace pharos
