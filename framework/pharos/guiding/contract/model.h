#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/bounds.h>
#include <pharos/guiding/contract/vertex.h>

namespace pharos {

/// One line about a model, such as {"leaves", "1,234"}.
struct ModelFact {
  std::string name, value;
};

/// The facts that programs need to display and handle a model.
struct ModelInfo {
  std::string name;           ///< name of the kind of model
  std::uint32_t version = 1;  ///< version of the saved form; raise it when archive() changes
  std::size_t bytes = 0;      ///< memory in use
  std::uint32_t regions = 1;  ///< number of regions that place() may return
  Bounds3 bounds = {};        ///< bounds of points with positive density(); empty: no limit
  std::vector<ModelFact> facts = {};  ///< depth, leaves, components and the like
};

/// What a model knows of a vertex before any guide is asked there. Mixing policies base their
/// decision on it.
struct Place {
  std::uint32_t region = 0;  ///< the part of the model that answers here, below ModelInfo::regions
  float evidence = 1;        ///< training samples behind the answer [1]; 0: nothing is known here
};

/// The result of learning: immutable and thread-safe once it is in use. Each training iteration
/// makes a new model. Several guiders may sample one model, and a model may also implement neutral
/// contracts (SpatialMixture, RadianceEstimate).
class GuidingModel {
 public:
  virtual ~GuidingModel() = default;

  virtual ModelInfo info() const = 0;

  /// Saves the model, or loads it into the model that Learner::empty_model() returned.
  virtual void archive(Archive& archive) = 0;

  /// Returns what the model knows of a vertex. The function is called once for each vertex of every
  /// path, so it allocates nothing on the heap and takes no lock.
  virtual Place place(const GuidingVertex&) const { return {}; }

  /// Returns the density that the model has learned around a point, or for `direction` at the point
  /// if `direction` is not null. The density is known up to a constant factor and is used for
  /// visualizations.
  virtual double density(Point3 point, const Vec3* direction = nullptr) const = 0;
};

}  // namespace pharos
