#include <pharos/guiding/pipeline/training_settings.h>

namespace pharos {

void TrainingSettings::describe(Schema<TrainingSettings>& s) {
  s.field(
      "schedule", &TrainingSettings::schedule,
      "Sizes of the training iterations: all equal, or each twice as large as the previous one");
  s.field("iterations", &TrainingSettings::iterations, "Number of training iterations")
      .at_most(1000);
  s.field("share", &TrainingSettings::share, "Share of the budget spent on training")
      .at_least(0)
      .below(1);
  s.field("images", &TrainingSettings::images,
          "Use of the images of training iterations: discarded, or combined with the final image, "
          "weighted by their numbers of samples");
  s.field("latest_images", &TrainingSettings::latest_images,
          "Largest number of combined images, including the final one; the first images may be "
          "much noisier than the rest, because their guides know little")
      .at_least(1)
      .at_most(1001);
}

}  // namespace pharos
