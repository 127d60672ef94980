// A render has the same bits for any number of threads, for every sampler.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "renders.h"
#include "subjects.h"

namespace pharos::testing {
namespace {

/// The Cornell box. The number of samples is neither a power of two nor a multiple of a pass.
std::vector<float> pixels(const std::string& sampler, int threads) {
  return render(fmt::format("scene: {}/cornell-box/scene.yaml\n"
                            "film: {{ width: 40, height: 36, filter: gaussian }}\n"
                            "budget: {{ spp: 12 }}\nsampler: {}\n",
                            PHAROS_SCENES, sampler),
                threads)
      .image.values();
}

}  // namespace

TEST_CASE("samplers: the same bits for any number of threads, and not those of independent ones") {
  const std::vector<float> independent = pixels("independent", 1);
  const std::vector<SamplerSubject> subjects = sampler_subjects();
  CHECK(subjects.size() >= 2);
  for (const SamplerSubject& subject : subjects) {
    CAPTURE(subject.name);
    const std::vector<float> one = pixels(subject.settings, 1);
    const bool is_independent = one == independent;
    CHECK(is_independent == (subject.name == "independent"));
    for (const int threads : {2, 3, 7}) {
      CAPTURE(threads);
      const bool same = pixels(subject.settings, threads) == one;
      CHECK(same);
    }
  }
}

}  // namespace pharos::testing
