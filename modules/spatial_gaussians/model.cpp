#include "model.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <fmt/format.h>

#include <pharos/core/warp.h>
#include <pharos/guiding/toolkit/seen_gaussian.h>

#include "seen_mixture.h"

namespace pharos::spatial_gaussians {
namespace {

constexpr std::size_t kMostComponents = 1u << 26;

class MixtureRadiance final : public RadianceAround {
 public:
  explicit MixtureRadiance(const SeenMixture& mixture) : mixture_(mixture) {}
  float relative(Vec3 direction) const override {
    return mixture_.density(direction) / warp::sphere_pdf();
  }

 private:
  const SeenMixture& mixture_;
};

bool is_sound(const SpatialGaussian& g) {
  // Beyond these bounds, factors of densities overflow floats.
  constexpr float kMost = 1e12f, kFlattest = 1e-9f;
  const float* l = g.cholesky;
  const float least = std::min({l[0], l[2], l[5]});
  float largest = std::max({l[0], l[2], l[5], length(g.mean)});
  for (const int off : {1, 3, 4}) largest = std::max(largest, std::abs(l[off]));
  return g.weight >= 0 && least > 0 && least >= kFlattest * largest && largest <= kMost;
}

/// Returns whether the components are sound and their weights add up to one, as sampling assumes.
bool is_sound(const std::vector<SpatialGaussian>& mixture) {
  constexpr double kRounding = 1e-4;
  double total = 0;
  for (const SpatialGaussian& g : mixture) {
    if (!is_sound(g)) return false;
    total += g.weight;
  }
  return mixture.empty() || std::abs(total - 1) <= kRounding;
}

/// Returns the density of a Gaussian at a point [1/scene unit^3].
double density_at(const SpatialGaussian& g, Point3 point) {
  const Vec3 offset = point - g.mean;
  const std::array<double, 3> z = whitened(g, {offset.x, offset.y, offset.z});
  const double squared = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
  constexpr double kFar = 100;  // e^-50 is negligible
  if (squared > kFar) return 0;
  return std::exp(-0.5 * squared) / (std::pow(2 * EIGEN_PI, 1.5) * root_determinant(g));
}

}  // namespace

SpatialGaussiansModel::SpatialGaussiansModel(KdTree tree, const std::vector<Cell>& cells)
    : tree_(std::move(tree)), first_{0}, first_whitened_{0} {
  samples_.clear();
  for (const Cell& cell : cells) add(cell);
}

void SpatialGaussiansModel::add(const Cell& cell) {
  components_.insert(components_.end(), cell.components.begin(), cell.components.end());
  first_.push_back(static_cast<std::uint32_t>(components_.size()));
  for (std::size_t i = 0; i < cell.components.size(); i += WhitenedGroup::kLanes) {
    whitened_.emplace_back(std::span(cell.components).subspan(i));
  }
  first_whitened_.push_back(static_cast<std::uint32_t>(whitened_.size()));
  samples_.push_back(cell.samples);
}

void SpatialGaussiansModel::archive(Archive& archive) {
  archive(tree_);
  if (archive.loads()) *this = SpatialGaussiansModel(std::move(tree_), {});
  for (std::uint32_t i = 0; i < tree_.cell_count(); ++i) {
    Cell cell;
    if (!archive.loads()) {
      const std::span<const SpatialGaussian> own = mixture(i);
      cell = {{own.begin(), own.end()}, samples_[i]};
    }
    archive(cell);
    archive.expect(cell.samples >= 0 && is_sound(cell.components) &&
                       components_.size() + cell.components.size() <= kMostComponents,
                   "the model of spatial Gaussians");
    if (archive.loads()) add(cell);
  }
}

ModelInfo SpatialGaussiansModel::info() const {
  const auto known = std::count_if(samples_.begin(), samples_.end(), [](float s) { return s > 0; });
  return {.name = std::string(kName),
          .version = 2,
          .bytes = tree_.size_bytes() + components_.size() * sizeof(SpatialGaussian) +
                   whitened_.size() * sizeof(WhitenedGroup) +
                   samples_.size() * (sizeof(float) + 2 * sizeof(std::uint32_t)),
          .regions = tree_.cell_count(),
          .facts = {{"cells", fmt::format("{}, {} levels of planes, {} know something",
                                          tree_.cell_count(), tree_.depth(), known)},
                    {"components", fmt::format("{}", components_.size())}}};
}

double SpatialGaussiansModel::density(Point3 point, const Vec3* direction) const {
  if (direction != nullptr) {
    double density = 0;
    for (const SpatialGaussian& g : mixture_at(point)) {
      density += g.weight * exact_density(g, point, *direction);
    }
    return density;
  }
  double total = 0, samples = 0;
  for (std::uint32_t cell = 0; cell < samples_.size(); ++cell) {
    double density = 0;
    for (const SpatialGaussian& g : mixture(cell)) density += g.weight * density_at(g, point);
    total += samples_[cell] * density;
    samples += samples_[cell];
  }
  return samples > 0 ? total / samples : 0;
}

// The Gaussians are fitted to samples that are weighted by radiance over density, without the BSDF.
const RadianceAround* SpatialGaussiansModel::radiance_around(const GuidingQuery& query,
                                                             Arena& arena) const {
  const std::span<const SpatialGaussian> components = mixture(query.region);
  if (components.empty()) return nullptr;
  const SeenMixture* seen = SeenMixture::make(components, query.current.position, {},
                                              Technique::exact, arena, whitened_at(query));
  return seen == nullptr ? nullptr : arena.make<MixtureRadiance>(*seen);
}

}  // namespace pharos::spatial_gaussians
