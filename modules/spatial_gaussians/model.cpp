#include "model.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <fmt/format.h>

#include <pharos/core/binary_stream.h>
#include <pharos/guiding/toolkit/seen_gaussian.h>

namespace pharos::spatial_gaussians {
namespace {

constexpr const char* kHeading = "spatial_gaussians";
constexpr std::uint32_t kMostComponents = 1u << 26;

void expect(bool holds) {
  if (!holds) throw InputError("the model of spatial Gaussians is damaged");
}

void save_component(const SpatialGaussian& g, std::ostream& out) {
  save_number(out, g.weight);
  for (int axis = 0; axis < 3; ++axis) save_number(out, g.mean[axis]);
  for (const float l : g.cholesky) save_number(out, l);
}

SpatialGaussian load_component(std::istream& in) {
  SpatialGaussian g;
  g.weight = load_finite<float>(in);
  for (int axis = 0; axis < 3; ++axis) g.mean[axis] = load_finite<float>(in);
  for (float& l : g.cholesky) l = load_finite<float>(in);
  // Beyond, factors of densities are no floats.
  constexpr float kMost = 1e12f, kFlattest = 1e-9f;
  const float* l = g.cholesky;
  const float least = std::min({l[0], l[2], l[5]});
  float largest = std::max({l[0], l[2], l[5], length(g.mean)});
  for (const int off : {1, 3, 4}) largest = std::max(largest, std::abs(l[off]));
  expect(g.weight >= 0 && least > 0 && least >= kFlattest * largest && largest <= kMost);
  return g;
}

/// N(point) [1/scene unit^3].
double density_at(const SpatialGaussian& g, Point3 point) {
  const Vec3 offset = point - g.mean;
  const std::array<double, 3> z = whitened(g, {offset.x, offset.y, offset.z});
  const double squared = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
  constexpr double kFar = 100;  // e^-50 is nothing
  if (squared > kFar) return 0;
  return std::exp(-0.5 * squared) / (std::pow(2 * EIGEN_PI, 1.5) * root_determinant(g));
}

}  // namespace

SpatialGaussiansModel::SpatialGaussiansModel(KdTree tree, const std::vector<Cell>& cells,
                                             std::vector<std::uint32_t> origins)
    : tree_(std::move(tree)), first_{0}, origins_(std::move(origins)) {
  for (const Cell& cell : cells) {
    components_.insert(components_.end(), cell.components.begin(), cell.components.end());
    first_.push_back(static_cast<std::uint32_t>(components_.size()));
    samples_.push_back(cell.samples);
  }
}

SpatialGaussiansModel::SpatialGaussiansModel(std::istream& in) {
  expect_heading(in, kHeading, kVersion);
  tree_ = KdTree::load(in);
  first_ = {0};
  for (std::uint32_t cell = 0; cell < tree_.cell_count(); ++cell) {
    samples_.push_back(load_finite<float>(in));
    expect(samples_.back() >= 0);
    const auto count = load_number<std::uint32_t>(in);
    expect(components_.size() + count <= kMostComponents);
    // Directions are drawn as if the weights added up to one.
    constexpr double kRounding = 1e-4;
    double total = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      components_.push_back(load_component(in));
      total += components_.back().weight;
    }
    expect(count == 0 || std::abs(total - 1) <= kRounding);
    first_.push_back(static_cast<std::uint32_t>(components_.size()));
  }
}

void SpatialGaussiansModel::save(std::ostream& out) const {
  save_heading(out, kHeading, kVersion);
  tree_.save(out);
  for (std::uint32_t cell = 0; cell < tree_.cell_count(); ++cell) {
    save_number(out, samples_[cell]);
    save_number(out, first_[cell + 1] - first_[cell]);
    for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k) {
      save_component(components_[k], out);
    }
  }
}

std::size_t SpatialGaussiansModel::size_bytes() const {
  return tree_.size_bytes() + components_.size() * sizeof(SpatialGaussian) +
         samples_.size() * (sizeof(float) + sizeof(std::uint32_t));
}

std::vector<ModelFact> SpatialGaussiansModel::facts() const {
  const auto known = std::count_if(samples_.begin(), samples_.end(), [](float s) { return s > 0; });
  return {{"cells", fmt::format("{}, {} levels of planes, {} know something", tree_.cell_count(),
                                tree_.depth(), known)},
          {"components", fmt::format("{}", components_.size())}};
}

double SpatialGaussiansModel::density(Point3 point) const {
  double total = 0, samples = 0;
  for (std::size_t cell = 0; cell < samples_.size(); ++cell) {
    double density = 0;
    for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k) {
      density += components_[k].weight * density_at(components_[k], point);
    }
    total += samples_[cell] * density;
    samples += samples_[cell];
  }
  return samples > 0 ? total / samples : 0;
}

double SpatialGaussiansModel::density(Point3 point, Vec3 direction) const {
  double density = 0;
  for (const SpatialGaussian& g : mixture_at(point).components) {
    density += g.weight * exact_density(g, point, direction);
  }
  return density;
}

SpatialMixture::View SpatialGaussiansModel::mixture_at(const GuidingQuery& query, Arena&) const {
  return mixture_at(query.current.position);
}

SpatialMixture::View SpatialGaussiansModel::mixture_at(Point3 point) const {
  const std::uint32_t cell = tree_.cell_at(point);
  return {{components_.data() + first_[cell], components_.data() + first_[cell + 1]}, cell};
}

}  // namespace pharos::spatial_gaussians
