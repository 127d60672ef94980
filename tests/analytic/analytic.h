#pragma once

#include <string>
#include <vector>

#include <pharos/core/transform.h>

#include "renders.h"

/// Renders of constant images whose value is known in closed form. A test is the mean of all pixels
/// over kRuns seeds, held against the value by Student's t.
namespace pharos::testing {

inline constexpr int kRuns = 16;
/// Beyond this, |t| of 15 degrees of freedom lies by chance once in 6000 tests.
inline constexpr double kLimit = 5;
/// A true bias of this share of the value is found with a probability of 90 %.
inline constexpr double kDetectableBias = 0.005;

/// Renders `config` with as many samples per pixel as it takes to tell a bias of kDetectableBias,
/// four times more at each attempt, and checks the mean over the seeds against `expected`, and that
/// it refuses values that are 1 % off to either side. `config` must state neither seed nor budget.
void check_value(const std::string& config, double expected);

/// A sampler without and one with structure. (That others show the same image: tests/samplers.)
inline constexpr const char* kSamplers[] = {"independent", "sobol"};

inline const std::string kFilm = "film: { width: 8, height: 8, filter: box }\n";

/// How light is found: by all means under either heuristic, or by the BSDF alone.
struct Strategy {
  std::string name;
  std::string settings;  ///< of the path integrator
};
inline const std::vector<Strategy> kStrategies{{"balance", "mis: balance"},
                                               {"power", "mis: power"},
                                               {"light samples", "mis: light_samples"},
                                               {"bsdf", "next_event_estimation: false"}};

/// The strategies that find lights without extent.
inline const std::vector<Strategy> kLightSampling{{"one", "light_selection: one"},
                                                  {"all", "light_selection: all"}};

/// The irradiance at the origin, of normal +z, of a polygon of radiance 1 above the horizon, a
/// transformed square of corners (+-1, +-1, 0): Lambert 1760; half the sum over edges of the angle
/// that they span times the cosine between the receiver's normal and the normal of the plane of
/// that angle.
double polygon_irradiance(const Transform& quad);

/// A floor seen from close by in a spot of half a millimeter about the origin, with +z as its
/// normal and a reflectance of 0.5.
class Floor {
 public:
  static constexpr double kReflectance = 0.5;

  /// `shapes` and `emitters` are items of the scene's lists, each on a line with its dash.
  Floor(std::string shapes, std::string emitters)
      : shapes_(std::move(shapes)), emitters_(std::move(emitters)) {}

  /// The origin's irradiance [W/m^2] must be `expected` by every strategy and sampler.
  void check_irradiance(double expected, const std::vector<Strategy>& strategies) const;

 private:
  std::string shapes_, emitters_;
};

}  // namespace pharos::testing
