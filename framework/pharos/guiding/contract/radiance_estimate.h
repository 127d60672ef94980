#pragma once

#include <string_view>

#include <pharos/core/vec.h>

namespace pharos {

/// The estimates that a model offers.
struct RadianceTraits {
  bool incident = false, outgoing = false;
};

/// Neutral contract of models that estimate radiance. A model that also derives from this class can
/// serve users other than guiders, such as Russian roulette. It is constant and thread-safe.
/// Estimates are means over the color channels, in the unit of the scene's emitters [W/(m^2 sr)],
/// and may be inaccurate.
class RadianceEstimate {
 public:
  static constexpr std::string_view kName = "radiance_estimate";

  virtual ~RadianceEstimate() = default;
  virtual RadianceTraits radiance_traits() const = 0;
  /// Returns the radiance that arrives at a point from `direction`, including direct light; 0 if
  /// nothing is known. Called only if RadianceTraits::incident is true.
  virtual float incident_radiance(Point3, Vec3 /*direction*/) const { return 0; }
  /// Returns the radiance that leaves a surface point towards `direction`, without the emission of
  /// the surface; 0 if nothing is known. Called only if RadianceTraits::outgoing is true.
  virtual float outgoing_radiance(Point3, Vec3 /*normal*/, Vec3 /*direction*/) const { return 0; }
};

}  // namespace pharos
