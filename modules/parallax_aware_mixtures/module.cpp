#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::parallax_aware_mixtures;
  constexpr const char* kPaper =
      "L. Ruppert, S. Herholz, H. P. A. Lensch: Robust Fitting of Parallax-Aware Mixtures for Path "
      "Guiding. ACM Transactions on Graphics 39(4), 2020";
  registry.add<ParallaxAwareMixturesLearner>(
      "parallax_aware_mixtures",
      "Mixtures of von Mises-Fisher lobes that store the distances of their lights", {kPaper});
  registry.renamed<pharos::Learner>("vmf_mixtures", "parallax_aware_mixtures");
  registry.renamed<pharos::Guider>("vmf_mixtures", "parallax_aware_mixtures");
  registry.add<ParallaxAwareMixturesGuider>(
      "parallax_aware_mixtures",
      "Directions sampled from von Mises-Fisher lobes, with parallax and products", {kPaper});
}
