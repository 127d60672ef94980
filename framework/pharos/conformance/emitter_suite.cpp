#include <cmath>

#include <fmt/format.h>

#include <pharos/conformance/emitter_site.h>
#include <pharos/conformance/fit.h>
#include <pharos/conformance/stage.h>
#include <pharos/conformance/suites.h>
#include <pharos/core/warp.h>

namespace pharos::conformance {
namespace {

/// Returns the density of directions, summed over all points of the light along a direction.
double density_along(const Site& site, Point3 from, Vec3 direction) {
  if (site.light->is_environment()) return site.light->pdf_direction(direction);
  return sum_along(*site.scene, {from, direction}, [&](const SurfacePoint& p) {
    return is_well_seen(from, p) ? double{site.light->pdf_point(from, p)} : 0.0;
  });
}

void check_density(const Site& site, std::uint64_t seed, Check& chi_square, Check& integral) {
  constexpr double kRim = 2e-3;
  if (!site.is_lit() || site.lit.discrete) {
    for (Check* check : {&chi_square, &integral}) {
      check->not_applicable(site.is_lit() ? "a discrete light" : kNeverLit);
    }
    return;
  }
  for (const Point3 from : site.references) {
    const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
      const LightSample s = site.light->sample(from, random.next_2d());
      const bool seen = site.light->is_environment() || is_well_seen(from, s.point);
      return s.pdf > 0 && seen ? std::optional(s.direction) : std::nullopt;
    };
    const auto density = [&](Vec3 d) { return density_along(site, from, d); };
    test_directions({draw, density, where(site, from), kRim, 1e-3, 40'000}, seed, chi_square,
                    integral);
  }
}

/// Returns the radiance and the density for a path that hits the sampled point by chance.
std::pair<Rgb, float> found_by_path(const Site& site, Point3 from, const LightSample& s) {
  if (site.light->is_environment()) {
    return {site.light->environment_radiance(s.direction), site.light->pdf_direction(s.direction)};
  }
  return {site.light->radiance(s.point, -s.direction), site.light->pdf_point(from, s.point)};
}

void check_weight(const Site& site, std::uint64_t seed, Check& check) {
  constexpr double kTolerance = 0.01;
  check.not_applicable(site.is_lit() ? "no other technique finds a discrete light" : kNeverLit);
  for (const Point3 from : site.references) {
    RandomStream random(seed, 1);
    for (int i = 0; i < 2000; ++i) {
      const LightSample s = site.light->sample(from, random.next_2d());
      if (s.discrete || s.pdf <= 0) continue;
      const auto [radiance, pdf] = found_by_path(site, from, s);
      check.expect_mostly(close(s.radiance, radiance, kTolerance) && close(s.pdf, pdf, kTolerance),
                          [&, &r = radiance, &p = pdf] {
                            return fmt::format(
                                "{}: a sample of radiance {:.6g} and pdf {:.6g}; a path that finds "
                                "the same point has {:.6g} and {:.6g}",
                                where(site, from), max_component(s.radiance), s.pdf,
                                max_component(r), p);
                          });
      if (!std::isfinite(s.distance)) continue;
      const Point3 arrived = from + s.distance * s.direction;
      check.expect_mostly(length(arrived - s.point.position) < 1e-3f * (1 + s.distance), [&] {
        return where(site, from) + ": direction and distance do not lead to the sampled point";
      });
    }
  }
}

/// Returns points far away, at the origin, and on and next to the light.
std::vector<Point3> extreme_references(const Site& site) {
  std::vector<Point3> all = site.references;
  for (const float far : {1e3f, 1e6f, 1e12f}) all.push_back({far, -far, 0.5f * far});
  for (const float near : {0.0f, 1e-7f, 1e-4f}) {
    for (const SceneObject& object : site.scene->objects()) {
      const SurfacePoint p = object.shape->sample({0.3f, 0.6f}).point;
      all.push_back(p.position + near * p.normal);
      all.push_back(p.position - near * p.normal);
    }
  }
  if (std::isfinite(site.lit.distance)) all.push_back(site.lit.point.position);
  return all;
}

void check_finite(const Site& site, Check& check) {
  for (const Point3 from : extreme_references(site)) {
    for (const float x : {0.0f, 0.3f, 0.5f, kOneMinusEpsilon}) {
      for (const float y : {0.0f, 0.5f, kOneMinusEpsilon}) {
        const LightSample s = site.light->sample(from, {x, y});
        check.expect(is_non_negative(s.pdf), [&] {
          return fmt::format("{}, u ({}, {}): pdf {}", where(site, from), x, y, s.pdf);
        });
        if (!(s.pdf > 0)) continue;
        check.expect(is_finite(s.direction) && std::abs(length(s.direction) - 1) < 1e-3f &&
                         s.distance > 0 && is_non_negative(s.radiance),
                     [&] {
                       return fmt::format(
                           "{}, u ({}, {}): direction, distance or radiance is not "
                           "finite, or negative",
                           where(site, from), x, y);
                     });
      }
    }
  }
  check.expect(is_non_negative(site.light->power()),
               [&] { return fmt::format("{}: power() is {}", site.name, site.light->power()); });
}

/// Integrates radiance over the surface and the sphere of directions.
double surface_flux(const Site& site, RandomStream& random, int draws) {
  const Shape& shape = *site.scene->objects()[0].shape;
  double sum = 0;
  for (int i = 0; i < draws; ++i) {
    const ShapeSample s = shape.sample(random.next_2d());
    const Vec3 d = warp::sphere_from_square(random.next_2d());
    sum += double{mean(site.light->radiance(s.point, d))} * abs_dot(d, s.point.normal) /
           (s.pdf * warp::sphere_pdf());
  }
  return sum / draws;
}

/// Returns the flux into the scene's sphere: radiance over all directions times its cross section.
double environment_flux(const Site& site, RandomStream& random, int draws) {
  double sum = 0;
  for (int i = 0; i < draws; ++i) {
    const Vec3 d = warp::sphere_from_square(random.next_2d());
    sum += double{mean(site.light->environment_radiance(d))} / warp::sphere_pdf();
  }
  return sum / draws * double{kPi} * square(site.radius);
}

/// Integrates irradiance over a sphere around a light without extent, or over the scene's cross
/// section for a light infinitely far away.
double discrete_flux(const Site& site, RandomStream& random, int draws) {
  if (!std::isfinite(site.lit.distance)) {
    return double{mean(site.lit.radiance)} * double{kPi} * square(site.radius);
  }
  double sum = 0;
  for (int i = 0; i < draws; ++i) {
    const Point3 from =
        site.lit.point.position + warp::sphere_from_square(random.next_2d());  // at distance one
    const LightSample s = site.light->sample(from, random.next_2d());
    if (s.pdf > 0) sum += double{mean(s.radiance)} / warp::sphere_pdf();
  }
  return sum / draws;
}

void check_power(const Site& site, std::uint64_t seed, Check& check) {
  constexpr int kDraws = 200'000;
  RandomStream random(seed, 2);
  if (!site.is_lit()) {
    check.expect(site.light->power() == 0, [&] {
      return fmt::format("{}: power() is {:.4g}, yet {}: an example should be easier to find",
                         site.name, site.light->power(), kNeverLit);
    });
    return;
  }
  const double flux = site.lit.discrete              ? discrete_flux(site, random, kDraws)
                      : site.light->is_environment() ? environment_flux(site, random, kDraws)
                                                     : surface_flux(site, random, kDraws);
  const double claimed = site.light->power();
  check.expect(claimed >= 0.5 * flux && claimed <= 2 * flux, [&] {
    return fmt::format("{}: power() is {:.4g}, the flux {:.4g}", site.name, claimed, flux);
  });
}

void check_discrete(const Site& site, std::uint64_t seed, Check& check) {
  const bool discrete = site.lit.discrete;
  if (!discrete) check.not_applicable(site.is_lit() ? "not a discrete light" : kNeverLit);
  RandomStream random(seed, 3);
  for (const Point3 from : site.references) {
    const LightSample first = site.light->sample(from, {0.5f, 0.5f});
    for (int i = 0; i < 200; ++i) {
      const LightSample s = site.light->sample(from, random.next_2d());
      if (s.pdf <= 0) continue;
      if (s.discrete != discrete) {
        check.expect(false, [&] { return where(site, from) + ": discrete at times only"; });
      }
      if (!discrete) continue;
      check.expect(s.pdf == 1, [&] { return fmt::format("{}: pdf {}", where(site, from), s.pdf); });
      check.expect(s.direction == first.direction,
                   [&] { return where(site, from) + ": more than one direction"; });
    }
  }
}

void check_determinism(const Site& site, std::uint64_t seed, Check& check) {
  RandomStream random(seed, 4);
  for (const Point3 from : site.references) {
    for (int i = 0; i < 100; ++i) {
      const Vec2 u = random.next_2d();
      const LightSample a = site.light->sample(from, u);
      site.light->sample({1, 2, 3}, {0.1f, 0.9f});
      const LightSample b = site.light->sample(from, u);
      check.expect(a.direction == b.direction && a.radiance == b.radiance && a.pdf == b.pdf,
                   [&] { return where(site, from) + ": the same numbers give another sample"; });
    }
  }
}

}  // namespace

void check_emitter(const Ref<Emitter>& emitter, Suite& suite) {
  Check& chi_square = suite.check("chi_square");
  Check& integral = suite.check("integral");
  Check& weight = suite.check("weight");
  Check& finite = suite.check("finite");
  Check& power = suite.check("power");
  Check& discrete = suite.check("discrete");
  Check& determinism = suite.check("determinism");
  Check& emission = suite.check("emission");
  Check& emission_density = suite.check("emission_density");
  for (const Site& site : sites_of(emitter)) {
    check_density(site, suite.seed(), chi_square, integral);
    check_weight(site, suite.seed(), weight);
    check_finite(site, finite);
    check_power(site, suite.seed(), power);
    check_discrete(site, suite.seed(), discrete);
    check_determinism(site, suite.seed(), determinism);
    check_emission(site, suite.seed(), emission, emission_density);
  }
}

}  // namespace pharos::conformance
