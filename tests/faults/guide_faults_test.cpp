// Faults planted into a guide and into a learner. The conformance suite and guided furnaces must
// notice them.

#include <cmath>
#include <set>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/conformance/conformance.h>

#include "../contracts/furnace.h"
#include "faulty_guider.h"

namespace pharos::testing {
namespace {

using Names = std::set<std::string>;

/// Returns the checks of the guiders' suite that fail for the guider `folding` with a fault. The
/// suite runs once, for all faults.
Names red_checks(const std::string& fault) {
  static const conformance::Report report =
      conformance::check_plugins(registry(), {.names = {"folding"}});
  Names red;
  for (const conformance::Finding& f : report.findings) {
    const bool planted = f.settings.find("fault") == std::string::npos
                             ? fault == "none"
                             : f.settings.find("fault: " + fault) != std::string::npos;
    if (planted && f.verdict == conformance::Verdict::failed) red.insert(f.check);
  }
  return red;
}

bool furnace_turns_red(const std::string& fault) {
  const std::string guiding = fmt::format(
      "{{ learner: stub_direction, guider: {{ type: folding, fault: {} }}, "
      "training: {{ iterations: 3 }} }}",
      fault);
  return std::abs(furnace_t(path_config(kDiffuseScene, 4, guiding, 128), kDiffuseFurnace, 16)) >
         kLimit;
}

/// Returns the mean radiance that the learner `uniform` finds in the diffuse furnace, where a
/// learner with a fault passes on the paths.
double learned_radiance(const std::string& fault, const std::string& termination) {
  const RenderResult result = render(
      kDiffuseScene +
      fmt::format("integrator:\n  type: path\n  max_depth: 3\n  termination: {}\n"
                  "  guiding: {{ learner: {{ type: retelling, fault: {}, learner: uniform }}, "
                  "guider: uniform, training: {{ iterations: 1, share: 0.9 }} }}\n"
                  "sampler: independent\nbudget: {{ spp: 32 }}\n",
                  termination, fault));
  return result.model->density({}, nullptr);
}

/// Returns whether a learner with a fault notices that paths split at their second vertex, where
/// steps find less light than at the first one.
bool learning_turns_red(const std::string& fault) {
  const std::string split = "{ type: stub_factor, factor: 2.5, first: 2 }";
  const double quotient = learned_radiance(fault, split) / learned_radiance(fault, "none");
  return std::abs(quotient - 1) > 0.02;
}

}  // namespace

TEST_CASE("a guide that folds directions rightly") {
  CHECK(red_checks("none") == Names{});
  CHECK_FALSE(furnace_turns_red("none"));
}
TEST_CASE("fault: a guide's density is scaled by 1.03") {
  CHECK(red_checks("scaled").contains("integral"));
  CHECK(furnace_turns_red("scaled"));
}
TEST_CASE("fault: the density leaves out the branch that was flipped over") {
  const Names red = red_checks("mirrored_branch_missing");
  CHECK(red.contains("chi_square"));
  CHECK(red.contains("resampling"));
  CHECK(furnace_turns_red("mirrored_branch_missing"));
}
TEST_CASE("fault: the flip to the hemisphere is missing") {
  CHECK(red_checks("proposal_not_folded").contains("integral"));
  CHECK(furnace_turns_red("proposal_not_folded"));
}
TEST_CASE("fault: a guide uses the numbers of two techniques at once") {
  // The density is right, so only samplers that relate these numbers show an error.
  CHECK(red_checks("directions_of_both") == Names{"numbers"});
}
TEST_CASE("fault: a learner counts each branch of a vertex as a whole step") {
  CHECK_FALSE(learning_turns_red("none"));
  CHECK(learning_turns_red("branches_counted"));
}

}  // namespace pharos::testing
