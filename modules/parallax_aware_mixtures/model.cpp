#include "model.h"

#include <algorithm>

#include <fmt/format.h>

#include <pharos/core/binary_stream.h>

#include "seen_lobes.h"

namespace pharos::parallax_aware_mixtures {

ParallaxAwareMixturesModel::ParallaxAwareMixturesModel(KdTree tree, const std::vector<Cell>& cells,
                                                       std::vector<std::uint32_t> origins)
    : tree_(std::move(tree)), origins_(std::move(origins)) {
  for (const Cell& cell : cells) add(cell);
  places_.push_back({{}, static_cast<std::uint32_t>(groups_.size())});
}

ParallaxAwareMixturesModel::ParallaxAwareMixturesModel(std::istream& in) {
  expect_heading(in, kName, kVersion);
  tree_ = KdTree::load(in);
  for (std::uint32_t i = 0; i < tree_.cell_count(); ++i) {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis) cell.pivot[axis] = load_finite<float>(in);
    cell.samples = load_finite<float>(in);
    if (cell.samples < 0) throw InputError("the model of von Mises-Fisher mixtures is damaged");
    cell.groups = load_groups(in);
    add(cell);
  }
  places_.push_back({{}, static_cast<std::uint32_t>(groups_.size())});
}

void ParallaxAwareMixturesModel::add(const Cell& cell) {
  places_.push_back({cell.pivot, static_cast<std::uint32_t>(groups_.size())});
  groups_.insert(groups_.end(), cell.groups.begin(), cell.groups.end());
  samples_.push_back(cell.samples);
}

void ParallaxAwareMixturesModel::save(std::ostream& out) const {
  save_heading(out, kName, kVersion);
  tree_.save(out);
  for (std::uint32_t cell = 0; cell < tree_.cell_count(); ++cell) {
    for (int axis = 0; axis < 3; ++axis) save_number(out, places_[cell].pivot[axis]);
    save_number(out, samples_[cell]);
    save_groups({groups_.data() + places_[cell].first, groups_.data() + places_[cell + 1].first},
                out);
  }
}

std::size_t ParallaxAwareMixturesModel::size_bytes() const {
  return tree_.size_bytes() + groups_.size() * sizeof(LobeGroup) +
         samples_.size() * (sizeof(Place) + sizeof(float) + sizeof(std::uint32_t));
}

std::vector<ModelFact> ParallaxAwareMixturesModel::facts() const {
  const auto known = std::count_if(samples_.begin(), samples_.end(), [](float s) { return s > 0; });
  std::size_t lobes = 0;
  for (const LobeGroup& group : groups_) {
    for (std::size_t i = 0; i < kLanes; ++i) lobes += group.weight[i] > 0 ? 1 : 0;
  }
  return {{"cells", fmt::format("{}, {} levels of planes, {} know something", tree_.cell_count(),
                                tree_.depth(), known)},
          {"lobes", fmt::format("{}", lobes)}};
}

double ParallaxAwareMixturesModel::density(Point3 point) const {
  return samples_[tree_.cell_at(point)];
}

double ParallaxAwareMixturesModel::density(Point3 point, Vec3 direction) const {
  const View view = at(point);
  Arena arena;
  const SeenLobes* seen = SeenLobes::make(view.groups, view.offset, {}, arena);
  return seen == nullptr ? 0 : seen->density(direction);
}

}  // namespace pharos::parallax_aware_mixtures
