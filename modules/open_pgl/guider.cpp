#include "guider.h"

#include <functional>

#include <tbb/enumerable_thread_specific.h>

#include "model.h"
#include "query.h"

namespace pharos::open_pgl {
namespace {

class BoundPglGuider final : public BoundGuider {
 public:
  BoundPglGuider(std::shared_ptr<const OpenPglModel> model, const OpenPglGuiderSettings& settings)
      : model_(std::move(model)), settings_(settings), workplaces_(std::cref(model_->field())) {}

  const GuidingDistribution* query(const GuidingQuery& query, Arena& arena) const override;

  /// This thread's workplace, which has taken the query.
  const Workplace& at(const Query& query) const {
    Workplace& workplace = workplaces_.local();
    workplace.take(query);
    return workplace;
  }

 private:
  std::shared_ptr<const OpenPglModel> model_;
  OpenPglGuiderSettings settings_;
  mutable tbb::enumerable_thread_specific<Workplace> workplaces_;
};

/// An answered query. The library's own answer is made again where others came in between.
class OpenPglDistribution final : public GuidingDistribution {
 public:
  OpenPglDistribution(const BoundPglGuider& guider, const Query& query)
      : guider_(guider), query_(query) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    return Proposal{.direction =
                        guider_.at(query_).sample(stream.get_2d(Purpose::guide_direction))};
  }
  Density density(const ResolvedVertex& vertex) const override {
    return {guider_.at(query_).pdf(vertex.direction), Measure::solid_angle};
  }

 private:
  const BoundPglGuider& guider_;
  Query query_;
};

const GuidingDistribution* BoundPglGuider::query(const GuidingQuery& query, Arena& arena) const {
  if (query.scattering.purely_discrete()) return nullptr;
  Query asked{.position = query.current.position,
              .in_volume = query.current.kind == VertexKind::volume};
  const bool is_opaque =
      !asked.in_volume && !contains(query.scattering.events(), Event::smooth_transmit);
  if (settings_.cosine && is_opaque) {
    const Vec3 n = query.current.shading_normal;
    asked.cosine_about = dot(n, query.towards_previous) < 0 ? -n : n;
  }
  return workplaces_.local().take(asked) ? arena.make<OpenPglDistribution>(*this, asked) : nullptr;
}

}  // namespace

void OpenPglGuiderSettings::describe(Schema<OpenPglGuiderSettings>& s) {
  s.field("cosine", &OpenPglGuiderSettings::cosine,
          "Multiply by the cosine on opaque surfaces, where the field's distributions can");
  s.example("{ cosine: false }");
}

GuiderTraits OpenPglGuider::traits() const {
  return {.model = OpenPglModel::kName};
}

std::unique_ptr<const BoundGuider> OpenPglGuider::bind(
    std::shared_ptr<const GuidingModel> model) const {
  return std::make_unique<BoundPglGuider>(bind_model<OpenPglModel>(model, *this), settings_);
}

}  // namespace pharos::open_pgl
