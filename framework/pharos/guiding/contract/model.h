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

/// What programs show of a model and need to handle it.
struct ModelInfo {
  std::string name;                   ///< of the kind of model
  std::uint32_t version = 1;          ///< of its saved form: raise it when archive() changes
  std::size_t bytes = 0;              ///< memory in use
  std::uint32_t regions = 1;          ///< number of regions that place() may return
  Bounds3 bounds = {};                ///< where density(point) may be positive; empty: not limited
  std::vector<ModelFact> facts = {};  ///< depth, leaves, components and the like
};

/// What a model knows of a vertex before any guide is asked there. Mixing policies decide by it.
struct Place {
  std::uint32_t region = 0;  ///< the part of the model that answers here, below ModelInfo::regions
  float evidence = 1;        ///< training samples behind the answer [1]; 0: nothing is known here
};

/// What a learner has learned: immutable and thread-safe once it is in use. Each training iteration
/// makes a new model. Several guiders may sample one model, and a model may also meet neutral
/// contracts (SpatialMixture, RadianceEstimate).
class GuidingModel {
 public:
  virtual ~GuidingModel() = default;

  virtual ModelInfo info() const = 0;

  /// Saves the model, or loads it into the model that Learner::empty_model() returned.
  virtual void archive(Archive& archive) = 0;

  /// Returns what the model knows of a vertex. Called once for each vertex of every path: no heap,
  /// no lock.
  virtual Place place(const GuidingVertex&) const { return {}; }

  /// Returns how much the model expects around a point, or from `direction` at a point if it is not
  /// null, up to a constant factor. Used for pictures.
  virtual double density(Point3 point, const Vec3* direction = nullptr) const = 0;
};

}  // namespace pharos
