#include <utility>

#include <pharos/core/error.h>
#include <pharos/core/stopwatch.h>
#include <pharos/rendering/prepared_render.h>
#include <pharos/rendering/window_sensor.h>

namespace pharos {
namespace {

std::unique_ptr<const PreparedSensor> prepared_sensor(const Sensor& sensor,
                                                      const FilmSettings& film) {
  std::unique_ptr<const PreparedSensor> whole = sensor.prepare(film.width, film.height);
  if (!film.crop) return whole;
  return window_sensor(std::move(whole), film.width, film.height, film.window());
}

SceneParts with_sensor(SceneParts parts, const Ref<Sensor>& sensor) {
  if (sensor != nullptr) parts.sensor = sensor;
  return parts;
}

}  // namespace

PreparedRender::PreparedRender(const RenderConfig& config) : PreparedRender(config, Stopwatch()) {}

PreparedRender::PreparedRender(const RenderConfig& config, const Stopwatch& watch)
    : config_(config),
      scene_(with_sensor(config.scene, config.sensor)),
      sensor_(prepared_sensor(scene_.sensor(), config.film)),
      integrator_(
          config.integrator->prepare({scene_, *sensor_, config.film.width, config.film.height,
                                      config.film.window(), config.film.jitter})),
      tiles_(tiles_of(config.film.window(), config.film.tile)) {
  const TrainingSettings* training = config.integrator->training();
  training_ = training != nullptr ? *training : TrainingSettings{.iterations = 0};
  set_size_ = config.sampler->preferred_samples({config.seed, config.budget.spp.value_or(0)});
  preparation_seconds_ = watch.seconds();
  const auto probe = config.sampler->needs_probe() ? integrator_->probe() : nullptr;
  sampler_ = config.sampler->prepare({config.film.width, config.film.height},
                                     {config.seed, schedule().longest()}, probe.get());
  // A wide filter spreads samples over neighboring pixels. If one pixel had more samples than its
  // neighbors, the neighbors would be biased towards it.
  if (!sampler_->film_samples().empty() && config.film.filter->radius() > 0.5f) {
    throw InputError("samples that the sampler has left over need a film with `filter: box`");
  }
  sampler_seconds_ = watch.seconds() - preparation_seconds_;
}

RenderLearning PreparedRender::make_learning() const {
  const LearningContext context{
      .region = scene_.bounds(), .seed = config_.seed, .window = config_.film.window()};
  return {*config_.integrator, context};
}

Film PreparedRender::make_film() const {
  const FilmSettings& film = config_.film;
  return {film.window(), film.filter, film.least_weight};
}

std::uint64_t PreparedRender::add_left_over_samples(Film& film) const {
  if (sampler_->film_samples().empty()) return 0;
  const PixelRect window = config_.film.window();
  FilmTile tile = film.make_tile(window);
  std::uint64_t invalid = 0;
  for (const FilmSample& sample : sampler_->film_samples()) {
    if (!window.contains(static_cast<int>(sample.film.x), static_cast<int>(sample.film.y))) {
      continue;
    }
    const bool valid = is_finite(sample.radiance);
    if (!valid) ++invalid;
    tile.add_radiance(sample.film, valid ? sample.radiance : Rgb());
  }
  film.merge(tile);
  return invalid;
}

}  // namespace pharos
