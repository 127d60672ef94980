#include "model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pharos/core/binary_stream.h>
#include <pharos/guiding/toolkit/seen_gaussian.h>

#include "sample.h"

namespace pharos::vertex_triplets {
namespace {

void expect(bool holds) {
  if (!holds) throw InputError("the model of vertex triplets is damaged");
}

template <int P>
void save_runs(const std::vector<typename ConditionalMixtures<P>::Run>& runs, std::ostream& out) {
  save_number(out, static_cast<std::uint32_t>(runs.size()));
  for (const auto& run : runs) {
    save_mode(run.mode, out);
    save_number(out, static_cast<std::uint32_t>(run.components.size()));
    for (const Component<P>& component : run.components) component.save(out);
  }
}

template <int P>
std::vector<typename ConditionalMixtures<P>::Run> load_runs(std::istream& in) {
  std::vector<typename ConditionalMixtures<P>::Run> runs;
  for (auto count = load_number<std::uint32_t>(in); count > 0; --count) {
    auto& run = runs.emplace_back();
    run.mode = load_mode(in);
    for (auto left = load_number<std::uint32_t>(in); left > 0; --left) {
      run.components.push_back(Component<P>::load(in));
    }
    expect(!run.components.empty());
  }
  return runs;
}

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
                                         CameraMixture camera, std::vector<std::uint32_t> origins,
                                         std::uint64_t sample_bytes)
    : kind_(kind),
      tree_(std::move(tree)),
      camera_(std::move(camera)),
      origins_(std::move(origins)),
      sample_bytes_(sample_bytes) {
  for (std::uint32_t i = 0; i < tree_.cell_count(); ++i) {
    const Point3 center = tree_.cube(i).center;
    shares_.push_back(cells[i].share);
    pairs_.add_cell(center, cells[i].pairs);
    triplets_.add_cell(center, cells[i].triplets);
    if (kind_.both_ways) reversed_.add_cell(center, reversed_runs(cells[i].triplets));
  }
}

VertexTripletsModel::VertexTripletsModel(std::istream& in) {
  expect_heading(in, kName, kVersion);
  const auto pairs = load_number<std::uint8_t>(in), both_ways = load_number<std::uint8_t>(in);
  expect(pairs <= 1 && both_ways <= 1 && pairs + both_ways <= 1);
  const ModelKind kind{.prefix = pairs != 0 ? Prefix::pair : Prefix::triplet,
                       .both_ways = both_ways != 0,
                       .environment = {load_finite<float>(in)}};
  expect(kind.environment.radius > 0);
  const auto sample_bytes = load_number<std::uint64_t>(in);
  Octree tree = Octree::load(in);
  std::vector<CellKnowledge> cells(tree.cell_count());
  for (CellKnowledge& cell : cells) {
    cell.share = load_finite<float>(in);
    expect(cell.share >= 0);
    if (pairs != 0) {
      cell.pairs = load_runs<3>(in);
    } else {
      cell.triplets = load_runs<6>(in);
    }
  }
  CameraMixture camera = CameraMixture::load(in);
  *this = VertexTripletsModel(kind, std::move(tree), cells, std::move(camera), {}, sample_bytes);
}

void VertexTripletsModel::save(std::ostream& out) const {
  save_heading(out, kName, kVersion);
  const bool pairs = kind_.prefix == Prefix::pair;
  save_number(out, static_cast<std::uint8_t>(pairs));
  save_number(out, static_cast<std::uint8_t>(kind_.both_ways));
  save_number(out, kind_.environment.radius);
  save_number(out, sample_bytes_);
  tree_.save(out);
  for (std::uint32_t cell = 0; cell < tree_.cell_count(); ++cell) {
    save_number(out, shares_[cell]);
    if (pairs) {
      save_runs<3>(pairs_.runs(cell), out);
    } else {
      save_runs<6>(triplets_.runs(cell), out);
    }
  }
  camera_.save(out);
}

std::size_t VertexTripletsModel::size_bytes() const {
  return tree_.size_bytes() + pairs_.size_bytes() + triplets_.size_bytes() +
         reversed_.size_bytes() + camera_.size_bytes() +
         shares_.size() * (sizeof(float) + sizeof(std::uint32_t));
}

std::vector<ModelFact> VertexTripletsModel::facts() const {
  return {{"vertices", kind_.prefix == Prefix::pair ? "pairs"
                       : kind_.both_ways            ? "triplets, both ways"
                                                    : "triplets"},
          {"cells", fmt::format("{}, {} levels", tree_.cell_count(), tree_.depth())},
          {"components", fmt::format("{}, {} at the camera", component_count(), camera_.size())},
          {"guiding", mebibytes(static_cast<double>(size_bytes()))},
          {"samples", mebibytes(static_cast<double>(sample_bytes_))}};
}

std::span<const NextVertex> VertexTripletsModel::next_vertices(const GuidingQuery& query,
                                                               EventMask events,
                                                               Arena& arena) const {
  const bool from_lights = query.transport == Transport::importance;
  if (query.previous == nullptr || (from_lights && !kind_.both_ways)) return {};
  const Point3 current = query.current.position;
  const bool from_environment = query.previous->kind == VertexKind::environment;
  const PathPrefix prefix{.previous = from_environment
                                          ? kind_.environment.at(current, query.towards_previous)
                                          : query.previous->position,
                          .current = current,
                          .previous_kind = query.previous->kind,
                          .events = events};
  const std::uint32_t cell = tree_.cell_at(current);
  if (kind_.prefix == Prefix::pair) return pairs_.given(cell, prefix, arena);
  return (from_lights ? reversed_ : triplets_).given(cell, prefix, arena);
}

SpatialMixture::View VertexTripletsModel::mixture_at(const GuidingQuery& query,
                                                     Arena& arena) const {
  const std::span<const NextVertex> next =
      next_vertices(query, query.scattering.events() & EventMask::smooth, arena);
  SpatialGaussian* components = arena.make_array<SpatialGaussian>(next.size());
  for (std::size_t i = 0; i < next.size(); ++i) components[i] = next[i].gaussian;
  return {{components, next.size()}, region_at(query.current.position)};
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

double VertexTripletsModel::density(Point3 point) const {
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

double VertexTripletsModel::density(Point3 point, Vec3 direction) const {
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
