#include <pharos/config/module.h>

#include "guider.h"
#include "learner.h"

PHAROS_MODULE(registry) {
  using namespace pharos::practical_path_guiding;
  constexpr const char* kPaper =
      "T. Müller, M. Gross, J. Novák: Practical Path Guiding for Efficient Light-Transport "
      "Simulation. Computer Graphics Forum 36(4), 2017";
  constexpr const char* kCourse =
      "T. Müller: \"Practical Path Guiding\" in Production. SIGGRAPH Courses, 2019";
  registry.add<PracticalPathGuidingLearner>(
      "practical_path_guiding",
      "SD-tree: a binary tree over the scene with directional quadtrees of incident radiance",
      {kPaper, kCourse});
  registry.renamed<pharos::Learner>("sd_tree", "practical_path_guiding");
  registry.renamed<pharos::Guider>("sd_tree", "practical_path_guiding");
  registry.add<PracticalPathGuidingGuider>("practical_path_guiding",
                                           "Directions sampled from the quadtrees of an SD-tree",
                                           {kPaper, kCourse});
}
