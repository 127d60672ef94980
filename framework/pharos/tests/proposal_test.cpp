#include <doctest/doctest.h>

#include <pharos/guiding/contract/distribution.h>

namespace pharos {
namespace {

TEST_CASE("a proposal of a direction leaves everything else to the path") {
  const std::optional<Proposal> proposal = propose_direction({0, 0, 1});
  REQUIRE(proposal);
  CHECK(proposal->direction == Vec3{0, 0, 1});
  CHECK(proposal->events == EventMask::smooth);
  CHECK(proposal->reach == Proposal::Reach::medium);
  CHECK(proposal->within == nullptr);
  for (const VertexKind kind : {VertexKind::surface, VertexKind::volume, VertexKind::environment}) {
    CHECK(proposal->accepts(kind, {1, 2, 3}));
  }
}

TEST_CASE("a proposal accepts the kinds and places of vertices that it names") {
  Bounds3 box;
  box.add(Point3{0, 0, 0});
  box.add(Point3{1, 1, 1});
  const Proposal proposal{.targets = TargetMask::surface, .within = &box};
  CHECK(proposal.accepts(VertexKind::surface, {0.5f, 0.5f, 0.5f}));
  CHECK_FALSE(proposal.accepts(VertexKind::surface, {0.5f, 1.5f, 0.5f}));
  CHECK_FALSE(proposal.accepts(VertexKind::volume, {0.5f, 0.5f, 0.5f}));
}

}  // namespace
}  // namespace pharos
