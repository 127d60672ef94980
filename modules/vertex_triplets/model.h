#pragma once

#include <span>
#include <vector>

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/contract/spatial_mixture.h>

#include "camera_mixture.h"
#include "conditional_mixtures.h"
#include "octree.h"

namespace pharos::vertex_triplets {

/// The learned data of one cell.
struct CellKnowledge {
  float share = 0;    ///< share of the cell in the total weight
  float samples = 0;  ///< number of samples that the mixtures were fitted to
  // Only the mixtures of the model's prefix are used. The other vector is empty.
  std::vector<ConditionalMixtures<3>::Run> pairs;
  std::vector<ConditionalMixtures<6>::Run> triplets;

  void archive(Archive& archive) {
    archive(share, samples, pairs, triplets);
    archive.expect(share >= 0 && samples >= 0, "the model of vertex triplets");
  }
};

/// The kind of a model: the vertices that its mixtures are over.
struct ModelKind {
  Prefix prefix = Prefix::triplet;
  bool both_ways = false;  ///< the model also guides paths from lights; triplets only
  EnvironmentShell environment;

  void archive(Archive& archive);
};

/// A mixture over vertex triplets, or pairs, in each cell of an octree, and a mixture over first
/// vertices at the camera (Schuessler et al. 2022, sections 3 and 4).
class VertexTripletsModel final : public GuidingModel, public SpatialMixture {
 public:
  static constexpr std::string_view kName = "vertex_triplets";

  VertexTripletsModel() : VertexTripletsModel({}, Octree{Cube{}}, {{}}, {}, 0) {}
  /// `cells` is in the order of the cell numbers in the tree. `sample_bytes` is the memory of the
  /// samples from which the model was learned.
  VertexTripletsModel(const ModelKind& kind, Octree tree, const std::vector<CellKnowledge>& cells,
                      CameraMixture camera, std::uint64_t sample_bytes);

  ModelInfo info() const override;
  void archive(Archive& archive) override;
  /// The regions are the cells, and the last one is the camera: vertices on the lens, where first
  /// vertices are sampled.
  Place place(const GuidingVertex& vertex) const override;
  double density(Point3 point, const Vec3* direction) const override;
  std::span<const SpatialGaussian> mixture_at(const GuidingQuery& query,
                                              Arena& arena) const override;

  /// Returns the mixture over the next vertex, for events among `events`, allocated in `arena`. It
  /// is empty if nothing is known. `most_deviations`: see PathPrefix.
  std::span<const NextGroup> next_vertices(const GuidingQuery& query, EventMask events,
                                           Arena& arena, float most_deviations = kTruncation) const;
  const CameraMixture& camera() const { return camera_; }
  /// Returns the learned data of a cell.
  CellKnowledge knowledge(std::uint32_t cell) const;
  const ModelKind& kind() const { return kind_; }
  std::size_t component_count() const {
    return pairs_.component_count() + triplets_.component_count();
  }
  /// Returns the length of the edge of a cell [scene units].
  float cell_size(std::uint32_t cell) const { return tree_.cube(cell).size; }

 private:
  /// Calls `visit(share, mean, covariance)` for the components of a cell, reduced to the pair (x_2,
  /// x_3) on paths from the sensor without x_1. Used for pictures. Means are relative to the center
  /// of the cell [scene units].
  template <class Visit>
  void for_each_pair(std::uint32_t cell, Visit&& visit) const;

  double density_of_points(Point3 point) const;
  double density_of_directions(Point3 point, Vec3 direction) const;
  std::size_t size_bytes() const;

  ModelKind kind_;
  Octree tree_;
  std::vector<float> shares_;   ///< share of each cell in the total weight
  std::vector<float> samples_;  ///< number of samples behind the mixtures of each cell
  float all_samples_ = 0;       ///< sum of `samples_`
  ConditionalMixtures<3> pairs_{ConditionalMixtures<3>::Direction::from_sensor};
  ConditionalMixtures<6> triplets_{ConditionalMixtures<6>::Direction::from_sensor};
  ConditionalMixtures<6> reversed_{ConditionalMixtures<6>::Direction::from_lights};
  CameraMixture camera_;
  std::uint64_t sample_bytes_ = 0;
};

}  // namespace pharos::vertex_triplets
