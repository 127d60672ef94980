// principled: a material with artistic parameters, each from 0 to 1 (Burley 2012, "Physically Based
// Shading at Disney"; Burley 2015, "Extending the Disney BRDF to a BSDF with Integrated Subsurface
// Scattering"), in the form of Mitsuba 3. It is the sum of four lobes.
//
// The interface consists of GGX facets with alpha = max(0.001, roughness^2). It mirrors the share
//
//     metallic S(base_color) + (1 - metallic) (spec_tint S(R0 tint) + (1 - spec_tint) F),
//
// where F follows Fresnel's equations, S(c) = c + (1 - c) w(o.m), w(x) = (1 - x)^5, R0 is the
// reflectance for `ior` at normal incidence (R0 tint is at most 1), and tint is base_color scaled
// to luminance one. With weight (1 - metallic) spec_trans the interface also refracts
// (1 - F) sqrt(base_color).
//
// The matt lobe has weight (1 - metallic) (1 - spec_trans). It is base_color / pi times
//
//     (1 - w(o)/2) (1 - w(i)/2) + r (w(o) + w(i) + w(o) w(i) (r - 1)),  r = 2 roughness cos^2(d),
//
// where d is the angle between i and m. `flatness` blends this factor with
//
//     1.25 (s (1/(cos(o) + cos(i)) - 1/2) + 1/2),
//     s = (1 + (r/2 - 1) w(o)) (1 + (r/2 - 1) w(i)).
//
// Sheen is (1 - metallic) sheen w(cos(d)); `sheen_tint` blends its color from white to tint.
//
// The clearcoat is clearcoat / 4 F D G. F is Schlick's F with 0.04 at normal incidence. D is
// Burley's GTR distribution with exponent one; its alpha goes from 0.1 to 0.001 with
// `clearcoat_gloss`. G is the separable masking of GGX with alpha 0.25. (Burley divides by
// 4 cos(o) cos(i) here; Mitsuba does not, and neither does this material.)
//
// Seen from inside there is only the interface, with weight (1 - metallic) spec_trans. If this
// weight is 0 everywhere, the back is black. The index of the interface is `ior`. If `specular` is
// given instead, the index is
//
//     2 / (1 - sqrt(0.08 specular)) - 1,
//
// which is 1.5 for 0.5. Mitsuba's `anisotropic` is left out. `masking: separable` is Mitsuba's
// masking. If a number is given by a texture, the mean of the channels counts.
//
// The lobes are not coupled, so light colors scatter more light than arrives. A white base of
// roughness 0.5 scatters 4% too much seen from above and 22% too much at grazing angles; with
// roughness 1 the excess is up to 61%. Flatness, sheen, clearcoat and tints add to it. A furnace
// with such a material diverges. A base_color of at most 0.6 without flatness, sheen, clearcoat and
// tints conserves energy, and so do metals and clear materials without them. The material never
// scales anything down silently.
//
// If the material transmits light, alpha is at least 3e-5 / |ior - 1|, which single precision still
// resolves, and an index within 0.001 of one is rejected.
//
// sample() chooses between the interface, the matt lobe with sheen, and the clearcoat in proportion
// to approximate albedos. At a facet of the interface it chooses between reflection and refraction
// in proportion to their shares.
//
//     { type: principled, base_color: [0.6, 0.1, 0.1], roughness: 0.4, clearcoat: 1 }
#include "principled.h"

#include <cmath>

#include <fmt/core.h>

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>

#include "ggx.h"
#include "lobe_choice.h"
#include "parameters.h"
#include "rough_interface.h"

namespace pharos {
namespace {

constexpr float kSmallestAlpha = 0.001f;

/// A surface seen from one direction, with the scattering that is possible there. Directions are
/// flipped so that `wo` lies above.
class View {
 public:
  View(const PrincipledSurface& surface, Vec3 wo, Masking masking, ScatterOptions options)
      : surface_(surface),
        wo_(turned(wo, wo)),
        outside_(wo.z > 0),
        eta_(outside_ ? surface.ior : 1 / surface.ior),
        reflects_(contains(options.events, Event::smooth_reflect)),
        transmits_(contains(options.events, Event::smooth_transmit)),
        scale_(options.transport == Transport::radiance ? 1 / (eta_ * eta_) : 1),
        masking_(masking),
        facets_(GgxDistribution(surface.alpha, surface.alpha)),
        coat_or_matt_(has_base() ? surface.coat_albedo(wo_) : 0,
                      has_base() ? surface.matt_albedo() : 0),
        interface_or_base_(interface_albedo(), base_albedo()) {}

  /// The value and density of all lobes; zero for events that are not allowed.
  ScatterValue scattered(Vec3 wi) const {
    if (wi.z > 0) return reflects_ ? reflected(wi) : ScatterValue();
    return transmits_ ? refracted(wi) : ScatterValue();
  }

  /// Draws a direction with the density of scattered(). Empty if the drawn facet scatters nothing.
  std::optional<Vec3> sample(float u_choice, Vec2 u) const {
    if (interface_or_base_.nothing()) return {};
    if (interface_or_base_.takes_first(u_choice)) {
      const Vec3 m = facets_.sample_visible_normal(wo_, u);
      const float cosine = std::clamp(dot(wo_, m), 0.0f, 1.0f);
      const Ways both = ways(cosine, dielectric_fresnel(cosine, eta_).reflectance);
      if (both.choice.nothing()) return {};
      return facet_direction(wo_, m, eta_, both.choice.takes_first(u_choice));
    }
    if (coat_or_matt_.takes_first(u_choice)) {
      const Vec3 m = surface_.coat_facets().sample(u);
      const float cosine = dot(wo_, m);
      return cosine > 0 ? facet_direction(wo_, m, eta_, true) : std::nullopt;
    }
    return warp::cosine_hemisphere_from_square(u);
  }

 private:
  /// The shares of both events at a facet, and the choice between the allowed ones; reflection
  /// first.
  struct Ways {
    PrincipledSurface::Shares shares;
    float allowed;  ///< share of light that takes part in allowed events [1]
    LobeChoice choice;
  };
  Ways ways(float cosine, float dielectric) const {
    const PrincipledSurface::Shares shares = surface_.shares_at(cosine, dielectric, outside_);
    const float reflected = reflects_ ? mean(shares.reflected) : 0;
    const float transmitted = transmits_ ? mean(shares.transmitted) : 0;
    return {shares, reflected + transmitted, {reflected, transmitted}};
  }

  /// Whether the matt lobe, sheen and clearcoat take part.
  bool has_base() const { return outside_ && reflects_; }
  float base_albedo() const {
    return has_base() ? surface_.coat_albedo(wo_) + surface_.matt_albedo() : 0;
  }
  /// The approximate share of light that the interface scatters by allowed events: the share of a
  /// level facet.
  float interface_albedo() const {
    const float cosine = std::min(1.0f, wo_.z);
    return ways(cosine, dielectric_fresnel(cosine, eta_).reflectance).allowed;
  }

  /// Reflection by interface and base.
  ScatterValue reflected(Vec3 wi) const {
    const std::optional<Vec3> m = half_vector(wo_, wi);
    if (!m) return {};
    const float cosine = std::min(1.0f, 0.5f * length(wo_ + wi));  // o.m, and never zero
    const Ways facet = ways(cosine, dielectric_fresnel(cosine, eta_).reflectance);
    const float density = facets_.visible_reflection_pdf(wo_, *m);
    ScatterValue sum{density * facets_.shadowing(wo_, wi, masking_) * facet.shares.reflected,
                     density * interface_or_base_.first() * facet.choice.first()};
    if (!outside_) return sum;
    sum.value += surface_.matt(wo_, wi, *m) + Rgb(surface_.coat(wo_, wi, *m));
    sum.pdf +=
        interface_or_base_.second() * (coat_or_matt_.first() * coat_pdf(*m, cosine) +
                                       coat_or_matt_.second() * warp::cosine_hemisphere_pdf(wi.z));
    return sum;
  }

  /// The density of the direction mirrored by a clearcoat facet of normal `m` [1/sr].
  float coat_pdf(Vec3 m, float cosine) const {
    return surface_.clearcoat > 0 ? surface_.coat_facets().density(m) * m.z / (4 * cosine) : 0;
  }

  /// Refraction by the interface.
  ScatterValue refracted(Vec3 wi) const {
    const std::optional<RefractingFacet> facet = refracting_facet(wo_, wi, eta_);
    if (!facet) return {};
    const Ways both = ways(facet->cosine, facet->fresnel);
    const float density = facets_.visible_normal_pdf(wo_, facet->normal) * facet->jacobian;
    return {scale_ * density * facets_.shadowing(wo_, wi, masking_) * both.shares.transmitted,
            density * interface_or_base_.first() * both.choice.second()};
  }

  const PrincipledSurface& surface_;
  Vec3 wo_;
  bool outside_;
  float eta_;  ///< index below over the index above
  bool reflects_, transmits_;
  float scale_;  ///< factor on refracted radiance
  Masking masking_;
  Microfacets<GgxDistribution> facets_;
  LobeChoice coat_or_matt_, interface_or_base_;
};

/// Returns the refractive index given by the settings.
float stated_index(const Principled::Settings& settings) {
  if (settings.ior && settings.specular) {
    throw InputError("'ior' and 'specular' exclude each other");
  }
  if (settings.ior) return *settings.ior;
  return 2 / (1 - std::sqrt(0.08f * settings.specular.value_or(0.5f))) - 1;
}

}  // namespace

void Principled::Settings::describe(Schema<Settings>& s) {
  describe_share(s, "base_color", &Settings::base_color, "Color of the material", "0.5");
  describe_share(s, "roughness", &Settings::roughness, "Square root of the GGX alpha", "0.5");
  describe_share(s, "metallic", &Settings::metallic,
                 "Share of the metallic material: 0 is a dielectric, 1 a metal", "0");
  s.field("specular", &Settings::specular,
          "Strength of reflection, as an alternative to ior; 0.5 means an index of 1.5")
      .at_least(0)
      .at_most(1);
  describe_ior(s, "Refractive index inside over outside; 1.5 if neither it nor specular is given");
  describe_share(s, "spec_tint", &Settings::spec_tint, "How much reflections are tinted", "0");
  describe_share(s, "spec_trans", &Settings::spec_trans, "Share of the clear, refracting material",
                 "0");
  describe_share(s, "sheen", &Settings::sheen, "Strength of the sheen of cloth", "0");
  describe_share(s, "sheen_tint", &Settings::sheen_tint, "How much the sheen is tinted", "0");
  describe_share(s, "flatness", &Settings::flatness,
                 "Blend towards a flat look that imitates subsurface scattering", "0");
  describe_share(s, "clearcoat", &Settings::clearcoat, "Strength of a clear coat", "0");
  describe_share(s, "clearcoat_gloss", &Settings::clearcoat_gloss, "How polished the coat is", "0");
  s.field("masking", &Settings::masking, "How masking and shadowing are combined");
  s.example("{ base_color: [0.6, 0.1, 0.1], roughness: 0.4, clearcoat: 1, clearcoat_gloss: 0.5 }");
  s.example("{ base_color: [0.9, 0.6, 0.3], metallic: 1, roughness: 0.3, masking: separable }");
  s.example(
      "{ base_color: [0.2, 0.3, 0.6], roughness: 0.8, sheen: 0.5, sheen_tint: 1, flatness: 0.7, "
      "spec_tint: 0.5 }");
  s.example(
      "{ base_color: [0.7, 0.4, 0.7], roughness: 0.5, spec_trans: 0.7, metallic: 0.2, ior: 1.33 }");
}

Principled::Principled(const Settings& settings)
    : settings_(settings),
      ior_(stated_index(settings)),
      is_clear_(!is_black(settings.spec_trans->maximum())),
      smallest_alpha_(kSmallestAlpha),
      average_fresnel_(average_dielectric_fresnel(ior_)) {
  if (!is_clear_) return;
  constexpr float kNearest = 0.001f, kNarrowest = 3e-5f;
  const float difference = std::abs(ior_ - 1);
  if (!(difference >= kNearest)) {
    throw InputError(fmt::format(
        "where 'spec_trans' lets light through, the refractive index must differ from 1 by at "
        "least {}, but it is {:.6g}",
        kNearest, ior_));
  }
  smallest_alpha_ = std::max(kSmallestAlpha, kNarrowest / difference);
}

EventMask Principled::events() const {
  const EventMask reflection = mask_of(Event::smooth_reflect);
  return is_clear_ ? reflection | mask_of(Event::smooth_transmit) : reflection;
}

PrincipledSurface Principled::surface(const SurfacePoint& point) const {
  const auto number = [&](const Ref<Texture>& texture) { return mean(texture->evaluate(point)); };
  const float roughness = number(settings_.roughness);
  return {.base_color = settings_.base_color->evaluate(point),
          .roughness = roughness,
          .alpha = std::max(smallest_alpha_, roughness * roughness),
          .metallic = number(settings_.metallic),
          .spec_trans = number(settings_.spec_trans),
          .spec_tint = number(settings_.spec_tint),
          .sheen = number(settings_.sheen),
          .sheen_tint = number(settings_.sheen_tint),
          .flatness = number(settings_.flatness),
          .clearcoat = number(settings_.clearcoat),
          .clearcoat_gloss = number(settings_.clearcoat_gloss),
          .ior = ior_};
}

ScatterValue Principled::evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                  ScatterOptions options) const {
  if (wo.z == 0 || wi.z == 0 || (wo.z < 0 && !is_clear_)) return {};
  const PrincipledSurface here = surface(point);
  return View(here, wo, settings_.masking, options).scattered(turned(wi, wo));
}

std::optional<ScatterSample> Principled::sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                                Vec2 u, ScatterOptions options) const {
  if (wo.z == 0 || (wo.z < 0 && !is_clear_)) return {};
  const PrincipledSurface here = surface(point);
  const View view(here, wo, settings_.masking, options);
  const std::optional<Vec3> wi = view.sample(u_choice, u);
  if (!wi || wi->z == 0) return {};
  const ScatterValue value = view.scattered(*wi);
  if (value.pdf == 0) return {};
  return ScatterSample{turned(*wi, wo), wi->z > 0 ? Event::smooth_reflect : Event::smooth_transmit,
                       value.value / value.pdf, value.pdf};
}

float Principled::roughness(const SurfacePoint& point) const {
  const PrincipledSurface here = surface(point);
  return here.clearcoat > 0 ? std::min(here.alpha, here.coat_alpha()) : here.alpha;
}

Rgb Principled::albedo(const SurfacePoint& point) const {
  constexpr float kAverageSchlick = 1.0f / 21;  // mean over the hemisphere
  const PrincipledSurface here = surface(point);
  const auto [reflected, transmitted] = here.shares(average_fresnel_, kAverageSchlick, true);
  const Rgb sum = reflected + transmitted + here.matt_weight() * here.base_color;
  return {std::min(1.0f, sum.r), std::min(1.0f, sum.g), std::min(1.0f, sum.b)};
}

}  // namespace pharos
