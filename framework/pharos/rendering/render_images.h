#pragma once

#include <pharos/core/archive.h>
#include <pharos/core/image.h>
#include <pharos/guiding/pipeline/training_settings.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/image_combiner.h>

namespace pharos {

/// The images of the iterations of a render. Those that are part of the result are combined. As
/// long as there are none of these, the image of the last iteration is the result.
class RenderImages {
 public:
  /// `blank` is the image of a render without iterations.
  RenderImages(const TrainingSettings& training, Image blank);

  /// Adds the film of an iteration that is over, possibly because the render was stopped. It was
  /// rendered with a part `spent` of the budget.
  void add(const Film& film, bool training, SpentBudget spent);
  /// Returns the image with which the render would end now.
  Image result() const { return combiner_.empty() ? last_ : combiner_.combine(); }
  /// Returns the image with which the render would end if an iteration with this film was over; see
  /// add(). A training image that is not part of the result is shown by itself.
  Image result_with(const Film& film, bool training, SpentBudget spent) const;

  void archive(Archive& archive);

 private:
  /// Whether the image of an iteration is part of the result.
  bool keeps(bool training) const { return !training || combines_training_; }

  bool combines_training_;
  ImageCombiner combiner_;
  Image last_;
  bool is_whole_ = false;  ///< `last_` shows at least one whole pass
};

}  // namespace pharos
