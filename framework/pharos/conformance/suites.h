#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/conformance/check.h>
#include <pharos/conformance/subjects.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/learner.h>
#include <pharos/rendering/filter.h>
#include <pharos/rendering/integrator.h>
#include <pharos/sampling/sampler.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/emitter.h>
#include <pharos/scene/medium.h>
#include <pharos/scene/sensor.h>
#include <pharos/scene/shape.h>
#include <pharos/scene/texture.h>

/// One suite per contract, each in its own file. docs/contracts/conformance.md describes what each
/// check tests and how small an error it detects.
namespace pharos::conformance {

void check_bsdf(const Bsdf& bsdf, Suite& suite);
void check_emitter(const Ref<Emitter>& emitter, Suite& suite);
void check_sensor(const Sensor& sensor, Suite& suite);
void check_filter(const Filter& filter, Suite& suite);
void check_texture(const Texture& texture, Suite& suite);
void check_sampler(const Sampler& sampler, Suite& suite);
void check_phase_function(const PhaseFunction& phase, Suite& suite);
void check_medium(const Medium& medium, Suite& suite);
void check_shape(const Ref<Shape>& shape, Suite& suite);
void check_integrator(const Integrator& integrator, Suite& suite);
/// Tests a termination with what it learns in a small room, and in renders of a furnace.
void check_termination(const Registry& registry, const Subject& termination, Suite& suite);
/// Tests a guider with the model that `learner` learns in small renders.
void check_guider(const Registry& registry, const Subject& guider, const Subject& learner,
                  Suite& suite);
/// Tests a learner in renders with a guider of its model.
void check_learner(const Registry& registry, const Subject& learner, const Subject& guider,
                   Suite& suite);

}  // namespace pharos::conformance
