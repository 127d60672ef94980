#include "guide_queries.h"

#include <pharos/conformance/guided.h>
#include <pharos/core/error.h>

namespace pharos::bench {
namespace {

using conformance::Guided;
using conformance::StageVertex;

constexpr int kFilm = 96;
constexpr std::uint16_t kMostBounces = 8;

/// One path from the sensor.
class CameraPath {
 public:
  CameraPath(const Scene& scene, const GuidingFrame& guiding, const PreparedSensor& sensor,
             std::uint64_t path)
      : scene_(scene), guiding_(guiding), random_(1, path) {
    const LensPoint lens = sensor.sample_lens(random_.next_2d());
    ray_ = sensor.ray(lens, random_.next_2d());
    previous_ = {.position = ray_.origin, .normal = lens.normal, .kind = VertexKind::sensor};
  }

  /// Follows the path and adds a query for each vertex where a guide can be asked.
  void add_queries(std::vector<GuideQuery>& queries) {
    for (std::uint16_t bounce = 1; bounce <= kMostBounces; ++bounce) {
      std::unique_ptr<const StageVertex> vertex = next_vertex(bounce);
      if (vertex == nullptr) return;
      GuideQuery query{.vertex = std::move(vertex)};
      const std::optional<Vec3> scattered = scatter(query);
      if (!scattered) return;
      Vec3 direction = *scattered;
      previous_ = query.vertex->query().current;
      const SurfacePoint point = query.vertex->scattering().surface();
      if (is_whole(query)) {
        if (random_.next_1d() < 0.5f) direction = query.guided.direction;
        queries.push_back(std::move(query));
      }
      ray_ = {point.origin_towards(direction), direction};
    }
  }

 private:
  std::unique_ptr<const StageVertex> next_vertex(std::uint16_t bounce) const {
    SurfacePoint hit;
    if (scene_.intersect(ray_, hit) == kInfinity) return nullptr;
    return std::make_unique<const StageVertex>(scene_, previous_, hit, nullptr, false,
                                               -ray_.direction, bounce);
  }

  /// Samples the BSDF. Returns the direction in which the path continues without a guide, or
  /// nothing if the path ends.
  std::optional<Vec3> scatter(GuideQuery& query) {
    const float u_choice = random_.next_1d();
    const auto s = query.vertex->scattering().sample(u_choice, random_.next_2d());
    if (!s || is_black(s->weight)) return std::nullopt;
    if (!is_discrete(s->event)) {
      query.scattered = query.vertex->surface_along(s->direction, s->event);
    }
    return s->direction;
  }

  /// Samples the guide. Returns whether the query is complete.
  bool is_whole(GuideQuery& query) {
    if (query.scattered.event == Event::none) return false;
    const Guided guide(guiding_, *query.vertex);
    const auto drawn = guide.declines() ? std::nullopt : guide.draw(random_);
    if (!drawn || is_discrete(drawn->event)) return false;
    query.guided = *drawn;
    return true;
  }

  const Scene& scene_;
  const GuidingFrame& guiding_;
  RandomStream random_;
  Ray ray_;
  GuidingVertex previous_;
};

}  // namespace

std::vector<GuideQuery> guide_queries(const Scene& scene, const GuidingFrame& guiding,
                                      std::size_t count) {
  const auto sensor = scene.sensor().prepare(kFilm, kFilm);
  std::vector<GuideQuery> queries;
  for (std::uint64_t path = 0; queries.size() < count; ++path) {
    if (path > 100 * count) throw RunError("the guide has too few answers to be measured");
    CameraPath(scene, guiding, *sensor, path).add_queries(queries);
  }
  queries.resize(count);
  return queries;
}

}  // namespace pharos::bench
