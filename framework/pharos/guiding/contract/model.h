#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include <pharos/core/bounds.h>

namespace pharos {

/// One line about a model, such as {"leaves", "1,234"}.
struct ModelFact {
  std::string name, value;
};

/// What a learner has learned: immutable, thread-safe. A new one is made for each iteration.
class GuidingModel {
 public:
  virtual ~GuidingModel() = default;

  /// Name of the kind of model, and the version of its saved form.
  virtual std::string name() const = 0;
  virtual std::uint32_t version() const = 0;
  /// Memory in use [bytes].
  virtual std::size_t size_bytes() const = 0;
  /// Writes what Learner::load_model() reads back to an equal model.
  virtual void save(std::ostream& out) const = 0;

  /// Number of regions that distributions may name; learned mixing keeps one state for each.
  virtual std::uint32_t region_count() const { return 1; }
  /// For each region the region of the previous iteration's model that it came from. Empty: the
  /// regions are the same as before.
  virtual std::vector<std::uint32_t> region_origins() const { return {}; }

  /// Where density(point) may be positive [scene units]; empty: not limited.
  virtual Bounds3 bounds() const { return {}; }
  /// What a reader of its pictures wants to know: depth, leaves, components.
  virtual std::vector<ModelFact> facts() const { return {}; }

  /// How much the model expects around a point, up to a constant factor; for pictures.
  virtual double density(Point3 point) const = 0;
  /// How much it expects from `direction` at a point, up to a constant factor; for pictures.
  virtual double density(Point3 point, Vec3 direction) const = 0;
};

}  // namespace pharos
