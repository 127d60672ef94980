#include "learning_state.h"

#include "vmf_model.h"

namespace pharos::vmf {
namespace {

constexpr const char* kHeading = "vmf_learning";
constexpr std::uint32_t kVersion = 1;

}  // namespace

VmfState::VmfState(const VmfSettings& settings, const LearningContext&) : settings_(settings) {}

void VmfState::absorb(const PathLog& log) {
  const SampleRule rule{settings_.least_pdf, settings_.glossy};
  for (std::size_t i = 0; i < log.size(); ++i) extract_samples(log[i], rule, scratch_, samples_);
  if (samples_.size() >= settings_.batch_samples) {
    learn();
    learned_early_ = true;
  }
}

std::shared_ptr<const GuidingModel> VmfState::update(std::uint32_t, bool) {
  learn();
  learned_early_ = false;
  if (!cells_.know_something()) return nullptr;
  auto learned = model();
  cells_.mark_origins();
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].forget(settings_.decay);
  return learned;
}

void VmfState::learn() {
  const CellDivision division{.divides = settings_.spatial == SpatialCells::kdtree,
                              .cell_samples = settings_.cell_samples,
                              .max_depth = settings_.max_depth,
                              .decay = settings_.division_decay};
  const auto teach = [&](CellMixture& cell, std::span<const Sample> samples, std::size_t) {
    cell.update(samples, settings_);
  };
  cells_.learn(samples_, division, teach);
  ++lessons_;
}

std::shared_ptr<const GuidingModel> VmfState::model() const {
  std::vector<VmfModel::Cell> cells;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const CellMixture& cell = cells_[i];
    cells.push_back({.pivot = cell.pivot(), .samples = static_cast<float>(cell.samples())});
    append_groups(cell.mixture(), cell.inverse_distances(), cells.back().groups);
  }
  return std::make_shared<VmfModel>(cells_.tree(), cells, cells_.origins());
}

void VmfState::save(std::ostream& out) const {
  save_heading(out, kHeading, kVersion);
  save_number(out, lessons_);
  save_number(out, static_cast<std::uint8_t>(learned_early_));
  cells_.save(out);
  save_number(out, static_cast<std::uint64_t>(samples_.size()));
  for (const Sample& sample : samples_) save_sample(sample, out);
}

void VmfState::load(std::istream& in) {
  expect_heading(in, kHeading, kVersion);
  VmfState loaded(*this);
  loaded.lessons_ = load_number<std::uint64_t>(in);
  loaded.learned_early_ = load_number<std::uint8_t>(in) != 0;
  loaded.cells_.load(in);
  loaded.samples_.clear();
  for (auto count = load_number<std::uint64_t>(in); count > 0; --count) {
    loaded.samples_.push_back(load_sample(in));
  }
  *this = std::move(loaded);
}

void VmfState::merge(const LearningState& other) {
  const auto& theirs = dynamic_cast<const VmfState&>(other);
  const bool is_alike = theirs.cells_.tree() == cells_.tree() && theirs.lessons_ == lessons_;
  if (!is_alike || learned_early_ || theirs.learned_early_) {
    throw InputError(
        "learning of mixtures in another iteration or scene, or after more than `batch_samples`, "
        "cannot be merged");
  }
  samples_.insert(samples_.end(), theirs.samples_.begin(), theirs.samples_.end());
}

}  // namespace pharos::vmf
