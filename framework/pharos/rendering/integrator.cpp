#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/rendering/integrator.h>

namespace pharos {
namespace {

void check_records(const RecordNeeds& offered, const GuidingMethod& method) {
  const LearnerTraits traits = method.learner->traits();
  const auto check = [&](bool needed, bool has, const char* what) {
    if (!needed || has) return;
    throw InputError(fmt::format("the learner '{}' needs {}, which the integrator does not record",
                                 method.learner->plugin_name(), what));
  };
  check(traits.records.light_samples, offered.light_samples, "light samples");
  check(traits.records.light_paths, offered.light_paths, "light paths");
}

void check_camera(const IntegratorTraits& offered, const Sensor& sensor, bool jitter,
                  const Guider& guider) {
  if (!guider.traits().guides_camera) return;
  if (!jitter) {
    throw InputError(fmt::format(
        "the guider '{}' guides the camera: paths cannot all pass through the middles of pixels, "
        "as 'film.jitter: false' wants",
        guider.plugin_name()));
  }
  if (!offered.guided_camera) {
    throw InputError(
        fmt::format("the guider '{}' guides the camera, which the integrator cannot follow",
                    guider.plugin_name()));
  }
  if (sensor.sees_one_direction()) {
    throw InputError(fmt::format(
        "the guider '{}' guides the camera, but the sensor '{}' sees a single direction",
        guider.plugin_name(), sensor.plugin_name()));
  }
}

/// Throws InputError if the guider cannot sample `model`, which the learner named `learner` learns.
void check_model(const GuidingMethod& method, const GuidingModel& model,
                 const std::string& learner) {
  if (method.guider->find(model) != nullptr) return;
  throw InputError(fmt::format(
      "the learner '{}' learns a '{}' model, but the guider '{}' samples a '{}' model", learner,
      model.info().name, method.guider->plugin_name(), method.guider->model_name()));
}

}  // namespace

RenderCounters& RenderCounters::operator+=(const RenderCounters& other) {
  paths += other.paths;
  rays += other.rays;
  vertices += other.vertices;
  lit_paths += other.lit_paths;
  invalid_paths += other.invalid_paths;
  return *this;
}

void check_compatible(const Integrator& integrator, const Sensor& sensor, bool jitter) {
  if (integrator.guiding() == nullptr) return;
  const IntegratorTraits offered = integrator.traits();
  if (integrator.guiding()->candidates > 1 && !offered.resampled) {
    throw InputError("the integrator cannot choose steps among several 'candidates'");
  }
  Ref<Learner> learner;
  for (const GuidingMethod& method : integrator.guiding()->resolved_methods()) {
    if (!method.shares_model()) learner = method.learner;
    check_model(method, *learner->empty_model(), learner->plugin_name());
    check_camera(offered, sensor, jitter, *method.guider);
    if (method.learns()) check_records(offered.records, method);
  }
}

}  // namespace pharos
