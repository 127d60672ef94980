#include "outcome_learning.h"

#include <cmath>
#include <limits>
#include <utility>

namespace pharos {

OutcomeLearning::OutcomeLearning(const OutcomeSettings& settings, const LearningContext& context,
                                 MakeRule make)
    : settings_(settings),
      window_(context.window),
      make_(std::move(make)),
      film_(context.window),
      error_(settings.outliers_of_pass(), settings.pass()),
      rule_(settings.first.rule()) {}

void OutcomeLearning::absorb(const PathLog& log) {
  for (std::size_t i = 0; i < log.size(); ++i) {
    const PathView path = log[i];
    if (path.transport == Transport::radiance && !path.vertices.empty()) learn_path(path);
  }
  if (outcomes_.size() >= settings_.batch_steps) learn_outcomes();
}

void OutcomeLearning::learn_path(const PathView& path) {
  // The largest value of a path whose error counts in full.
  const double limit = learned_ != nullptr && largest_error_ > 0
                           ? learned_->pixels.at(path.film) +
                                 std::sqrt(largest_error_) * learned_->scale_at(path.film)
                           : std::numeric_limits<double>::infinity();
  const PathOutcome found = reader_.read(path, rule_->stage(), limit, outcomes_);
  if (!std::isfinite(found.radiance) || !std::isfinite(found.paths) || !(found.paths > 0)) return;
  film_.add(path.film, {found.radiance, found.paths, path.albedo, path.normal});
  if (learned_ == nullptr) return;
  const double difference = found.radiance / found.paths - learned_->pixels.at(path.film);
  const double error = found.paths * difference / learned_->scale_at(path.film);
  error_.add(error * error, found.cost);
}

void OutcomeLearning::learn_outcomes() {
  const CellDivision division{.divides = cells_.size() < settings_.most_cells,
                              .cell_samples = settings_.cell_steps,
                              .max_depth = static_cast<int>(settings_.cell_depth),
                              .decay = 0.5};  // each half gets half of what the cell has found
  const DirectionBins bins = directions();
  cells_.learn(outcomes_, division,
               [&](OutcomeCell& cell, std::span<const Outcome> outcomes, std::size_t) {
                 cell.learn(outcomes, bins);
               });
}

OutcomeLearning::Known OutcomeLearning::summary() const {
  const double mean = film_.mean();
  if (!(mean > 0) || !cells_.know_something()) return nullptr;
  return std::make_shared<const LearnedOutcomes>(LearnedOutcomes{
      OutcomeField(cells_, directions(), settings_.least_steps),
      film_.denoised(settings_.denoising), static_cast<float>(settings_.pixel_offset * mean),
      error_.squared(), error_.cost(), settings_.branches_in(uses_)});
}

void OutcomeLearning::update(const TrainingStage& stage) {
  learn_outcomes();
  is_in_use_ = ++updates_ >= settings_.first_iterations || stage.is_last();
  if (is_in_use_) ++uses_;
  learned_ = summary();
  make_rule();
  const bool was_unlimited = largest_error_ == 0;
  if (was_unlimited) largest_error_ = error_.largest();
  // What was found without a limit is forgotten.
  const double kept = was_unlimited && largest_error_ > 0 ? 0 : settings_.decay;
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].forget(kept);
  error_.clear();
}

void OutcomeLearning::make_rule() {
  const auto rule = is_in_use_ && learned_ != nullptr ? make_(learned_) : nullptr;
  rule_ = rule != nullptr ? rule : settings_.first.rule();
}

void OutcomeLearning::archive(Archive& archive) {
  archive.heading("outcomes of steps", 6);
  archive(outcomes_, cells_, film_, error_, updates_, uses_, largest_error_);
  archive.expect(largest_error_ >= 0, "the errors of paths");
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::size_t bins = cells_[i].bins.size();
    archive.expect(bins == 0 || bins == directions().count(), "what was learned of steps");
  }
  archive_rule(archive);
}

void OutcomeLearning::archive_rule(Archive& archive) {
  bool is_known = learned_ != nullptr;
  archive(is_in_use_, is_known);
  LearnedOutcomes learned = is_known && !archive.loads()
                                ? *learned_
                                : LearnedOutcomes{OutcomeField(directions()), PixelMap(window_)};
  if (is_known) {
    archive(learned.outcomes, learned.pixels, learned.pixel_offset, learned.squared_error,
            learned.path_cost, learned.branches);
  }
  if (!archive.loads()) return;
  archive.expect(learned.branches >= 1, "what was learned of paths");
  archive.expect(!is_known || learned.pixel_offset > 0, "what was learned of pixels");
  archive.expect(learned.squared_error >= 0 && learned.path_cost >= 0, "what was learned of paths");
  learned_ = is_known ? std::make_shared<const LearnedOutcomes>(std::move(learned)) : nullptr;
  make_rule();
}

}  // namespace pharos
