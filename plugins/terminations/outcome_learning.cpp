#include "outcome_learning.h"

#include <cmath>
#include <utility>

namespace pharos {

OutcomeLearning::OutcomeLearning(const OutcomeSettings& settings, const LearningContext& context,
                                 MakeRule make)
    : settings_(settings),
      window_(context.window),
      make_(std::move(make)),
      pixels_(context.window),
      paths_(context.window),
      rule_(settings.first.rule()) {}

void OutcomeLearning::absorb(const PathLog& log) {
  for (std::size_t i = 0; i < log.size(); ++i) {
    const PathView path = log[i];
    if (path.transport != Transport::radiance || path.vertices.empty()) continue;
    const double most = knows_pixels_ ? settings_.outlier * pixels_.at(path.film) : kInfinity;
    const PathOutcome found = reader_.read(path, most, steps_);
    if (!std::isfinite(found.radiance) || !std::isfinite(found.paths)) continue;
    has_light_ |= found.radiance > 0;
    pixels_.add(path.film, found.radiance, found.paths);
    paths_.add(path.film, std::min(found.radiance, most), found.cost);
  }
  if (steps_.size() >= settings_.batch_steps) learn_steps();
}

void OutcomeLearning::learn_steps() {
  const CellDivision division{.cell_samples = settings_.cell_steps,
                              .max_depth = static_cast<int>(settings_.cell_depth),
                              .decay = 0.5};  // each half gets half of what the cell has found
  const DirectionBins bins = directions();
  cells_.learn(steps_, division,
               [&](OutcomeCell& cell, std::span<const StepOutcome> outcomes, std::size_t) {
                 cell.learn(outcomes, bins);
               });
}

PixelMap OutcomeLearning::pixel_map() const {
  return {window_, [this](Vec2 film) { return pixels_.at(film); }};
}

void OutcomeLearning::update(const TrainingStage&) {
  learn_steps();
  pixels_.update(static_cast<int>(settings_.pixel_radius), settings_.least_pixel);
  // Before pixels are known, outliers count in full. They are forgotten as soon as possible.
  const double kept = knows_pixels_ ? settings_.decay : 0;
  knows_pixels_ = has_light_;
  if (knows_pixels_ && cells_.know_something()) {
    PixelMap map = pixel_map();
    const double variance = paths_.relative_variance(map);
    learned_ = std::make_shared<const LearnedOutcomes>(
        LearnedOutcomes{OutcomeField(cells_, directions(), settings_.prior), std::move(map),
                        variance, paths_.cost()});
  }
  make_rule();
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].forget(kept);
  paths_.forget(kept);
}

void OutcomeLearning::make_rule() {
  const auto rule = learned_ != nullptr ? make_(learned_) : nullptr;
  rule_ = rule != nullptr ? rule : settings_.first.rule();
}

void OutcomeLearning::archive(Archive& archive) {
  archive.heading("outcomes of steps", 1);
  archive(steps_, cells_, pixels_, paths_, has_light_, knows_pixels_);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::size_t bins = cells_[i].bins.size();
    archive.expect(bins == 0 || bins == directions().count(), "what was learned of steps");
  }
  bool is_known = learned_ != nullptr;
  archive(is_known);
  LearnedOutcomes learned = is_known && !archive.loads()
                                ? *learned_
                                : LearnedOutcomes{OutcomeField(directions()), pixel_map()};
  if (is_known) archive(learned.steps, learned.path_variance, learned.path_cost);
  if (!archive.loads()) return;
  archive.expect(learned.path_variance >= 0 && learned.path_cost >= 0, "what was learned of paths");
  learned_ = is_known ? std::make_shared<const LearnedOutcomes>(std::move(learned)) : nullptr;
  make_rule();
}

}  // namespace pharos
