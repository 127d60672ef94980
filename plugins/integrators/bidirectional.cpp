// bidirectional: path tracing and light tracing together. For each sample of a pixel one path
// starts at the lens and one at a light. Light is found in three ways: paths from the lens run into
// it or sample it, and whatever paths from lights meet is seen from the lens. Each way counts by
// the balance heuristic over all that can make the same path (Veach 1997, section 10.2), so that
// caustics come from the lights and what only the lens can see from there; subpaths are not
// connected in between.
//
// One model guides both kinds of path, if its guider can: the densities of either, guides included,
// count in the weights of the other. Guides learn from the paths that start at the lens, as in
// `path`, or from both if they ask for light paths. There is no Russian roulette: its probabilities
// would have to be known from the other end.
//
//     integrator:
//       type: bidirectional
//       max_depth: 12
//       light_paths: always    # always | training: the final image then is that of `path`

#include "bidirectional.h"

#include <pharos/core/error.h>

namespace pharos {

void BidirectionalIntegrator::Settings::describe(Schema<Settings>& s) {
  s.field("max_depth", &Settings::max_depth, "Longest path: 1 sees emitters only")
      .unit("segments")
      .at_least(1)
      .at_most(PreparedBidirectional<>::kFirstLightBounce - 1);
  s.field("light_selection", &Settings::light_selection,
          "Which lights a vertex samples: one in proportion to power, or all");
  s.field("light_paths", &Settings::light_paths,
          "Whether paths start at lights always, or for the training of guides alone: the final "
          "image then is that of path tracing");
  s.field("guiding", &Settings::guiding, "What is learned and how it is used");
}

PathSettings BidirectionalIntegrator::Settings::path_settings() const {
  PathSettings path;
  path.max_depth = max_depth;
  path.light_selection = light_selection;
  return path;
}

/// Paths from lights are recorded if a learner asks for them.
LightPathRules BidirectionalIntegrator::Settings::light_path_rules() const {
  LightPathRules rules{.always = light_paths == LightPaths::always};
  if (!guiding) return rules;
  for (const GuidingMethod& method : guiding->resolved_methods()) {
    rules.recorded |= method.learns() && method.learner->traits().records.light_paths;
  }
  return rules;
}

IntegratorTraits BidirectionalIntegrator::traits() const {
  return {.records = {.light_samples = true, .light_paths = true},
          .guided = true,
          .guided_camera = true,
          .trains_with_other_paths = settings_.light_paths == LightPaths::training};
}

const GuidingSettings* BidirectionalIntegrator::guiding() const {
  return settings_.guiding ? &*settings_.guiding : nullptr;
}

std::unique_ptr<const PreparedIntegrator> BidirectionalIntegrator::prepare(
    const RenderTarget& target) const {
  if (!target.jitter) {
    throw InputError("the integrator 'bidirectional' needs a film with 'jitter: true'");
  }
  return std::make_unique<PreparedBidirectional<>>(settings_.path_settings(),
                                                   settings_.light_path_rules(), target);
}

}  // namespace pharos
