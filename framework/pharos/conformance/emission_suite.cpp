#include <cmath>

#include <fmt/format.h>

#include <pharos/conformance/emitter_site.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::conformance {
namespace {

/// A disk through which light passes.
struct Detector {
  Point3 center;
  Vec3 normal;  ///< unit, towards the light
  float radius = 1;

  double area() const { return double{kPi} * square(radius); }
  Point3 point(Vec2 u) const {
    const Vec2 p = radius * warp::disk_from_square(u);
    return center + Frame::from_normal(normal).to_world({p.x, p.y, 0});
  }
  bool is_crossed_by(Point3 from, Vec3 direction) const {
    const float approach = dot(direction, normal);
    if (!(approach < 0)) return false;
    const float t = dot(center - from, normal) / approach;
    return t > 0 && length(from + t * direction - center) <= radius;
  }
};

/// Places detectors across a few rays, so that narrow lobes are covered.
std::vector<Detector> detectors(const Site& site) {
  constexpr float kAway = 2;
  std::vector<Detector> all;
  RandomStream random(4);
  for (int i = 0; i < 1000 && all.size() < 3; ++i) {
    const Vec2 u = random.next_2d();
    const EmissionSample e = site.light->sample_emission(u, random.next_2d());
    if (!(e.pdf.direction > 0) || is_black(e.weight)) continue;
    if (e.kind == VertexKind::environment) {
      const Point3 at = site.center + 0.2f * site.radius * warp::sphere_from_square(u);
      all.push_back({at, -e.direction, 0.4f * site.radius});
    } else {
      all.push_back({e.point.position + kAway * e.direction, -e.direction, 0.25f * kAway});
    }
  }
  return all;
}

/// Compares the power through a detector by rays that leave the light with the power by light
/// samples from the detector's points.
void check_carried(const Site& site, std::uint64_t seed, Check& check) {
  constexpr std::size_t kDraws = 200'000;
  if (!site.is_lit()) check.not_applicable(kNeverLit);
  for (const Detector& detector : detectors(site)) {
    RandomStream random(seed, 4);
    std::vector<double> emitted(kDraws), received(kDraws);
    for (std::size_t i = 0; i < kDraws; ++i) {
      const Vec2 u = random.next_2d();
      const EmissionSample e = site.light->sample_emission(u, random.next_2d());
      if (e.pdf.direction > 0 && detector.is_crossed_by(e.point.position, e.direction)) {
        emitted[i] = mean(e.weight);
      }
      const Point3 at = detector.point(random.next_2d());
      const LightSample s = site.light->sample(at, random.next_2d());
      const float cosine = dot(s.direction, detector.normal);
      if (s.pdf > 0 && cosine > 0) {
        received[i] = detector.area() * mean(s.radiance) * cosine / s.pdf;
      }
    }
    const auto a = statistics::estimate(statistics::moments(emitted));
    const auto b = statistics::estimate(statistics::moments(received));
    check.add_p_value(
        statistics::welch_test(a, b).p_value,
        fmt::format("{}: {:.5g} W leave the light for a disk on which light samples find {:.5g} W",
                    where(site, detector.center), a.mean, b.mean));
  }
}

/// Checks that a ray carries radiance times cosine over its densities, and that these are the
/// results of pdf_emission().
void check_emitted(const Site& site, std::uint64_t seed, Check& check) {
  constexpr double kTolerance = 0.01;
  check.not_applicable("nothing is emitted");
  RandomStream random(seed, 5);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 u = random.next_2d();
    const EmissionSample e = site.light->sample_emission(u, random.next_2d());
    check.expect(is_non_negative(e.weight) && is_non_negative(e.pdf.position) &&
                     is_non_negative(e.pdf.direction) && is_finite(e.point.position),
                 [&] { return site.name + ": a ray that is negative or not finite"; });
    if (!(e.pdf.direction > 0)) continue;
    check.expect(std::abs(length(e.direction) - 1) < 1e-3f,
                 [&] { return site.name + ": a ray's direction is not unit"; });
    const bool comes_from_afar = e.kind == VertexKind::environment;
    check.expect(comes_from_afar == !std::isfinite(site.lit.distance) || !site.is_lit(),
                 [&] { return site.name + ": a ray's kind is not that of the light"; });
    check.expect(
        !comes_from_afar || dot(site.center - e.point.position, e.direction) >= 0.99f * site.radius,
        [&] { return site.name + ": a ray from afar begins within the scene"; });
    const EmissionDensity pdf = site.light->pdf_emission(e.point, e.direction);
    check.expect_mostly(close(pdf.position, e.pdf.position, kTolerance) &&
                            close(pdf.direction, e.pdf.direction, kTolerance),
                        [&] {
                          return fmt::format(
                              "{}: a ray of densities {:.6g} and {:.6g}, which pdf_emission() says "
                              "are {:.6g} and {:.6g}",
                              site.name, e.pdf.position, e.pdf.direction, pdf.position,
                              pdf.direction);
                        });
    if (site.lit.discrete || e.kind == VertexKind::light) continue;
    const bool is_distant = site.light->is_environment();
    const Rgb radiance = is_distant ? site.light->environment_radiance(-e.direction)
                                    : site.light->radiance(e.point, e.direction);
    const float cosine = is_distant ? 1 : dot(e.direction, e.point.normal);
    check.expect_mostly(
        close(e.pdf.position * e.pdf.direction * e.weight, cosine * radiance, kTolerance),
        [&] { return site.name + ": a ray carries another radiance than there is"; });
  }
}

}  // namespace

void check_emission(const Site& site, std::uint64_t seed, Check& carried, Check& density) {
  check_carried(site, seed, carried);
  check_emitted(site, seed, density);
}

}  // namespace pharos::conformance
