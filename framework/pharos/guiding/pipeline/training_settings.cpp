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
          "weighted by their numbers of samples; the first eighth of all samples counts less");
  s.field("pixels", &TrainingSettings::pixels,
          "Samples of the final image: the same number for every pixel, or more for pixels that "
          "were noisy in the training images");
  s.field("recorded_samples", &TrainingSettings::recorded_samples,
          "Largest number of samples per pixel of an iteration from which the guides learn; the "
          "rest only adds to its image, which `images: discard` would waste; 0: all");
  s.field("latest_images", &TrainingSettings::latest_images,
          "Largest number of combined images, including the final one; the first images may be "
          "much noisier than the rest, because their guides know little")
      .at_least(1)
      .at_most(1001);
  s.field("region_samples", &TrainingSettings::region_samples,
          "Least mean number of training samples for each region of the largest model in an "
          "iteration; iterations that would have fewer are longer")
      .at_least(0);
  s.field(
       "tolerance", &TrainingSettings::tolerance,
       "Training ends once another iteration is expected neither to raise the gain of the guides "
       "nor to lower the logarithm of the noise by this, and by what the iteration costs; 0: it "
       "uses up its "
       "share. The gain says how much better they explain new light than unguided sampling")
      .unit("nats")
      .at_least(0);
  s.field("least_gain", &TrainingSettings::least_gain,
          "The final image is not guided if the gain of the guides is less than this; 0: it always "
          "is")
      .unit("nats")
      .at_least(0);
  s.field("most_noise", &TrainingSettings::most_noise,
          "A gain below `least_gain` still suffices if guides lower the mean squared error that an "
          "image has after the same time to this part or less; 0: it does not")
      .at_least(0)
      .at_most(1);
  s.field("least_part", &TrainingSettings::least_part,
          "A method is left out of the rest of the render if, without it, the gain would have been "
          "lower by less than this in each of the last two iterations; 0: none is left out")
      .unit("nats")
      .at_least(0);
  s.field(
       "trial", &TrainingSettings::trial,
       "Once about this share of the budget is spent, training ends if the guides do not suffice, "
       "unless the noise may fall by enough to be worth the time of another iteration, or, with "
       "`most_noise: 0`, the gain may reach `least_gain` in it. Nothing is decided before. Until "
       "they surely suffice, an iteration takes at most the rest of this share or half of it, "
       "whichever is larger; as long as the gain is unknown, it may take more")
      .at_least(0)
      .at_most(1);
}

}  // namespace pharos
