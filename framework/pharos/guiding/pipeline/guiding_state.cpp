#include <algorithm>
#include <numeric>
#include <sstream>
#include <utility>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/guiding/pipeline/guiding_state.h>

namespace pharos {

/// The source of a model: a learner or a file. Several guiders may sample the model.
struct GuidingState::Source {
  Ref<Learner> learner;
  std::unique_ptr<LearningState> state;  ///< null: the model was read from a file
  std::shared_ptr<const GuidingModel> model;
  std::uint32_t regions = 1;
  bool is_idle = false;  ///< no guider of its model is asked any more, so it learns no more

  void take(std::shared_ptr<const GuidingModel> next) {
    model = std::move(next);
    regions = model == nullptr ? 1 : model->info().regions;
  }

  Source(const GuidingMethod& method, const LearningContext& context) : learner(method.learner) {
    if (method.learns()) state = learner->begin(context);
    take(method.model);
  }

  /// Ends an iteration. Appends to `origins`, for each region of the new model, the region of the
  /// previous model from which it came. Regions of the previous model are numbered from `first`.
  /// All regions of the first model come from the single region that existed before.
  void update(const TrainingStage& stage, std::uint32_t first,
              std::vector<std::uint32_t>& origins) {
    const std::uint32_t before = regions;
    std::vector<std::uint32_t> own;
    if (state != nullptr && !is_idle) {
      Learned learned = state->update(stage);
      take(std::move(learned.model));
      own = std::move(learned.region_origins);
    }
    if (own.empty()) {
      own.assign(regions, 0u);
      if (before == regions) std::iota(own.begin(), own.end(), 0u);
    }
    const bool fits =
        own.size() == regions &&
        std::all_of(own.begin(), own.end(), [&](std::uint32_t origin) { return origin < before; });
    if (!fits) {
      throw RunError("the learner '" + learner->plugin_name() + "' misstates its regions' origins");
    }
    for (const std::uint32_t origin : own) origins.push_back(first + origin);
  }

  /// Saves or loads the model, unless it was read from a file.
  void archive_model(Archive& archive) {
    if (state == nullptr) return;
    bool has_model = model != nullptr;
    archive(has_model);
    if (archive.loads()) {
      const auto loaded = has_model ? learner->empty_model() : nullptr;
      if (has_model) loaded->archive(archive);
      take(loaded);
    } else if (has_model) {
      // Saving only reads the model.
      std::const_pointer_cast<GuidingModel>(model)->archive(archive);
    }
  }
};

GuidingState::GuidingState(const GuidingSettings& settings, const LearningContext& context)
    : policy_(settings.mixing),
      policy_config_(settings.mixing_config.empty() ? settings.mixing->plugin_name()
                                                    : settings.mixing_config),
      rules_{.candidates = settings.candidates},
      is_final_(!settings.learns()) {
  if (settings.last_bounce) rules_.last_bounce = *settings.last_bounce;
  const TrainingSettings& training = settings.training;
  if (training.puts_guides_on_trial()) trial_.emplace(training, context.window);
  std::vector<float> weights;
  for (const GuidingMethod& method : settings.resolved_methods()) {
    LearningContext own = context;
    own.seed = hash_combine(context.seed, sources_.size());
    if (!method.shares_model()) sources_.emplace_back(method, own);
    users_.push_back({method.guider, sources_.size() - 1, method.weight});
    weights.push_back(method.weight);
  }
  mixing_ = settings.mixing->begin(weights);
  mixing_->update(regions(), {}, false);
  if (!settings.mixing_state.empty()) {
    load_mixing_state(settings.model_file, settings.mixing_state, *mixing_);
  }
  rebuild_frame();
}

GuidingState::~GuidingState() = default;

void GuidingState::absorb(const PathLog& log) {
  for (Source& source : sources_) {
    if (source.state != nullptr && !source.is_idle) source.state->absorb(log);
  }
  mixing_->absorb(log);
  if (trial_) trial_->absorb(log, frame_ != nullptr);
  for (std::size_t i = 0; i < log.size(); ++i) {
    for (const RecordedVertex& vertex : log[i].vertices) samples_ += vertex.guidable ? 1 : 0;
  }
}

bool GuidingState::may_end_training(const IterationCost& cost) {
  return trial_ && trial_->end_iteration(cost, frame_ != nullptr);
}

void GuidingState::leave_out_dispensable_method() {
  const std::optional<std::size_t> method =
      trial_ && frame_ != nullptr ? trial_->dispensable_method() : std::nullopt;
  if (!method) return;
  users_[*method].is_out = true;
  mixing_->leave_out(*method);
  mark_idle_sources();
}

void GuidingState::mark_idle_sources() {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    Source& source = sources_[i];
    source.is_idle = std::all_of(users_.begin(), users_.end(), [&](const User& user) {
      return user.source != i || user.is_out || is_off_;
    });
    if (source.is_idle && source.state != nullptr) source.state->end_learning();
  }
}

void GuidingState::update(const TrainingStage& stage) {
  is_final_ = stage.is_last();
  is_off_ = is_final_ && frame_ != nullptr && trial_ && trial_->is_useless();
  mark_idle_sources();
  leave_out_dispensable_method();
  std::vector<std::uint32_t> origins;
  std::uint32_t first = 0;
  for (Source& source : sources_) {
    const std::uint32_t before = source.regions;
    source.update(stage, first, origins);
    first += before;
  }
  if (is_off_) {
    mixing_->end_learning();
  } else {
    mixing_->update(static_cast<std::uint32_t>(origins.size()), origins, stage.is_last());
  }
  last_samples_ = std::exchange(samples_, 0);
  rebuild_frame();
}

std::optional<GuideGain> GuidingState::gain() const {
  std::optional<GuideGain> gain = trial_ ? trial_->gain() : std::nullopt;
  if (gain) gain->is_off = is_off_;
  return gain;
}

double GuidingState::samples_per_region() const {
  std::uint32_t most = 1;
  for (const Source& source : sources_) most = std::max(most, source.regions);
  return static_cast<double>(last_samples_) / most;
}

std::uint32_t GuidingState::regions() const {
  std::uint32_t sum = 0;
  for (const Source& source : sources_) sum += source.regions;
  return sum;
}

void GuidingState::rebuild_frame() {
  std::vector<std::uint32_t> first_regions(sources_.size(), 0);
  for (std::size_t i = 1; i < sources_.size(); ++i) {
    first_regions[i] = first_regions[i - 1] + sources_[i - 1].regions;
  }
  std::shared_ptr<const MixingShares> shares = mixing_->shares();
  std::vector<GuidingFrame::Method> methods;
  bool is_any_asked = false;
  for (const User& user : users_) {
    const std::shared_ptr<const GuidingModel>& model = sources_[user.source].model;
    const bool is_asked = model != nullptr && !user.is_out && shares->asks(methods.size());
    GuidingFrame::Method& method = methods.emplace_back();
    if (is_asked) method.guider.emplace(*user.guider, model);
    method.traits = user.guider->traits();
    method.first_region = first_regions[user.source];
    is_any_asked |= is_asked;
  }
  GuidingRules rules = rules_;
  if (!is_final_) rules.candidates = 1;
  frame_ = is_any_asked && !is_off_
               ? std::make_shared<const GuidingFrame>(std::move(methods), std::move(shares), rules)
               : nullptr;
}

std::shared_ptr<const GuidingModel> GuidingState::model(std::size_t i) const {
  return sources_[users_[i].source].model;
}

std::unique_ptr<const LearnedGuiding> GuidingState::learned() const {
  auto learned = std::make_unique<LearnedGuiding>();
  for (const Source& source : sources_) {
    if (source.model == nullptr) return nullptr;
    learned->models.push_back({source.learner->plugin_name(), source.model});
  }
  for (const User& user : users_) {
    learned->methods.push_back({static_cast<std::uint32_t>(user.source), user.weight});
  }
  learned->mixing = policy_->plugin_name();
  learned->mixing_config = policy_config_;
  std::ostringstream out;
  save(out, *mixing_);
  learned->mixing_state = std::move(out).str();
  return learned;
}

std::size_t GuidingState::model_bytes() const {
  std::size_t bytes = 0;
  for (const Source& source : sources_) {
    if (source.model != nullptr) bytes += source.model->info().bytes;
  }
  return bytes;
}

void GuidingState::archive(Archive& archive) {
  archive.heading("guiding", 11);
  for (Source& source : sources_) {
    if (source.state != nullptr) source.state->archive(archive);
  }
  archive(samples_, last_samples_);
  if (trial_) trial_->archive(archive);
  archive_guides(archive);
}

void GuidingState::archive_guides(Archive& archive) {
  archive.heading("guides", 1);
  for (Source& source : sources_) source.archive_model(archive);
  for (User& user : users_) archive(user.is_out);
  if (archive.loads()) mixing_->update(regions(), {}, false);
  mixing_->archive(archive);
  archive(is_final_, is_off_);
  mark_idle_sources();
  if (archive.loads()) rebuild_frame();
}

}  // namespace pharos
