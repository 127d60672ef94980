#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/guiding/record/path_record.h>
#include <pharos/rendering/film.h>
#include <pharos/sampling/integrand_probe.h>
#include <pharos/sampling/sampler.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// A fixed part of a render: the same tile, samples and keys whoever runs it and when.
struct WorkUnit {
  PixelRect pixels;
  std::uint32_t iteration = 0;
  std::uint32_t first_sample = 0;
  std::uint32_t sample_count = 0;
};

/// Counts of what a work unit did.
struct RenderCounters {
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;           ///< radiance and shadow rays
  std::uint64_t invalid_paths = 0;  ///< of NaN or infinite value; left out of the image

  RenderCounters& operator+=(const RenderCounters& other);
};

/// What a work unit produces; merged in order of work units.
struct WorkResult {
  FilmTile film;
  PathLog log;  ///< empty unless paths were recorded
  RenderCounters counters;
  /// Key of the first invalid path, if any; a message names how to replay it.
  std::optional<PathKey> first_invalid;
};

/// What is frozen while an iteration runs.
struct IterationContext {
  const PreparedSampler& sampler;
  std::uint64_t seed = 0;
  const GuidingFrame* guiding = nullptr;  ///< null: nothing is known yet
  bool record = false;                    ///< fill WorkResult::log
};

/// What an integrator is made ready for. All referenced objects outlive it.
struct RenderTarget {
  const Scene& scene;
  const PreparedSensor& sensor;
  int width = 0, height = 0;  ///< of the whole film, by whose pixels paths are keyed
  /// The part of the film that is rendered; paths start at its pixels alone, as many at each.
  PixelRect window{0, 0, width, height};
  /// Whether paths pass anywhere through their pixels, or all through the middles.
  bool jitter = true;
};

/// One path, step by step, as text; made by replaying its key.
struct PathTrace {
  Rgb radiance;  ///< what the path adds to the image: the sum over all pixels for one sample each
  std::string text;
};

/// An integrator made ready for a scene and a film: constant, thread-safe.
class PreparedIntegrator {
 public:
  virtual ~PreparedIntegrator() = default;

  /// Renders one work unit. Its result is a function of the unit and the context alone.
  virtual void render(const WorkUnit& unit, const IterationContext& context,
                      WorkResult& result) const = 0;

  /// Runs the path of `key` again, by itself, and tells of every vertex.
  virtual PathTrace replay(const PathKey& key, const IterationContext& context) const = 0;

  /// Lays the integrand open to samplers; null when the integrator cannot.
  virtual std::unique_ptr<const IntegrandProbe> probe() const { return nullptr; }
};

/// What an integrator offers; checked against what learners and guiders need.
struct IntegratorTraits {
  RecordNeeds records;         ///< what it can record
  bool guided = false;         ///< asks guiders at vertices
  bool guided_camera = false;  ///< lets guiders propose first vertices
  /// Training iterations make other paths than the final image does.
  bool trains_with_other_paths = false;
};

/// Contract: how light transport is estimated. Knows no guiding method by name.
class Integrator : public Component {
 public:
  static constexpr std::string_view contract_name = "integrator";

  virtual IntegratorTraits traits() const = 0;
  /// The guiding part of its settings; null: unguided.
  virtual const GuidingSettings* guiding() const { return nullptr; }
  virtual std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget& target) const = 0;
};

/// Throws InputError, naming both sides, when a learner or guider needs what the integrator, the
/// sensor or a film without jitter does not offer.
void check_compatible(const Integrator& integrator, const Sensor& sensor, bool jitter = true);

}  // namespace pharos
