#include <algorithm>

#include <pharos/guiding/pipeline/guiding.h>

namespace pharos {
namespace {

/// Branch of guide_choice that chooses among methods; guides number theirs from 0 on.
constexpr std::uint16_t kMethodBranch = 0xffff;

/// One method's distribution within the mixture.
struct Part {
  const GuidingDistribution* distribution = nullptr;
  float share = 0;
  bool steers_distance = false;
  bool steers_events = false;

  std::optional<Proposal> propose(const VertexStream& stream) const {
    std::optional<Proposal> proposal = distribution->propose(stream);
    if (!proposal) return proposal;
    if (!steers_distance) proposal->reach = Proposal::Reach::medium;
    if (!steers_events) proposal->events = proposal->events & EventMask::smooth;
    return proposal;
  }

  float density(const ResolvedVertex& vertex) const {
    if (is_discrete(vertex.event) && !steers_events) return 0;
    const float value = distribution->density(vertex).value;
    return steers_distance ? value : value * vertex.medium_density;
  }
};

/// The weighted mixture of all methods that know something at a vertex.
class Mixture final : public GuidingDistribution {
 public:
  explicit Mixture(std::span<const Part> parts) : parts_(parts) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    if (parts_.size() == 1) return parts_[0].propose(stream);
    float u = stream.get_1d(Purpose::guide_choice, kMethodBranch);
    std::size_t i = 0;
    while (i + 1 < parts_.size() && u >= parts_[i].share) u -= parts_[i++].share;
    return parts_[i].propose(stream);
  }

  Density density(const ResolvedVertex& vertex) const override {
    float sum = 0;
    for (const Part& part : parts_) sum += part.share * part.density(vertex);
    return {sum, measure_of(vertex.event, vertex.kind)};
  }

 private:
  std::span<const Part> parts_;
};

/// Collects what `ask(method)` returns for each method into one distribution.
template <class Ask>
Guidance combine(const std::vector<GuidingFrame::Method>& methods, const MixingFractions& fractions,
                 Arena& arena, Ask&& ask) {
  Part* parts = arena.make_array<Part>(methods.size());
  std::size_t count = 0;
  float total = 0;
  Guidance guidance;
  for (const GuidingFrame::Method& method : methods) {
    if (method.guider == nullptr) continue;
    const GuidingDistribution* distribution = ask(method);
    if (distribution == nullptr) continue;
    if (count == 0) guidance.region = method.first_region + distribution->region();
    parts[count++] = {distribution, method.weight, method.steers_distance, method.steers_events};
    total += method.weight;
  }
  if (count == 0) return guidance;
  for (std::size_t i = 0; i < count; ++i) parts[i].share /= total;
  guidance.distribution = arena.make<Mixture>(std::span<const Part>(parts, count));
  guidance.unguided_fraction = fractions.unguided_fraction(guidance.region);
  return guidance;
}

}  // namespace

Guidance GuidingFrame::query(const GuidingQuery& query, Arena& arena) const {
  const bool purely_discrete = query.scattering.purely_discrete();
  return combine(methods_, *fractions_, arena, [&](const Method& method) {
    const bool declines = (purely_discrete && !method.steers_events) ||
                          (query.transport == Transport::importance && !method.guides_light_paths);
    return declines ? nullptr : method.guider->query(query, arena);
  });
}

Guidance GuidingFrame::query_camera(const PreparedSensor& sensor, const LensPoint& lens,
                                    Arena& arena) const {
  return combine(methods_, *fractions_, arena, [&](const Method& method) {
    const CameraGuider* camera = method.guider->camera();
    return camera == nullptr ? nullptr : camera->query_camera(sensor, lens, arena);
  });
}

bool GuidingFrame::guides_camera() const {
  return std::any_of(methods_.begin(), methods_.end(), [](const Method& method) {
    return method.guider != nullptr && method.guider->camera() != nullptr;
  });
}

}  // namespace pharos
