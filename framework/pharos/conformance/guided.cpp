#include <pharos/conformance/guided.h>

namespace pharos::conformance {
namespace {

/// One guide and unguided sampling share the samples equally.
class EqualShares final : public MixingShares {
 public:
  std::uint32_t at(const MixingQuery& query, std::span<float> shares) const override {
    const std::array<float, 1> weight{1};
    share_by_weight(weight, query.places, 0.5f, shares);
    return 0;
  }
};

}  // namespace

GuidingFrame frame_of(const Guider& guider, const std::shared_ptr<const GuidingModel>& model,
                      std::uint32_t candidates) {
  return GuidingFrame({{.guider = BoundGuider(guider, model), .traits = guider.traits()}},
                      std::make_shared<const EqualShares>(), {.candidates = candidates});
}

std::optional<Proposal> Guided::propose(std::uint64_t path) const {
  const SampleStream numbers(numbers_, {.seed = 77, .index = path});
  const VertexStream stream(numbers, vertex_.query().bounce);
  return guidance_.propose(stream, stream.get_1d(Purpose::guide_choice));
}

std::optional<ResolvedVertex> Guided::draw(RandomStream& random) const {
  const std::optional<Proposal> proposal = propose(random());
  if (!proposal) return std::nullopt;
  const auto [direction, event] = step(*proposal);
  if (event == Event::none) return std::nullopt;
  const auto reached = reach(vertex_.surface_along(direction, event), *proposal, random);
  return reached && proposal->accepts(reached->kind, reached->position) ? reached : std::nullopt;
}

bool Guided::scatters_into(Vec3 direction) const {
  return !is_black(vertex_.scattering().evaluate(direction).value);
}

ResolvedVertex Guided::end_along(Vec3 direction) const {
  return vertex_.surface_along(direction, vertex_.scattering().smooth_event(direction));
}

ResolvedVertex Guided::stopped(ResolvedVertex v, float distance) const {
  const Ray ray{vertex_.query().current.position, v.direction, v.distance};
  v.distance = distance;
  v.position = ray.at(distance);
  v.kind = VertexKind::volume;
  v.medium_density = vertex_.medium()->leg(ray, channel_shares(Rgb(1)), distance).scatter_pdf;
  return v;
}

/// Returns the direction and the event of a proposed step. The event is none if the step has value
/// zero.
std::pair<Vec3, Event> Guided::step(const Proposal& proposal) const {
  if (is_empty(proposal.events & EventMask::smooth)) {
    for (const DiscreteOutcome& o : vertex_.scattering().discrete()) {
      if (contains(proposal.events, o.event)) return {o.direction, o.event};
    }
    return {{}, Event::none};
  }
  const Event event = vertex_.scattering().smooth_event(proposal.direction);
  const bool taken = contains(proposal.events, event) && scatters_into(proposal.direction);
  return {proposal.direction, taken ? event : Event::none};
}

std::optional<ResolvedVertex> Guided::reach(const ResolvedVertex& end, const Proposal& proposal,
                                            RandomStream& random) const {
  const bool at_distance = proposal.reach == Proposal::Reach::distance;
  if (vertex_.medium() == nullptr) return at_distance ? std::nullopt : std::optional(end);
  DistanceSample stop{proposal.distance, at_distance};
  if (proposal.reach == Proposal::Reach::medium) {
    const Ray ray{vertex_.query().current.position, end.direction, end.distance};
    stop = vertex_.medium()->sample(ray, channel_shares(Rgb(1)), 0, random.next_1d());
  } else if (at_distance && !(stop.t < end.distance)) {
    return std::nullopt;
  }
  return stop.scattered ? stopped(end, stop.t) : end;
}

}  // namespace pharos::conformance
