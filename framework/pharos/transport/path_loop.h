#pragma once

#include <pharos/transport/camera_walk.h>

namespace pharos {

/// Calls `trace(key, stream)` for every path of a work unit, in a fixed order, and counts the paths
/// on the film. If a guide chooses the pixels, every path is a splat, and the film reserves memory.
template <class Trace>
void for_each_path(const WorkUnit& unit, const IterationContext& context, int film_width,
                   WorkResult& result, Trace&& trace) {
  // The number of samples of a pixel, of the first `samples` of the mean of all pixels.
  const auto own = [&](int x, int y, std::uint32_t samples) {
    return context.pixels == nullptr ? samples : context.pixels->count(x, y, samples);
  };
  if (context.guiding != nullptr && context.guiding->guides_camera()) {
    result.film.expect_splats(unit.pixels.area() * unit.sample_count);
  }
  std::uint64_t count = 0;
  for (int y = unit.pixels.y0; y < unit.pixels.y1; ++y) {
    for (int x = unit.pixels.x0; x < unit.pixels.x1; ++x) {
      PathKey key{.seed = context.seed,
                  .iteration = unit.iteration,
                  .index = static_cast<std::uint64_t>(y) * film_width + x};
      const std::uint32_t end = own(x, y, unit.first_sample + unit.sample_count);
      key.sample = own(x, y, unit.first_sample);
      count += end - key.sample;
      for (; key.sample < end; ++key.sample) trace(key, SampleStream(context.sampler, key));
    }
  }
  result.film.count_paths(count);
}

/// Calls `render(recorder)` with the recorder that the iteration needs.
template <class Render>
void with_recorder(const IterationContext& context, WorkResult& result, Render&& render) {
  if (context.record) {
    LogRecorder recorder(result.log);
    render(recorder);
  } else {
    SilentRecorder recorder;
    render(recorder);
  }
}

/// Counts a path of NaN or infinite value and keeps the key of the first one. Such paths count as
/// black.
inline void reject(const PathKey& key, WorkResult& result) {
  ++result.counters.invalid_paths;
  if (!result.first_invalid) result.first_invalid = key;
}

/// Returns `radiance` if it is finite. Otherwise rejects the path, makes its record black, and
/// returns black.
inline Rgb checked(Rgb radiance, const PathKey& key, WorkResult& result) {
  if (is_finite(radiance)) return radiance;
  reject(key, result);
  if (result.log.size() > 0) result.log.blacken_last_path();
  return {};
}

/// Adds the value of a path to the film, and counts it if it carries light. NaN and infinite values
/// are counted and added as zero.
inline void deposit(PathSample sample, const RenderTarget& target, const PathKey& key,
                    WorkResult& result) {
  sample.radiance = checked(sample.radiance, key, result);
  if (!is_black(sample.radiance)) ++result.counters.lit_paths;
  if (sample.splat) {
    const auto pixels = static_cast<float>(target.window.area());
    result.film.add_splat(sample.film, pixels * sample.radiance);
    result.film.add_features(sample.film, sample.features);
  } else {
    result.film.add_sample(sample.film, sample.radiance, sample.features);
  }
}

}  // namespace pharos
