#include <pharos/guiding/pipeline/training_settings.h>

namespace pharos {

void TrainingSettings::describe(Schema<TrainingSettings>& s) {
  s.field("schedule", &TrainingSettings::schedule,
          "Sizes of the training iterations: all equal, or doubling");
  s.field("iterations", &TrainingSettings::iterations, "Number of training iterations")
      .at_most(1000);
  s.field("share", &TrainingSettings::share, "Share of the budget spent on training")
      .at_least(0)
      .below(1);
  s.field("images", &TrainingSettings::images,
          "What becomes of the training iterations' images: thrown away, or combined with the "
          "final one by their samples");
  s.field("latest_images", &TrainingSettings::latest_images,
          "Images that are combined at most, the final one included: the first ones, of guides "
          "that know little, may be much noisier than the rest")
      .at_least(1)
      .at_most(1001);
}

}  // namespace pharos
