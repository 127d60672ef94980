#pragma once

#include <span>
#include <vector>

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/contract/spatial_mixture.h>

#include "camera_mixture.h"
#include "conditional_mixtures.h"
#include "octree.h"

namespace pharos::vertex_triplets {

/// What is learned in one cell.
struct CellKnowledge {
  float share = 0;  ///< of all weight
  // Of one prefix; the other is empty.
  std::vector<ConditionalMixtures<3>::Run> pairs;
  std::vector<ConditionalMixtures<6>::Run> triplets;

  void archive(Archive& archive) {
    archive(share, pairs, triplets);
    archive.expect(share >= 0, "the model of vertex triplets");
  }
};

/// Which vertices a model is about.
struct ModelKind {
  Prefix prefix = Prefix::triplet;
  bool both_ways = false;  ///< paths from lights are guided too; triplets only
  EnvironmentShell environment;

  void archive(Archive& archive);
};

/// A mixture of vertex triplets, or pairs, in each cell of an octree, and one of first vertices at
/// the camera (Schuessler et al. 2022, sections 3 and 4).
class VertexTripletsModel final : public GuidingModel, public SpatialMixture {
 public:
  static constexpr std::string_view kName = "vertex_triplets";

  VertexTripletsModel() : VertexTripletsModel({}, Octree{Cube{}}, {{}}, {}, 0) {}
  /// `cells` are in the order of their numbers in the tree. `sample_bytes` is the memory of the
  /// samples that the model was learned from.
  VertexTripletsModel(const ModelKind& kind, Octree tree, const std::vector<CellKnowledge>& cells,
                      CameraMixture camera, std::uint64_t sample_bytes);

  ModelInfo info() const override;
  void archive(Archive& archive) override;
  /// Regions are the cells; first vertices, on the lens, belong to region 0.
  Place place(const GuidingVertex& vertex) const override;
  double density(Point3 point, const Vec3* direction) const override;
  std::span<const SpatialGaussian> mixture_at(const GuidingQuery& query,
                                              Arena& arena) const override;

  /// Where paths go on to from a vertex, for events among `events`. Empty: nothing is known.
  std::span<const NextVertex> next_vertices(const GuidingQuery& query, EventMask events,
                                            Arena& arena) const;
  const CameraMixture& camera() const { return camera_; }
  const ModelKind& kind() const { return kind_; }
  std::size_t component_count() const {
    return pairs_.component_count() + triplets_.component_count();
  }
  /// Edge of a cell [scene units].
  float cell_size(std::uint32_t cell) const { return tree_.cube(cell).size; }

 private:
  /// Where paths from the sensor go on to from a vertex in its cell, for pictures: components of
  /// (x_2, x_3), x_1 left out. `visit(share, mean, covariance)`, in scene units about the cell.
  template <class Visit>
  void for_each_pair(std::uint32_t cell, Visit&& visit) const;

  double density_of_points(Point3 point) const;
  double density_of_directions(Point3 point, Vec3 direction) const;
  std::size_t size_bytes() const;

  ModelKind kind_;
  Octree tree_;
  std::vector<float> shares_;  ///< of cells
  ConditionalMixtures<3> pairs_{ConditionalMixtures<3>::Direction::from_sensor};
  ConditionalMixtures<6> triplets_{ConditionalMixtures<6>::Direction::from_sensor};
  ConditionalMixtures<6> reversed_{ConditionalMixtures<6>::Direction::from_lights};
  CameraMixture camera_;
  std::uint64_t sample_bytes_ = 0;
};

}  // namespace pharos::vertex_triplets
