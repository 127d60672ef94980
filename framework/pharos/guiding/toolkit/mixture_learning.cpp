#include <pharos/core/error.h>
#include <pharos/guiding/toolkit/mixture_learning.h>

namespace pharos {

void MixtureLearningSettings::check() const {
  if (components > most_components) {
    throw InputError("expected at least as many `most_components` as `components`");
  }
}

}  // namespace pharos
