// bidirectional: combines path tracing and light tracing. For each sample of a pixel, one path
// starts at the lens and one at a light. Light is found in three ways: paths from the lens hit a
// light, vertices of paths from the lens sample a light, and vertices of paths from lights are
// connected to the lens. The balance heuristic weights each technique against all that can produce
// the same path (Veach 1997, section 10.2). Caustics therefore come from the paths that start at
// lights, and light that only paths from the lens can find comes from these. Inner vertices of the
// two subpaths are not connected to each other.
//
// One model guides both kinds of path if its guider supports it. The densities of either kind,
// including guides, enter the weights of the other kind. Guides learn from the paths that start at
// the lens, as in `path`, or from both kinds if their learner needs light paths. A termination may
// end paths from either end by Russian roulette. The weights ignore its probabilities, which depend
// on the whole prefix of a path: weights need only sum to one for each path.
//
//     integrator:
//       type: bidirectional
//       max_depth: 12
//       light_paths: always    # always | training: the final image is then that of `path`

#include "bidirectional.h"

#include <pharos/core/error.h>

namespace pharos {

void BidirectionalIntegrator::Settings::describe(Schema<Settings>& s) {
  s.field("max_depth", &Settings::max_depth, "Length of the longest path: 1 shows only emitters")
      .unit("segments")
      .at_least(1)
      .at_most(PreparedBidirectional<>::kFirstLightBounce - 1);
  s.field("light_selection", &Settings::light_selection,
          "Lights that are sampled at each vertex: one, chosen in proportion to power, or all");
  s.field("light_paths", &Settings::light_paths,
          "Whether paths start at lights always, or only to train guides, in which case the final "
          "image is that of path tracing");
  s.field("termination", &Settings::termination,
          "Where paths from either end end by Russian roulette; they do not split");
  s.field("guiding", &Settings::guiding, "Path guiding: what is learned and how it is used");
}

BidirectionalIntegrator::BidirectionalIntegrator(Settings settings)
    : settings_(std::move(settings)) {
  check_learns_nothing(settings_.termination);
}

PathSettings BidirectionalIntegrator::Settings::path_settings() const {
  PathSettings path;
  path.max_depth = max_depth;
  path.light_selection = light_selection;
  path.termination = termination;
  path.most_branches = 0;  // the final image may be that of path tracing
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
