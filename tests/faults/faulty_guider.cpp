// A guider that folds the directions of another guider into the hemisphere of the normal, correctly
// or with a planted fault:
//
//     guider: { type: folding, fault: mirrored_branch_missing, guider: stub_direction }

#include "faulty_guider.h"

#include <pharos/core/arena.h>

namespace pharos::testing {
namespace {

class FoldedDistribution final : public GuidingDistribution {
 public:
  FoldedDistribution(const GuidingDistribution& inner, Vec3 normal, GuideFault fault)
      : inner_(inner), normal_(normal), fault_(fault) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    if (fault_ == GuideFault::directions_of_both &&
        stream.get_2d(Purpose::bsdf_direction).x < 0.5f) {
      return std::nullopt;
    }
    std::optional<Proposal> proposal = inner_.propose(stream);
    const bool below = proposal && dot(proposal->direction, normal_) < 0;
    if (below && fault_ != GuideFault::proposal_not_folded) {
      proposal->direction = mirrored(proposal->direction);
    }
    return proposal;
  }

  float density(const ResolvedVertex& vertex) const override {
    if (dot(vertex.direction, normal_) < 0) return 0;
    float density = inner_.density(vertex);
    if (fault_ != GuideFault::mirrored_branch_missing) {
      ResolvedVertex other = vertex;
      other.direction = mirrored(vertex.direction);
      density += inner_.density(other);
    }
    if (fault_ == GuideFault::scaled) density *= 1.03f;
    if (fault_ == GuideFault::directions_of_both) density *= 0.5f;
    return density;
  }

 private:
  Vec3 mirrored(Vec3 d) const { return normalize(d - 2 * dot(d, normal_) * normal_); }

  const GuidingDistribution& inner_;
  Vec3 normal_;
  GuideFault fault_;
};

}  // namespace

void FoldingSettings::describe(Schema<FoldingSettings>& s) {
  s.field("fault", &FoldingSettings::fault, "The planted fault");
  s.field("guider", &FoldingSettings::guider, "Guider whose directions are folded")
      .otherwise("stub_direction");
}

const GuidingDistribution* FoldingGuider::query_found(const void* found, const GuidingQuery& query,
                                                      Arena& arena) const {
  const GuidingDistribution* inner = settings_.guider->query_found(found, query, arena);
  if (inner == nullptr || query.current.kind != VertexKind::surface) return inner;
  const bool seen_from_outside = dot(query.current.normal, query.towards_previous) >= 0;
  const Vec3 normal = seen_from_outside ? query.current.normal : -query.current.normal;
  return arena.make<FoldedDistribution>(*inner, normal, settings_.fault);
}

}  // namespace pharos::testing
