#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/core/error.h>
#include <pharos/guiding/contract/learner.h>
#include <pharos/guiding/toolkit/kd_tree_cells.h>

namespace pharos {

/// What mixtures are kept for.
enum class SpatialCells {
  kdtree,  ///< one for each cell of a tree that grows
  single   ///< one for the whole scene
};
template <>
struct EnumNames<SpatialCells> {
  static constexpr std::array<std::pair<std::string_view, SpatialCells>, 2> names{
      {{"kdtree", SpatialCells::kdtree}, {"single", SpatialCells::single}}};
};

/// The learning of methods that learn cell by cell of a tree (KdTreeCells): samples wait until
/// the end of an iteration, or until there are `batch_samples` of them.
///
/// `Method` is a value that says how:
///
///     using Sample = …;  using Cell = …;    // those of KdTreeCells; samples save and load, too
///     static constexpr const char* kHeading;  static constexpr std::uint32_t kVersion;
///     const Settings& settings() const;     // with spatial, cell_samples, max_depth,
///                                           // batch_samples, decay, division_decay
///     void extract(const PathView&, std::vector<Sample>& samples);
///     void teach(Cell&, std::span<const Sample>, std::uint64_t lesson, std::size_t cell) const;
///     std::shared_ptr<const GuidingModel> model(const KdTreeCells<Sample, Cell>&) const;
template <class Method>
class KdTreeLearning final : public LearningState {
 public:
  explicit KdTreeLearning(Method method) : method_(std::move(method)) {}

  void absorb(const PathLog& log) override {
    for (std::size_t i = 0; i < log.size(); ++i) method_.extract(log[i], samples_);
    if (samples_.size() < method_.settings().batch_samples) return;
    learn();
    learned_early_ = true;
  }

  std::shared_ptr<const GuidingModel> update(std::uint32_t, bool) override {
    learn();
    learned_early_ = false;
    if (!cells_.know_something()) return nullptr;
    auto learned = method_.model(cells_);
    cells_.mark_origins();
    for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].forget(method_.settings().decay);
    return learned;
  }

  void save(std::ostream& out) const override {
    save_heading(out, Method::kHeading, Method::kVersion);
    save_number(out, lessons_);
    save_number(out, static_cast<std::uint8_t>(learned_early_));
    cells_.save(out);
    save_number(out, static_cast<std::uint64_t>(samples_.size()));
    for (const Sample& sample : samples_) sample.save(out);
  }

  void load(std::istream& in) override {
    expect_heading(in, Method::kHeading, Method::kVersion);
    KdTreeLearning loaded(*this);
    loaded.lessons_ = load_number<std::uint64_t>(in);
    loaded.learned_early_ = load_number<std::uint8_t>(in) != 0;
    loaded.cells_.load(in);
    loaded.samples_.clear();
    for (auto count = load_number<std::uint64_t>(in); count > 0; --count) {
      loaded.samples_.push_back(Sample::load(in));
    }
    *this = std::move(loaded);
  }

  void merge(const LearningState& other) override {
    const auto& theirs = dynamic_cast<const KdTreeLearning&>(other);
    const bool is_alike = theirs.cells_.tree() == cells_.tree() && theirs.lessons_ == lessons_;
    if (!is_alike || learned_early_ || theirs.learned_early_) {
      throw InputError(std::string(Method::kHeading) +
                       ": in another iteration or scene, or after more than `batch_samples`, "
                       "learning cannot be merged");
    }
    samples_.insert(samples_.end(), theirs.samples_.begin(), theirs.samples_.end());
  }

 private:
  using Sample = typename Method::Sample;
  using Cell = typename Method::Cell;

  /// Learns from the samples that wait.
  void learn() {
    const auto& settings = method_.settings();
    const CellDivision division{.divides = settings.spatial == SpatialCells::kdtree,
                                .cell_samples = settings.cell_samples,
                                .max_depth = settings.max_depth,
                                .decay = settings.division_decay};
    cells_.learn(samples_, division,
                 [&](Cell& cell, std::span<const Sample> samples, std::size_t number) {
                   method_.teach(cell, samples, lessons_, number);
                 });
    ++lessons_;
  }

  Method method_;
  KdTreeCells<Sample, Cell> cells_;
  std::uint64_t lessons_ = 0;    ///< calls of learn()
  bool learned_early_ = false;   ///< from samples of this iteration, before its end
  std::vector<Sample> samples_;  ///< that wait
};

}  // namespace pharos
