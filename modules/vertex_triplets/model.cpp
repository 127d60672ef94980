#include "model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pharos/guiding/toolkit/seen_gaussian.h>

namespace pharos::vertex_triplets {
namespace {

std::vector<ConditionalMixtures<6>::Run> reversed_runs(
    std::vector<ConditionalMixtures<6>::Run> runs) {
  for (auto& run : runs) {
    for (Component<6>& component : run.components) component = reversed(component);
    std::erase_if(run.components, [](const Component<6>& c) { return !c.is_sound(); });
  }
  return runs;
}

std::string mebibytes(double bytes) {
  return fmt::format("{:.2f} MiB", bytes / (1 << 20));
}

}  // namespace

VertexTripletsModel::VertexTripletsModel(const ModelKind& kind, Octree tree,
                                         const std::vector<CellKnowledge>& cells,
                                         CameraMixture camera, std::uint64_t sample_bytes)
    : kind_(kind), tree_(std::move(tree)), camera_(std::move(camera)), sample_bytes_(sample_bytes) {
  for (std::uint32_t i = 0; i < tree_.cell_count(); ++i) {
    const Point3 center = tree_.cube(i).center;
    shares_.push_back(cells[i].share);
    samples_.push_back(cells[i].samples);
    all_samples_ += cells[i].samples;
    pairs_.add_cell(center, cells[i].pairs);
    triplets_.add_cell(center, cells[i].triplets);
    if (kind_.both_ways) reversed_.add_cell(center, reversed_runs(cells[i].triplets));
  }
}

void ModelKind::archive(Archive& archive) {
  archive(prefix, both_ways, environment.radius);
  archive.expect((prefix == Prefix::triplet || (prefix == Prefix::pair && !both_ways)) &&
                     environment.radius > 0,
                 "the model of vertex triplets");
}

void VertexTripletsModel::archive(Archive& archive) {
  std::vector<CellKnowledge> cells;
  for (std::uint32_t i = 0; !archive.loads() && i < tree_.cell_count(); ++i) {
    cells.push_back(knowledge(i));
  }
  archive(kind_, sample_bytes_, tree_, cells, camera_);
  if (!archive.loads()) return;
  bool is_sound = cells.size() == tree_.cell_count();
  for (const CellKnowledge& cell : cells) {
    is_sound &= kind_.prefix == Prefix::pair ? cell.triplets.empty() : cell.pairs.empty();
  }
  archive.expect(is_sound, "the model of vertex triplets");
  *this = VertexTripletsModel(kind_, std::move(tree_), cells, std::move(camera_), sample_bytes_);
}

CellKnowledge VertexTripletsModel::knowledge(std::uint32_t cell) const {
  return {shares_[cell], samples_[cell], pairs_.runs(cell), triplets_.runs(cell)};
}

Place VertexTripletsModel::place(const GuidingVertex& vertex) const {
  if (vertex.kind == VertexKind::sensor) {
    return {tree_.cell_count(), camera_.empty() ? 0.0f : std::max(all_samples_, 1.0f)};
  }
  const std::uint32_t cell = tree_.cell_at(vertex.position);
  const bool is_known = pairs_.knows_something(cell) || triplets_.knows_something(cell);
  return {cell, is_known ? std::max(samples_[cell], 1.0f) : 0.0f};
}

std::size_t VertexTripletsModel::size_bytes() const {
  return tree_.size_bytes() + pairs_.size_bytes() + triplets_.size_bytes() +
         reversed_.size_bytes() + camera_.size_bytes() +
         shares_.size() * (2 * sizeof(float) + sizeof(std::uint32_t));
}

ModelInfo VertexTripletsModel::info() const {
  const std::size_t bytes = size_bytes();
  return {.name = std::string(kName),
          .version = 4,
          .bytes = bytes,
          .regions = tree_.cell_count() + 1,
          .facts = {{"vertices", kind_.prefix == Prefix::pair ? "pairs"
                                 : kind_.both_ways            ? "triplets, both ways"
                                                              : "triplets"},
                    {"cells", fmt::format("{}, {} levels", tree_.cell_count(), tree_.depth())},
                    {"components",
                     fmt::format("{}, {} at the camera", component_count(), camera_.size())},
                    {"guiding", mebibytes(static_cast<double>(bytes))},
                    {"samples", mebibytes(static_cast<double>(sample_bytes_))}}};
}

double VertexTripletsModel::density(Point3 point, const Vec3* direction) const {
  return direction == nullptr ? density_of_points(point) : density_of_directions(point, *direction);
}

std::span<const NextGroup> VertexTripletsModel::next_vertices(const GuidingQuery& query,
                                                              EventMask events, Arena& arena,
                                                              float most_deviations) const {
  const bool from_lights = query.transport == Transport::importance;
  if (query.previous == nullptr || (from_lights && !kind_.both_ways)) return {};
  const Point3 current = query.current.position;
  const bool from_environment = query.previous->kind == VertexKind::environment;
  const PathPrefix prefix{.previous = from_environment
                                          ? kind_.environment.at(current, query.towards_previous)
                                          : query.previous->position,
                          .current = current,
                          .previous_kind = query.previous->kind,
                          .events = events,
                          .most_deviations = most_deviations};
  const std::uint32_t cell = query.region;
  if (kind_.prefix == Prefix::pair) return pairs_.given(cell, prefix, arena);
  return (from_lights ? reversed_ : triplets_).given(cell, prefix, arena);
}

std::span<const SpatialGaussian> VertexTripletsModel::mixture_at(const GuidingQuery& query,
                                                                 Arena& arena) const {
  const std::span<const NextGroup> next =
      next_vertices(query, query.scattering->events() & EventMask::smooth, arena);
  SpatialGaussian* components = arena.make_array<SpatialGaussian>(NextGroup::kLanes * next.size());
  std::size_t count = 0;
  for (const NextGroup& group : next) {
    for (unsigned lane = 0; lane < NextGroup::kLanes; ++lane) {
      if (group.share[lane] > 0) components[count++] = group.gaussian(lane);
    }
  }
  return {components, count};
}

template <class Visit>
void VertexTripletsModel::for_each_pair(std::uint32_t cell, Visit&& visit) const {
  const auto show = [&](const auto& runs) {
    for (const auto& run : runs) {
      for (const auto& component : run.components) {
        constexpr int kFirst = std::decay_t<decltype(component)>::kSize - 6;
        const auto l = component.cholesky();
        const statistics::Matrix<6> covariance =
            l.template bottomRows<6>() * l.template bottomRows<6>().transpose();
        statistics::Vector<6> mean;
        for (int i = 0; i < 6; ++i) mean[i] = component.mean[kFirst + i];
        visit(double{component.weight}, mean, covariance);
      }
    }
  };
  show(pairs_.runs(cell));
  show(triplets_.runs(cell));
}

double VertexTripletsModel::density_of_points(Point3 point) const {
  const std::uint32_t cell = tree_.cell_at(point);
  const Vec3 offset = point - tree_.cube(cell).center;
  const statistics::Vector<3> x(offset.x, offset.y, offset.z);
  double total = 0;
  for_each_pair(cell, [&](double share, const auto& mean, const auto& covariance) {
    const Eigen::LLT<statistics::Matrix<3>> factor(covariance.template topLeftCorner<3, 3>());
    const statistics::Vector<3> z = factor.matrixL().solve(x - mean.template head<3>());
    const double volume = statistics::Matrix<3>(factor.matrixL()).diagonal().prod();
    total += share * std::exp(-0.5 * z.squaredNorm()) / (std::pow(2 * EIGEN_PI, 1.5) * volume);
  });
  return shares_[cell] * total;
}

double VertexTripletsModel::density_of_directions(Point3 point, Vec3 direction) const {
  const std::uint32_t cell = tree_.cell_at(point);
  const Point3 center = tree_.cube(cell).center;
  const Vec3 offset = point - center;
  const statistics::Vector<3> x(offset.x, offset.y, offset.z);
  double total = 0, weights = 0;
  for_each_pair(cell, [&](double share, const auto& mean, const auto& covariance) {
    const Eigen::LLT<statistics::Matrix<6>> factor(covariance);
    const statistics::Matrix<6> l = factor.matrixL();
    const statistics::Vector<3> z =
        l.template topLeftCorner<3, 3>().template triangularView<Eigen::Lower>().solve(
            x - mean.template head<3>());
    const double weight = share * std::exp(-0.5 * z.squaredNorm()) / (l(0, 0) * l(1, 1) * l(2, 2));
    const statistics::Vector<3> next =
        mean.template tail<3>() + l.template bottomLeftCorner<3, 3>() * z;
    SpatialGaussian g;
    for (int row = 0, i = 0; row < 3; ++row) {
      g.mean[row] = center[row] + static_cast<float>(next[row]);
      for (int column = 0; column <= row; ++column) {
        g.cholesky[i++] = static_cast<float>(l(3 + row, 3 + column));
      }
    }
    weights += weight;
    total += weight * exact_density(g, point, direction);
  });
  return weights > 0 ? total / weights : 0;
}

}  // namespace pharos::vertex_triplets
