#pragma once

#include <string_view>

#include <pharos/core/arena.h>
#include <pharos/core/vec.h>
#include <pharos/guiding/contract/vertex.h>

namespace pharos {

/// The estimates that a model offers.
struct RadianceTraits {
  bool incident = false;  ///< RadianceEstimate::incident_radiance()
  bool outgoing = false;  ///< RadianceEstimate::outgoing_radiance()
  bool around = false;    ///< RadianceEstimate::radiance_around()
};

/// The incident radiance at one vertex, as a function of direction. It lives in an arena.
class RadianceAround {
 public:
  /// Returns the radiance that arrives from `direction`, divided by the mean over all directions
  /// [1].
  virtual float relative(Vec3 direction) const = 0;

 protected:
  ~RadianceAround() = default;  // arenas run no destructors
};

/// Neutral contract of models that estimate radiance. A model that also derives from this class can
/// serve users other than its guiders, such as resampling. It is constant and thread-safe.
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
  /// Returns the incident radiance at the current vertex of a query, including direct light; null
  /// if nothing is known. The answer lives in `arena` and depends on the query alone. Called only
  /// if RadianceTraits::around is true.
  virtual const RadianceAround* radiance_around(const GuidingQuery&, Arena& /*arena*/) const {
    return nullptr;
  }
};

}  // namespace pharos
