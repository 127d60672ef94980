#include <utility>

#include <pharos/rendering/render_images.h>

namespace pharos {

RenderImages::RenderImages(const TrainingSettings& training, Image blank)
    : combines_training_(training.images == TrainingImages::combine),
      combiner_(training.latest_images),
      last_(std::move(blank)) {}

void RenderImages::add(const Film& film, bool training, SpentBudget spent) {
  const bool has_pass = film.complete_passes() > 0;
  // A film that was stopped during its first pass has holes. It is used only if there is no other.
  if (has_pass || !is_whole_) last_ = film.layers();
  is_whole_ |= has_pass;
  if (has_pass && keeps(training)) combiner_.add(film, spent);
}

Image RenderImages::result_with(const Film& film, bool training, SpentBudget spent) const {
  if (!keeps(training) || combiner_.empty()) return film.layers();
  ImageCombiner combiner = combiner_;
  combiner.add(film, spent);
  return combiner.combine();
}

void RenderImages::archive(Archive& archive) {
  archive(combiner_, is_whole_);
  if (is_whole_ && combiner_.empty()) archive(last_);
}

}  // namespace pharos
