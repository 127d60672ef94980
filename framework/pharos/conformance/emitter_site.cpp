#include <fmt/format.h>

#include <pharos/conformance/emitter_site.h>
#include <pharos/conformance/stage.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>

namespace pharos::conformance {
namespace {

bool is_lit(const Site& site, Point3 from) {
  RandomStream random(2);
  for (int i = 0; i < 64; ++i) {
    const LightSample s = site.light->sample(from, random.next_2d());
    if (s.pdf > 0 && !is_black(s.radiance)) return true;
  }
  return false;
}

/// Searches for lit points around the light and adds them to the references until enough of these
/// are lit. The first tries are near the light. Later tries are so far away that they see lights
/// beside the scene which shine away from it. A spot light of one degree illuminates a fraction of
/// 8e-5 of all directions.
void light_up(Site& site) {
  constexpr int kTries = 1'000'000, kLit = 3;
  int lit = 0;
  for (const Point3 from : site.references) lit += is_lit(site, from) ? 1 : 0;
  RandomStream random(1);
  for (int i = 0; i < kTries && (lit < kLit || !site.is_lit()); ++i) {
    const float distance = i < kTries / 2 ? 3 : 3000;
    const Point3 from = site.center + distance * warp::sphere_from_square(random.next_2d());
    const LightSample s = site.light->sample(from, random.next_2d());
    if (!(s.pdf > 0) || is_black(s.radiance)) continue;
    site.lit = s;
    if (lit < kLit) site.references.push_back(from), ++lit;
  }
}

Site site_on(TriangleMesh mesh, const Ref<Emitter>& emitter, std::string name,
             std::vector<Point3> references) {
  Site site{.name = std::move(name), .references = std::move(references)};
  site.scene = std::make_unique<const Scene>(
      alone(std::make_shared<const StageShape>(std::move(mesh)), emitter));
  site.light = site.scene->lights()[0].get();
  light_up(site);
  return site;
}

}  // namespace

std::vector<Site> sites_of(const Ref<Emitter>& emitter) {
  std::vector<Site> sites;
  if (emitter->needs_shape()) {
    sites.push_back(site_on(square_mesh({0.2f, 0, 1}, {0.9f, 0, 0.3f}, {0.1f, 0.7f, 0}), emitter,
                            "square", {{0, 0, 3}, {1.5f, 0.5f, 1.5f}, {0.4f, -0.3f, 1.25f}}));
    sites.push_back(site_on(ball_mesh({0, 0, 0}, 1), emitter, "ball",
                            {{0, 0, 4}, {1, 1, -0.2f}, {0.3f, 0, 0}}));
    return sites;
  }
  SceneParts parts = alone(std::make_shared<const StageShape>(ball_mesh({0.5f, 0, 0}, 0.8f)));
  parts.emitters.push_back(emitter);
  Site site{.name = "alone", .references = {{0.1f, 0.2f, -0.15f}, {0.5f, -2, 1}, {-3, 4, 2}}};
  site.scene = std::make_unique<const Scene>(std::move(parts));
  site.light = site.scene->lights()[0].get();
  site.center = site.scene->bounds().center();
  site.radius = 0.5f * site.scene->bounds().diagonal();
  light_up(site);
  sites.push_back(std::move(site));
  return sites;
}

std::string where(const Site& site, Point3 from) {
  return fmt::format("{}, from ({:.4g}, {:.4g}, {:.4g})", site.name, from.x, from.y, from.z);
}

}  // namespace pharos::conformance
