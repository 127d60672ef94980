#pragma once

#include <cstdint>

#include "pgl_field.h"

namespace pharos::open_pgl {

/// A query to the library at a vertex.
struct Query {
  Point3 position;
  bool in_volume = false;
  Vec3 cosine_about;  ///< unit normal of the cosine in the product; zero: no product

  bool operator==(const Query&) const = default;
};

/// The library's query objects of one thread. They are large and live on the heap, so there is only
/// one of each kind. It answers the last query that was taken.
class Workplace {
 public:
  explicit Workplace(const openpgl::cpp::Field& field)
      : field_(field), surface_(&field), volume_(&field) {}
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  /// Makes the distribution of a query, unless it was the last one taken. Returns false if the
  /// field has no data there.
  bool take(const Query& query);
  /// Samples a direction for the last query taken; pdf() returns its density [1/sr].
  Vec3 sample(Vec2 u) const;
  float pdf(Vec3 direction) const;

 private:
  const openpgl::cpp::Field& field_;
  openpgl::cpp::SurfaceSamplingDistribution surface_;
  openpgl::cpp::VolumeSamplingDistribution volume_;
  Query taken_;
  bool holds_ = false;  ///< whether the objects hold the distribution of `taken_`
};

}  // namespace pharos::open_pgl
