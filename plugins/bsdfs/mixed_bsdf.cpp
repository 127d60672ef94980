#include "mixed_bsdf.h"

#include <algorithm>
#include <utility>

namespace pharos {
namespace {

/// Adds an outcome to the existing outcome of the same event, or appends it.
void merge(DiscreteOutcomes& all, const DiscreteOutcome& outcome) {
  for (int i = 0; i < all.count; ++i) {
    DiscreteOutcome& known = all.outcomes[static_cast<std::size_t>(i)];
    if (known.event != outcome.event) continue;
    known.value += outcome.value;
    known.probability += outcome.probability;
    return;
  }
  all.add(outcome);
}

}  // namespace

MixedBsdf::MixedBsdf(Ref<Bsdf> first, Ref<Bsdf> second, Ref<Texture> weight)
    : first_(std::move(first)), second_(std::move(second)), weight_(std::move(weight)) {}

MixedBsdf::Parts MixedBsdf::parts(const SurfacePoint& point, EventMask allowed) const {
  const Rgb of_second = weight_->evaluate(point), of_first = Rgb(1) - of_second;
  const auto chance = [&](const Bsdf& bsdf, Rgb weight) {
    return is_empty(bsdf.events() & allowed) ? 0 : mean(weight);
  };
  const LobeChoice choice(chance(*first_, of_first), chance(*second_, of_second));
  return {{{{*first_, of_first, choice.first()}, {*second_, of_second, choice.second()}}}, choice};
}

ScatterValue MixedBsdf::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                 ScatterOptions options) const {
  ScatterValue sum;
  for (const Part& part : parts(point, options.events).both) {
    if (part.probability == 0) continue;
    const ScatterValue v = part.bsdf.evaluate(point, wo, wi, options);
    sum.value += part.weight * v.value;
    sum.pdf += part.probability * v.pdf;
  }
  return sum;
}

std::optional<ScatterSample> MixedBsdf::sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                               Vec2 u, ScatterOptions options) const {
  const auto [both, choice] = parts(point, options.events);
  if (choice.nothing()) return {};
  const Part& chosen = both[choice.takes_first(u_choice) ? 0 : 1];
  const auto s = chosen.bsdf.sample(point, wo, u_choice, u, options);
  if (!s) return {};
  if (is_discrete(s->event)) {
    for (const DiscreteOutcome& o : discrete(point, wo, options)) {
      if (o.event != s->event) continue;
      return ScatterSample{o.direction, o.event, o.value / o.probability, o.probability};
    }
    return {};
  }
  const ScatterValue whole = evaluate(point, wo, s->direction, options);
  if (whole.pdf == 0) return {};
  return ScatterSample{s->direction, s->event, whole.value / whole.pdf, whole.pdf};
}

DiscreteOutcomes MixedBsdf::discrete(const SurfacePoint& point, Vec3 wo,
                                     ScatterOptions options) const {
  DiscreteOutcomes all;
  for (const Part& part : parts(point, options.events).both) {
    if (part.probability == 0) continue;
    for (DiscreteOutcome outcome : part.bsdf.discrete(point, wo, options)) {
      outcome.value *= part.weight;
      outcome.probability *= part.probability;
      merge(all, outcome);
    }
  }
  return all;
}

float MixedBsdf::roughness(const SurfacePoint& point) const {
  float smallest = 1;
  for (const Part& part : parts(point, EventMask::all).both) {
    if (part.probability > 0) smallest = std::min(smallest, part.bsdf.roughness(point));
  }
  return smallest;
}

float MixedBsdf::relative_ior() const {
  return first_->relative_ior() != 1 ? first_->relative_ior() : second_->relative_ior();
}

Rgb MixedBsdf::albedo(const SurfacePoint& point) const {
  const Rgb weight = weight_->evaluate(point);
  return (Rgb(1) - weight) * first_->albedo(point) + weight * second_->albedo(point);
}

}  // namespace pharos
