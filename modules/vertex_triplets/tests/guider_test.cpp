#include "../guider.h"

#include <doctest/doctest.h>

#include "../model.h"
#include "test_proposals.h"

namespace pharos::vertex_triplets {
namespace {

using namespace testing;

/// Returns a model of pairs around the origin: light comes from above, and a quarter of it is
/// reflected.
std::shared_ptr<const VertexTripletsModel> pairs_at_a_pane() {
  Gaussian<6> gaussian{Vector<6>::Zero(), 0.1 * Matrix<6>::Identity()};
  gaussian.mean[5] = 2;
  CellKnowledge cell;
  cell.share = 1;
  for (const auto& [event, share] :
       {std::pair{Event::discrete_reflect, 0.25f}, {Event::discrete_transmit, 0.75f}}) {
    cell.pairs.push_back({Mode{VertexKind::surface, event, VertexKind::surface},
                          {make_component<3>(share, gaussian)}});
  }
  return std::make_shared<VertexTripletsModel>(ModelKind{.prefix = Prefix::pair}, Octree({{}, 4}),
                                               std::vector<CellKnowledge>{cell},
                                               CameraMixture(std::vector<FirstVertex>{}), 0);
}

TEST_CASE("guides: where reflection is total, nothing aims at transmission") {
  const VertexTripletsGuider guider({});
  const BoundGuider bound(guider, pairs_at_a_pane());
  const SurfacePoint surface{.normal = {0, 0, 1}, .shading = Frame::from_normal({0, 0, 1})};
  const Vec3 back = normalize(Vec3{0.6f, 0, 0.8f});
  const GuidingVertex previous{.position = {1, 0, 1}}, current{.position = {0, 0, 0}};
  for (const bool total : {false, true}) {
    const Pane pane(total);
    const LocalScattering scattering(surface, pane, back, Transport::radiance);
    const GuidingQuery query{.previous = &previous,
                             .current = current,
                             .towards_previous = back,
                             .scattering = &scattering,
                             .region = bound.model().place(current).region};
    Arena arena;
    const GuidingDistribution* guide = bound.query(query, arena);
    REQUIRE(guide != nullptr);
    const auto share = [&](Event event) {
      return guide->density({.distance = 1, .kind = VertexKind::surface, .event = event});
    };
    CHECK(share(Event::discrete_reflect) == doctest::Approx(total ? 1 : 0.25));
    CHECK(share(Event::discrete_transmit) == doctest::Approx(total ? 0 : 0.75));
    RandomStream random(13);
    int reflected = 0;
    for (int i = 0; i < 1000; ++i) {
      const auto proposal = propose(*guide, random);
      REQUIRE(proposal);
      reflected += proposal->events == mask_of(Event::discrete_reflect) ? 1 : 0;
    }
    CHECK((reflected == 1000) == total);
  }
}

TEST_CASE("guides: unlikely prefixes are left to the BSDF if the config says so") {
  const SurfacePoint surface{.normal = {0, 0, 1}, .shading = Frame::from_normal({0, 0, 1})};
  const Vec3 back = normalize(Vec3{0.6f, 0, 0.8f});
  const GuidingVertex previous{.position = {1, 0, 1}};
  const Pane pane(false);
  const LocalScattering scattering(surface, pane, back, Transport::radiance);
  // The prefix of a pair is the current vertex, here 0.6 / sqrt(0.1) = 1.9 deviations away along
  // one of three axes: 1.1 as a root mean square.
  const GuidingVertex current{.position = {0.6f, 0, 0}};
  for (const float most : {1.0f, 1.2f, kTruncation}) {
    const VertexTripletsGuider guider({.prefix_deviations = most});
    const BoundGuider bound(guider, pairs_at_a_pane());
    const GuidingQuery query{.previous = &previous,
                             .current = current,
                             .towards_previous = back,
                             .scattering = &scattering,
                             .region = bound.model().place(current).region};
    Arena arena;
    CHECK((bound.query(query, arena) != nullptr) == (most > 1.1f));
  }
}

}  // namespace
}  // namespace pharos::vertex_triplets
