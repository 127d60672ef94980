#include "guider.h"

namespace pharos::open_pgl {
namespace {

/// The answer to a query. If the thread has made other queries since, the library computes the
/// answer again.
class OpenPglDistribution final : public GuidingDistribution {
 public:
  OpenPglDistribution(const OpenPglModel& model, const Query& query)
      : model_(model), query_(query) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    return propose_direction(model_.at(query_)->sample(stream.get_2d(Purpose::guide_direction)));
  }
  float density(const ResolvedVertex& vertex) const override {
    return model_.at(query_)->pdf(vertex.direction);
  }

 private:
  const OpenPglModel& model_;
  Query query_;
};

}  // namespace

void OpenPglGuiderSettings::describe(Schema<OpenPglGuiderSettings>& s) {
  s.field("cosine", &OpenPglGuiderSettings::cosine,
          "Multiply by the cosine on opaque surfaces, if the field's distributions support it");
  s.example("{ cosine: false }");
}

const GuidingDistribution* OpenPglGuider::query(const OpenPglModel& model,
                                                const GuidingQuery& query, Arena& arena) const {
  Query asked{.position = query.current.position,
              .in_volume = query.current.kind == VertexKind::volume};
  const bool is_opaque =
      !asked.in_volume && !contains(query.scattering->events(), Event::smooth_transmit);
  if (settings_.cosine && is_opaque) {
    const Vec3 n = query.current.shading_normal;
    asked.cosine_about = dot(n, query.towards_previous) < 0 ? -n : n;
  }
  return model.at(asked) != nullptr ? arena.make<OpenPglDistribution>(model, asked) : nullptr;
}

}  // namespace pharos::open_pgl
