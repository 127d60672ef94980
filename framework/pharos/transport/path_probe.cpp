#include <algorithm>
#include <cmath>
#include <utility>

#include <pharos/sampling/keyed_numbers.h>
#include <pharos/transport/path_probe.h>

namespace pharos {
namespace {

/// A sampler that returns a chosen value for one dimension and keyed random numbers for all others.
class PinnedSampler final : public PreparedSampler {
 public:
  PinnedSampler(Dimension pinned, Vec2 value) : pinned_(pinned), value_(value) {}

  std::uint64_t begin(const PathKey& key) const override { return hash_key(key); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    return dimension == pinned_ ? value_.x : keyed_numbers(stream.state(), dimension).x;
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    return dimension == pinned_ ? value_ : keyed_numbers(stream.state(), dimension);
  }

 private:
  Dimension pinned_;
  Vec2 value_;
};

/// Keeps the contribution of the last light sample, including the throughput.
class LightProbeRecorder : public SilentRecorder {
 public:
  void connect(const Path& path, const Connection&, PathWeight weight, Rgb value) {
    last_ = path.throughput * (weight.own_end * value);
  }
  /// Returns the contribution; black if there was no light sample since the last call.
  Rgb take() { return std::exchange(last_, Rgb()); }

 private:
  Rgb last_;
};

class PathProbe final : public IntegrandProbe {
 public:
  explicit PathProbe(const CameraScene& shared) : shared_(shared) {}

  PixelGrid grid() const override { return {shared_.target.width, shared_.target.height}; }
  PixelRect window() const override { return shared_.target.window; }
  int light_branches() const override { return shared_.lights.branches(); }

  void evaluate(const ProbeQuery& query, std::span<const Vec2> points,
                std::span<Rgb> values) const override {
    const PathKey key = key_of(query);
    if (query.dimension.purpose() == Purpose::light_position) {
      evaluate_light(query, key, points, values);
      return;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      values[i] = walk(query, key, points[i], std::min(query.max_depth, shared_.settings.max_depth))
                      .radiance;
    }
  }

  FilmSample whole_path(const ProbeQuery& query, Vec2 point) const override {
    const PathSample path = walk(query, key_of(query), point, shared_.settings.max_depth);
    return {path.film, path.radiance};
  }

  FirstHit first_hit(int x, int y) const override {
    const RenderTarget& target = shared_.target;
    const LensPoint lens = target.sensor.sample_lens({0.5f, 0.5f});
    const Ray ray = target.sensor.ray(
        lens, {(static_cast<float>(x) + 0.5f) / static_cast<float>(target.width),
               (static_cast<float>(y) + 0.5f) / static_cast<float>(target.height)});
    SurfacePoint point;
    const float depth = target.scene.intersect(ray, point);
    if (std::isinf(depth)) return {};
    return {depth, point.shading.n, point.object};
  }

 private:
  PathKey key_of(const ProbeQuery& query) const {
    PathKey key = query.others;
    key.index = static_cast<std::uint64_t>(query.y) * shared_.target.width + query.x;
    return key;
  }

  /// Evaluates light samples. All points share the path up to the vertex.
  void evaluate_light(const ProbeQuery& query, const PathKey& key, std::span<const Vec2> points,
                      std::span<Rgb> values) const {
    std::fill(values.begin(), values.end(), Rgb());
    const std::uint16_t bounce = query.dimension.bounce(), branch = query.dimension.branch();
    // A light sample at vertex b belongs to paths of b + 1 segments.
    if (bounce >= query.max_depth || branch >= shared_.lights.branches()) return;
    const PinnedSampler sampler(query.dimension, {});
    const SampleStream stream(sampler, key);
    const IterationContext context{.sampler = sampler, .seed = key.seed};
    TransportArenas arenas;
    RenderCounters counters;
    LightProbeRecorder recorder;
    const CameraWalk walk(shared_, context, arenas, counters, recorder);
    CameraPath<NoCounterparts> flight{Path(stream), {}, {}};
    walk.visit_vertex(flight, bounce,
                      [&](const LocalScattering& scattering, const Guidance& guidance) {
                        for (std::size_t i = 0; i < points.size(); ++i) {
                          walk.sample_light(flight, scattering, guidance, {.branch = branch},
                                            flight.path.numbers(), points[i]);
                          values[i] = recorder.take();
                        }
                      });
  }

  PathSample walk(const ProbeQuery& query, const PathKey& key, Vec2 point,
                  std::uint16_t max_depth) const {
    const PinnedSampler sampler(query.dimension, point);
    const SampleStream stream(sampler, key);
    const IterationContext context{.sampler = sampler, .seed = key.seed};
    TransportArenas arenas;
    RenderCounters counters;
    SilentRecorder recorder;
    return CameraWalk(shared_, context, arenas, counters, recorder).run(stream, max_depth);
  }

  const CameraScene& shared_;
};

}  // namespace

std::unique_ptr<const IntegrandProbe> make_path_probe(const CameraScene& shared) {
  return std::make_unique<PathProbe>(shared);
}

}  // namespace pharos
