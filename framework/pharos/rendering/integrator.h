#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/guiding/contract/termination.h>
#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/guiding/record/path_record.h>
#include <pharos/rendering/film.h>
#include <pharos/sampling/integrand_probe.h>
#include <pharos/sampling/sampler.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// A fixed part of a render. Its tile, samples and keys do not depend on who renders it and when.
/// The range of samples is that of a pixel of share 1; see PixelShares.
struct WorkUnit {
  PixelRect pixels;
  std::uint32_t iteration = 0;
  std::uint32_t first_sample = 0;
  std::uint32_t sample_count = 0;
  void archive(Archive& archive) {
    archive(pixels.x0, pixels.y0, pixels.x1, pixels.y1, iteration, first_sample, sample_count);
  }
};

/// Statistics of a work unit.
struct RenderCounters {
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;           ///< radiance and shadow rays
  std::uint64_t vertices = 0;       ///< vertices at which a next step was sampled
  std::uint64_t lit_paths = 0;      ///< paths that carry light
  std::uint64_t invalid_paths = 0;  ///< paths of NaN or infinite value; they count as black

  RenderCounters& operator+=(const RenderCounters& other);
  void archive(Archive& archive) { archive(paths, rays, vertices, lit_paths, invalid_paths); }
};

/// The result of a work unit. Results are merged in the order of work units.
struct WorkResult {
  FilmTile film;
  PathLog log;  ///< empty unless paths were recorded
  RenderCounters counters;
  /// The key of the first invalid path, if any. A message tells how to replay it.
  std::optional<PathKey> first_invalid;

  /// Saves the result, or loads it into one whose `film` has the pixels of the same unit.
  void archive(Archive& archive) { archive(film, log, counters, first_invalid); }
};

/// The data that is frozen during one iteration.
struct IterationContext {
  const PreparedSampler& sampler;
  std::uint64_t seed = 0;
  const GuidingFrame* guiding = nullptr;  ///< null: nothing is known yet
  bool record = false;                    ///< fill WorkResult::log
  bool training = false;                  ///< this is a training iteration
  const PixelShares* pixels = nullptr;    ///< how samples are shared among pixels; null: evenly
  /// The learned rule that ends and splits paths; null: none was learned.
  const TerminationRule* termination = nullptr;
};

/// The scene, sensor and film for which an integrator is prepared. All referenced objects outlive
/// the prepared integrator.
struct RenderTarget {
  const Scene& scene;
  const PreparedSensor& sensor;
  int width = 0, height = 0;  ///< size of the whole film [pixels]; paths are keyed by its pixels
  /// The part of the film that is rendered. Paths start at each of its pixels, the same number
  /// unless PixelShares say otherwise, and no path starts elsewhere.
  PixelRect window{0, 0, width, height};
  /// Whether paths pass through random points of their pixels. If false, all pass through the
  /// centers.
  bool jitter = true;
};

/// A path, described step by step as text. It is made by replaying the key of the path.
struct PathTrace {
  Rgb radiance;  ///< what the path adds to the image: the sum over all pixels for one sample each
  std::string text;
};

/// An integrator that is prepared for a scene and a film: constant and thread-safe.
class PreparedIntegrator {
 public:
  virtual ~PreparedIntegrator() = default;

  /// Renders one work unit. The result depends on the unit and the context alone.
  virtual void render(const WorkUnit& unit, const IterationContext& context,
                      WorkResult& result) const = 0;

  /// Traces the path of `key` again, by itself, and describes every vertex.
  virtual PathTrace replay(const PathKey& key, const IterationContext& context) const = 0;

  /// Returns a probe that evaluates the integrand for samplers; null if the integrator has none.
  virtual std::unique_ptr<const IntegrandProbe> probe() const { return nullptr; }
};

/// The capabilities of an integrator. They are checked against the needs of learners and guiders.
struct IntegratorTraits {
  RecordNeeds records;         ///< records that it can make
  bool guided = false;         ///< asks guiders at vertices
  bool guided_camera = false;  ///< lets guiders propose first vertices
  bool resampled = false;      ///< can choose steps among several candidates
  /// Training iterations make other paths than the final image does.
  bool trains_with_other_paths = false;
};

/// Contract: how light transport is estimated. An integrator knows no guiding method by name.
class Integrator : public Component {
 public:
  static constexpr std::string_view contract_name = "integrator";

  virtual IntegratorTraits traits() const = 0;
  /// Returns the guiding part of the settings; null: unguided.
  virtual const GuidingSettings* guiding() const { return nullptr; }
  /// Returns the termination of paths that the render is to teach; null: there is none that learns.
  virtual const Termination* learned_termination() const { return nullptr; }
  /// Returns how the render trains what it learns; null: nothing learns.
  virtual const TrainingSettings* training() const {
    return guiding() != nullptr && guiding()->learns() ? &guiding()->training : nullptr;
  }
  virtual std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget& target) const = 0;
};

/// Throws InputError if guiding needs something that the integrator, the sensor or a
/// film without jitter does not offer. The message names both sides.
void check_compatible(const Integrator& integrator, const Sensor& sensor, bool jitter = true);

}  // namespace pharos
