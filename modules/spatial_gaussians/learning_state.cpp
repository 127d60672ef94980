#include "learning_state.h"

#include "gaussian_model.h"

namespace pharos::gaussians {
namespace {

constexpr const char* kHeading = "gaussian_learning";
constexpr std::uint32_t kVersion = 2;

/// A scene without extent is taken to be of size one.
double size_of(const Bounds3& region) {
  return region.diagonal() > 0 ? region.diagonal() : 1;
}

}  // namespace

GaussianState::GaussianState(const GaussianSettings& settings, const LearningContext& context)
    : settings_(settings),
      rule_{settings.least_pdf,
            settings.environment_distance * static_cast<float>(size_of(context.region))},
      scene_size_(size_of(context.region)),
      seed_(context.seed) {}

void GaussianState::absorb(const PathLog& log) {
  for (std::size_t i = 0; i < log.size(); ++i) {
    extract_samples(log[i], rule_, incident_, samples_);
  }
  if (samples_.size() >= settings_.batch_samples) {
    learn();
    learned_early_ = true;
  }
}

std::shared_ptr<const GuidingModel> GaussianState::update(std::uint32_t, bool) {
  learn();
  learned_early_ = false;
  if (!cells_.know_something()) return nullptr;
  auto learned = model();
  cells_.mark_origins();
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].forget(settings_.decay);
  return learned;
}

void GaussianState::learn() {
  const CellDivision division{.divides = settings_.spatial == SpatialCells::kdtree,
                              .cell_samples = settings_.cell_samples,
                              .max_depth = settings_.max_depth,
                              .decay = settings_.division_decay};
  const auto teach = [&](CellMixture& cell, std::span<const Sample> samples, std::size_t number) {
    cell.update(samples, settings_, scene_size_, RandomStream(seed_, lessons_, number));
  };
  cells_.learn(samples_, division, teach);
  ++lessons_;
}

std::shared_ptr<const GuidingModel> GaussianState::model() const {
  std::vector<GaussianModel::Cell> cells;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    cells.push_back({cells_[i].components(), static_cast<float>(cells_[i].samples())});
  }
  return std::make_shared<GaussianModel>(cells_.tree(), cells, cells_.origins());
}

void GaussianState::save(std::ostream& out) const {
  save_heading(out, kHeading, kVersion);
  save_number(out, lessons_);
  save_number(out, static_cast<std::uint8_t>(learned_early_));
  cells_.save(out);
  save_number(out, static_cast<std::uint64_t>(samples_.size()));
  for (const Sample& sample : samples_) save_sample(sample, out);
}

void GaussianState::load(std::istream& in) {
  expect_heading(in, kHeading, kVersion);
  GaussianState loaded(*this);
  loaded.lessons_ = load_number<std::uint64_t>(in);
  loaded.learned_early_ = load_number<std::uint8_t>(in) != 0;
  loaded.cells_.load(in);
  loaded.samples_.clear();
  for (auto count = load_number<std::uint64_t>(in); count > 0; --count) {
    loaded.samples_.push_back(load_sample(in));
  }
  *this = std::move(loaded);
}

void GaussianState::merge(const LearningState& other) {
  const auto& theirs = dynamic_cast<const GaussianState&>(other);
  const bool is_alike = theirs.cells_.tree() == cells_.tree() && theirs.lessons_ == lessons_;
  if (!is_alike || learned_early_ || theirs.learned_early_) {
    throw InputError(
        "learning of Gaussians in another iteration or scene, or after more than `batch_samples`, "
        "cannot be merged");
  }
  samples_.insert(samples_.end(), theirs.samples_.begin(), theirs.samples_.end());
}

}  // namespace pharos::gaussians
