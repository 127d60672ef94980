#include <pharos/guiding/pipeline/training_settings.h>

namespace pharos {

void TrainingSettings::describe(Schema<TrainingSettings>& s) {
  s.field(
      "schedule", &TrainingSettings::schedule,
      "Sizes of the training iterations: all equal, or each twice as large as the previous one");
  s.field("iterations", &TrainingSettings::iterations, "Number of training iterations")
      .at_most(1000);
  s.field("share", &TrainingSettings::share, "Largest share of the budget spent on training")
      .at_least(0)
      .below(1);
  s.field("images", &TrainingSettings::images,
          "Use of the images of training iterations: discarded, or combined with the final image, "
          "weighted by their numbers of samples; the first sixteenth of all samples counts less");
  s.field("latest_images", &TrainingSettings::latest_images,
          "Largest number of combined images, including the final one; the first images may be "
          "much noisier than the rest, because their guides know little")
      .at_least(1)
      .at_most(1001);
  s.field("region_samples", &TrainingSettings::region_samples,
          "Least mean number of training samples for each region of the largest model in an "
          "iteration; iterations that would have fewer are longer")
      .at_least(0);
  s.field("tolerance", &TrainingSettings::tolerance,
          "Training ends once the gain of the guides, by which they explain new light better than "
          "unguided sampling, changes by less than this from one iteration to the next; 0: it uses "
          "up its share")
      .unit("nats")
      .at_least(0);
  s.field("least_gain", &TrainingSettings::least_gain,
          "The final image is not guided if the gain of the guides is less than this; 0: it always "
          "is")
      .unit("nats")
      .at_least(0);
  s.field("trial", &TrainingSettings::trial,
          "Once this share of the budget is spent, training ends if the gain is less than "
          "`least_gain`, and would be after another rise like the last one. Until the gain exceeds "
          "`least_gain` by a standard error, this share also limits each iteration")
      .at_least(0)
      .at_most(1);
}

}  // namespace pharos
