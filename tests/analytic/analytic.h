#pragma once

#include <string>
#include <vector>

#include <pharos/core/transform.h>

#include "renders.h"

/// Tests of renders with constant images whose value is known in closed form. The mean of all
/// pixels over kRuns seeds is compared with this value by Student's t-test.
namespace pharos::testing {

inline constexpr int kRuns = 16;
/// Limit of |t| with 15 degrees of freedom. By chance, |t| exceeds it once in 6000 tests.
inline constexpr double kLimit = 5;
/// A bias of this share of the value is found with a probability of 90 %.
inline constexpr double kDetectableBias = 0.005;

/// Renders `config` and checks the mean over the seeds against `expected`. Also checks that the
/// test rejects values that are 1 % off to either side. The number of samples per pixel starts
/// small and is multiplied by four until a bias of kDetectableBias can be detected. `config` must
/// state neither seed nor budget.
void check_value(const std::string& config, double expected);

/// One sampler without and one with structure. tests/samplers checks that the other samplers show
/// the same image.
inline constexpr const char* kSamplers[] = {"independent", "sobol"};

inline const std::string kFilm = "film: { width: 8, height: 8, filter: box }\n";

/// A way to find light: light samples and BSDF samples combined by a heuristic, light samples
/// alone, or BSDF samples alone.
struct Strategy {
  std::string name;
  std::string settings;  ///< settings of the path integrator
};
inline const std::vector<Strategy> kStrategies{{"balance", "mis: balance"},
                                               {"power", "mis: power"},
                                               {"light samples", "mis: light_samples"},
                                               {"bsdf", "next_event_estimation: false"}};

/// The strategies that can find lights without extent.
inline const std::vector<Strategy> kLightSampling{{"one", "light_selection: one"},
                                                  {"all", "light_selection: all"}};

/// Returns the irradiance at the origin, for the normal +z, from a polygon of radiance 1 above the
/// horizon. The polygon is a transformed square with the corners (+-1, +-1, 0). Lambert 1760: half
/// the sum over edges of the angle that the edge spans times the cosine between the receiver's
/// normal and the normal of the plane of that angle.
double polygon_irradiance(const Transform& quad);

/// A floor with the normal +z and the reflectance 0.5, seen from close by in a spot of half a
/// millimeter about the origin.
class Floor {
 public:
  static constexpr double kReflectance = 0.5;

  /// `shapes` and `emitters` are items of the scene's lists, one line per item, including the dash.
  Floor(std::string shapes, std::string emitters)
      : shapes_(std::move(shapes)), emitters_(std::move(emitters)) {}

  /// Checks that the irradiance [W/m^2] at the origin is `expected` for every strategy and sampler.
  void check_irradiance(double expected, const std::vector<Strategy>& strategies) const;

 private:
  std::string shapes_, emitters_;
};

}  // namespace pharos::testing
