#include <algorithm>
#include <array>

#include <pharos/guiding/pipeline/guiding_frame.h>

namespace pharos {
namespace {

constexpr std::size_t kMostMethods = GuidingSettings::kMostMethods;

/// Scales the shares of the parts so that they sum to 1.
void normalize(std::span<GuidePart> parts) {
  float total = 0;
  for (const GuidePart& part : parts) total += part.share;
  for (GuidePart& part : parts) part.share /= total;
}

}  // namespace

const RadianceEstimate* find_radiance_around(const GuidingModel& model) {
  const auto* estimate = dynamic_cast<const RadianceEstimate*>(&model);
  return estimate != nullptr && estimate->radiance_traits().around ? estimate : nullptr;
}

std::optional<Proposal> GuidePart::propose(const VertexStream& stream) const {
  std::optional<Proposal> proposal = distribution->propose(stream);
  if (!proposal) return proposal;
  if (!steers_distance) proposal->reach = Proposal::Reach::medium;
  if (!steers_events) proposal->events = proposal->events & EventMask::smooth;
  return proposal;
}

float GuidePart::density(const ResolvedVertex& vertex) const {
  if (is_discrete(vertex.event) && !steers_events) return 0;
  const float value = distribution->density(vertex);
  return steers_distance ? value : value * vertex.medium_density;
}

std::optional<Proposal> Guidance::propose(const VertexStream& stream, float u) const {
  std::size_t i = 0;
  while (i + 1 < parts.size() && u >= parts[i].share) u -= parts[i++].share;
  return parts[i].propose(stream.after_choice(std::min(u / parts[i].share, kOneMinusEpsilon)));
}

float Guidance::density(const ResolvedVertex& vertex, PartDensities& of_parts) const {
  float sum = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    of_parts[i] = parts[i].density(vertex);
    sum += parts[i].share * of_parts[i];
  }
  return sum;
}

float Guidance::relative_radiance(Vec3 direction) const {
  float known = 0, sum = 0;
  for (const GuidePart& part : parts) {
    if (part.radiance == nullptr) continue;
    known += part.share;
    sum += part.share * part.radiance->relative(direction);
  }
  return unguided_share + (1 - unguided_share) * sum / known;
}

std::span<const Technique> Guidance::techniques(float unguided, const PartDensities& of_parts,
                                                std::span<Technique, kMostMethods + 1> out) const {
  out[0] = {unguided_share, unguided};
  if (!is_guided()) return out.first(1);
  for (std::uint32_t i = 0; i < methods; ++i) out[1 + i] = {};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    out[1 + parts[i].method] = {(1 - unguided_share) * parts[i].share, of_parts[i]};
  }
  return out.first(1 + methods);
}

GuidingFrame::GuidingFrame(std::vector<Method> methods, std::shared_ptr<const MixingShares> shares,
                           const GuidingRules& rules)
    : methods_(std::move(methods)),
      radiances_(methods_.size(), nullptr),
      shares_(std::move(shares)),
      rules_(rules) {
  for (std::size_t i = 0; rules_.candidates > 1 && i < methods_.size(); ++i) {
    if (methods_[i].guider) radiances_[i] = find_radiance_around(methods_[i].guider->model());
  }
  guides_camera_ = std::any_of(methods_.begin(), methods_.end(), [](const Method& method) {
    const GuidingVertex lens{.kind = VertexKind::sensor};
    return method.guider && method.traits.guides_camera &&
           method.guider->model().place(lens).evidence > 0;
  });
}

bool GuidingFrame::can_ask(const Method& method, const GuidingQuery& query) const {
  if (!method.guider) return false;
  if (query.current.kind == VertexKind::sensor) return method.traits.guides_camera;
  if (query.transport == Transport::importance && !method.traits.guides_light_paths) return false;
  return method.traits.steers_events || !query.scattering->purely_discrete();
}

Guidance GuidingFrame::query(GuidingQuery& query, Arena& arena, PathMemories* memories,
                             Arena* path_arena) const {
  Guidance guidance;
  if (query.bounce > rules_.last_bounce) return guidance;
  const std::size_t count = methods_.size();
  std::array<Place, kMostMethods> places;
  bool is_known = false;
  for (std::size_t i = 0; i < count; ++i) {
    places[i] = can_ask(methods_[i], query) ? methods_[i].guider->model().place(query.current)
                                            : Place{.evidence = 0};
    places[i].region += methods_[i].first_region;
    is_known |= places[i].evidence > 0;
  }
  if (!is_known) return guidance;
  std::array<float, kMostMethods + 1> shares{};
  const std::uint32_t key =
      shares_->at({query, std::span(places).first(count)}, std::span(shares).first(count + 1));

  auto* parts = arena.make_array<GuidePart>(count);
  std::size_t answers = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!(places[i].evidence > 0) || !(shares[1 + i] > 0)) continue;
    const Method& method = methods_[i];
    query.region = places[i].region - method.first_region;
    std::optional<PathMemory> memory;
    if (memories != nullptr) memory.emplace((*memories)[i], *path_arena);
    query.memory = memory ? &*memory : nullptr;
    const GuidingDistribution* distribution = method.guider->query(query, arena);
    if (distribution == nullptr) continue;
    parts[answers++] = {distribution, shares[1 + i], i, method.traits.steers_distance,
                        method.traits.steers_events};
    if (radiances_[i] == nullptr) continue;
    parts[answers - 1].radiance = radiances_[i]->radiance_around(query, arena);
    if (parts[answers - 1].radiance != nullptr) guidance.candidates = rules_.candidates;
  }
  query.memory = nullptr;
  if (answers == 0) return guidance;
  normalize({parts, answers});
  guidance.parts = {parts, answers};
  guidance.unguided_share = shares[0];
  guidance.mixing_key = key;
  guidance.methods = static_cast<std::uint32_t>(count);
  return guidance;
}

}  // namespace pharos
