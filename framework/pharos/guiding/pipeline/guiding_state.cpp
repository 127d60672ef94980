#include <algorithm>
#include <numeric>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/guiding/pipeline/guiding.h>

namespace pharos {

struct GuidingState::Method {
  GuidingMethod settings;
  std::unique_ptr<LearningState> state;  ///< null: it does not learn
  std::shared_ptr<const GuidingModel> model;
  std::shared_ptr<const BoundGuider> bound;

  std::uint32_t region_count() const { return model == nullptr ? 1 : model->region_count(); }

  void take(std::shared_ptr<const GuidingModel> next) {
    model = std::move(next);
    bound = model == nullptr ? nullptr : settings.guider->bind(model);
  }

  void start(const LearningContext& context) {
    if (settings.learns()) state = settings.learner->begin(context);
    take(settings.learns() ? state->initial_model() : settings.model);
  }

  void absorb(const PathLog& log) {
    if (state != nullptr) state->absorb(log);
  }

  void update(std::uint32_t iteration, bool last) {
    if (state != nullptr) take(state->update(iteration, last));
  }

  /// Appends where each of this model's regions came from among the `old_regions` before it, which
  /// are numbered from `first` on. Regions of a first model all come from the one there was.
  void append_origins(std::uint32_t first, std::uint32_t old_regions,
                      std::vector<std::uint32_t>& origins) const {
    const bool is_new = model != nullptr && state != nullptr;
    std::vector<std::uint32_t> own =
        is_new ? model->region_origins() : std::vector<std::uint32_t>{};
    if (own.empty()) {
      own.assign(region_count(), 0u);
      if (old_regions == region_count()) std::iota(own.begin(), own.end(), 0u);
    }
    const bool fits = own.size() == region_count() &&
                      std::all_of(own.begin(), own.end(),
                                  [&](std::uint32_t origin) { return origin < old_regions; });
    if (!fits) throw RunError("the model '" + model->name() + "' misstates its regions' origins");
    for (const std::uint32_t origin : own) origins.push_back(first + origin);
  }
};

GuidingState::GuidingState(const GuidingSettings& settings, const LearningContext& context)
    : mixing_(settings.mixing->begin()) {
  std::uint64_t index = 0;
  for (GuidingMethod& method : settings.resolved_methods()) {
    LearningContext own = context;
    own.seed = hash_combine(context.seed, index++);
    Method& added = methods_.emplace_back();
    added.settings = std::move(method);
    added.start(own);
  }
  std::uint32_t regions = 0;
  for (const Method& method : methods_) regions += method.region_count();
  fractions_ = mixing_->update(regions, {});
  rebuild_frame();
}

GuidingState::~GuidingState() = default;

void GuidingState::absorb(const PathLog& log) {
  for (Method& method : methods_) method.absorb(log);
  mixing_->absorb(log);
}

void GuidingState::update(std::uint32_t iteration, bool last) {
  std::vector<std::uint32_t> origins;
  std::uint32_t first_old_region = 0;
  for (Method& method : methods_) {
    const std::uint32_t old_regions = method.region_count();
    method.update(iteration, last);
    method.append_origins(first_old_region, old_regions, origins);
    first_old_region += old_regions;
  }
  fractions_ = mixing_->update(static_cast<std::uint32_t>(origins.size()), origins);
  rebuild_frame();
}

void GuidingState::rebuild_frame() {
  std::vector<GuidingFrame::Method> frame;
  std::uint32_t first_region = 0;
  bool anything_known = false;
  for (const Method& method : methods_) {
    const GuiderTraits traits = method.settings.guider->traits();
    frame.push_back({.guider = method.bound,
                     .weight = method.settings.weight,
                     .steers_distance = traits.steers_distance,
                     .steers_events = traits.steers_events,
                     .guides_light_paths = traits.guides_light_paths,
                     .first_region = first_region});
    first_region += method.region_count();
    anything_known |= method.bound != nullptr;
  }
  frame_ = anything_known ? std::make_shared<GuidingFrame>(std::move(frame), fractions_) : nullptr;
}

std::shared_ptr<const GuidingModel> GuidingState::model(std::size_t i) const {
  return methods_[i].model;
}

const std::string& GuidingState::learner_name(std::size_t i) const {
  return methods_[i].settings.learner->plugin_name();
}

std::size_t GuidingState::model_bytes() const {
  std::size_t bytes = 0;
  for (const Method& method : methods_) {
    if (method.model != nullptr) bytes += method.model->size_bytes();
  }
  return bytes;
}

}  // namespace pharos
