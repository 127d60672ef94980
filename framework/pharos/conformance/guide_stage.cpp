#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pharos/conformance/guide_stage.h>
#include <pharos/conformance/stage.h>
#include <pharos/core/random.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::conformance {
namespace {

constexpr int kFilm = 16;
constexpr float kFogDensity = 0.4f;
const Point3 kSensor{-0.3f, 0.1f, -0.85f};

SceneObject object_of(TriangleMesh mesh, Ref<Bsdf> bsdf, Ref<Emitter> emitter) {
  return {std::make_shared<const StageShape>(std::move(mesh)), std::move(bsdf), std::move(emitter),
          nullptr, nullptr};
}

/// Returns the integrator's settings with the pair as its guiding.
ConfigNode guided_node(const std::string& integrator, const GuidedPair& pair) {
  ConfigNode training = ConfigNode::mapping();
  training.set("iterations", ConfigNode::scalar("3"));
  ConfigNode guiding = ConfigNode::mapping();
  guiding.set("learner", pair.learner.node);
  guiding.set("guider", pair.guider.node);
  guiding.set("training", std::move(training));
  ConfigNode node = ConfigNode::mapping();
  node.set("type", ConfigNode::scalar(integrator));
  node.set("guiding", std::move(guiding));
  return node;
}

LocalScattering scattering_at(const Scene& scene, const SurfacePoint& point, const Medium* medium,
                              bool in_medium, Vec3 towards_previous, Transport transport) {
  if (!in_medium) return {point, scene.bsdf(point), towards_previous, transport};
  return {medium->phase_function(), medium->scattering(point.position), towards_previous,
          transport};
}

double image_mean(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += mean(image.rgb(x, y));
  }
  return sum / (static_cast<double>(image.width()) * image.height());
}

/// Traces one path through a scene, vertex by vertex.
class Walk {
 public:
  Walk(const Scene& scene, std::uint64_t seed, std::uint64_t path, Transport transport)
      : scene_(scene), random_(seed, path), transport_(transport), medium_(scene.sensor_medium()) {}

  /// Returns the next vertex; null if the path ends.
  std::unique_ptr<const StageVertex> next() {
    const bool first = last_ == nullptr;
    Ray ray{kSensor, normalize({random_.next_1d() - 0.5f, random_.next_1d() - 0.5f, 1})};
    GuidingVertex previous{.position = kSensor, .kind = VertexKind::sensor};
    if (!first) {
      const float u_choice = random_.next_1d();
      const auto s = last_->scattering().sample(u_choice, random_.next_2d());
      if (!s) return nullptr;
      previous = last_->query().current;
      if (transport_ == Transport::radiance) previous.event = s->event;
      ray = {last_on_surface_ ? point_.origin_towards(s->direction) : point_.position,
             s->direction};
    }
    SurfacePoint hit;
    ray.t_max = scene_.intersect(ray, hit);
    if (ray.t_max == kInfinity) return nullptr;
    bool in_medium = false;
    if (medium_ != nullptr) {
      const DistanceSample stop =
          medium_->sample(ray, channel_shares(Rgb(1)), 0, random_.next_1d());
      in_medium = stop.scattered;
      if (in_medium) hit = {.position = ray.at(stop.t)};
    }
    point_ = hit;
    last_on_surface_ = !in_medium;
    // If paths are made from both ends, the number of the vertex is unknown.
    const std::uint16_t bounce = transport_ == Transport::radiance ? ++bounce_ : 0;
    auto vertex = std::make_unique<const StageVertex>(scene_, previous, hit, medium_, in_medium,
                                                      -ray.direction, bounce, transport_);
    last_ = vertex.get();
    return vertex;
  }

 private:
  const Scene& scene_;
  RandomStream random_;
  Transport transport_;
  const Medium* medium_;
  const StageVertex* last_ = nullptr;
  SurfacePoint point_;
  bool last_on_surface_ = true;
  std::uint16_t bounce_ = 0;
};

}  // namespace

SceneParts room_parts(Room room, bool foggy) {
  const Ref<Emitter> shine = room == Room::furnace ? glow(1) : nullptr;
  const Ref<Bsdf> matt = matt_bsdf(0.5f);
  SceneParts parts;
  parts.objects.push_back(object_of(room_mesh(), matt, shine));
  parts.objects.push_back(object_of(ball_mesh({0.4f, -0.3f, 0.3f}, 0.3f), matt, shine));
  parts.objects.push_back(object_of(
      square_mesh({-0.4f, -0.2f, 0.4f}, {0.35f, 0, 0.1f}, {0, 0.4f, 0}), half_mirror(), nullptr));
  if (room == Room::lamp) {
    const Vec3 u{0.15f, 0, 0}, v{0, 0, 0.15f};  // u x v points down
    parts.objects.push_back(object_of(square_mesh({0.5f, 0.9f, 0}, u, v), black_bsdf(), glow(20)));
  }
  parts.sensor = pinhole(kSensor);
  if (foggy) parts.medium = fog(kFogDensity);
  return parts;
}

std::vector<std::string> integrator_names(const Registry& registry) {
  std::vector<std::string> names = registry.names(Integrator::contract_name);
  try {
    const auto first =
        build_plugin<Integrator>(registry, ConfigNode::scalar("default"))->plugin_name();
    std::stable_partition(names.begin(), names.end(),
                          [&](const std::string& name) { return name == first; });
  } catch (const InputError&) {  // there is no default
  }
  return names;
}

std::vector<Ref<Integrator>> integrators_for(const GuidedPair& pair, std::string& why_not) {
  why_not = "no integrator is loaded";
  std::vector<Ref<Integrator>> all;
  for (const std::string& name : integrator_names(pair.registry)) {
    try {
      auto integrator = build_plugin<Integrator>(pair.registry, guided_node(name, pair));
      if (!integrator->traits().guided || integrator->guiding() == nullptr) continue;
      check_compatible(*integrator, *pinhole(kSensor));
      all.push_back(std::move(integrator));
    } catch (const InputError& e) {
      why_not = e.what();
    }
  }
  return all;
}

Ref<Integrator> unguided(const GuidedPair& pair, const Integrator& guided) {
  return build_plugin<Integrator>(pair.registry, ConfigNode::scalar(guided.plugin_name()));
}

RenderResult render_room(const Registry& registry, const Ref<Integrator>& integrator, Room room,
                         bool foggy, std::uint32_t samples, std::uint64_t seed) {
  const ConfigNode by_default = ConfigNode::scalar("default");
  RenderConfig config;
  config.scene = room_parts(room, foggy);
  config.film.width = config.film.height = kFilm;
  config.film.filter = build_plugin<Filter>(registry, by_default);
  config.sampler = build_plugin<Sampler>(registry, by_default);
  config.integrator = integrator;
  config.budget.spp = samples;
  config.seed = seed;
  return RenderJob(config).run();
}

void compare_in_furnace(const Registry& registry, const Rendering& a, const Rendering& b,
                        bool foggy, std::uint64_t seed, Check& check) {
  constexpr std::uint64_t kRuns = 8;
  // Allows for single precision and for what guiding leaves unexplored.
  constexpr double kSlack = 3e-4;
  const auto mean_of = [&](const Rendering& rendering, std::uint64_t first_seed) {
    std::vector<double> means;
    for (std::uint64_t run = 0; run < kRuns; ++run) {
      means.push_back(image_mean(
          render_room(registry, rendering.integrator, Room::furnace, foggy, 32, first_seed + run)
              .image));
    }
    statistics::Estimate mean = statistics::estimate(statistics::moments(means));
    mean.squared_error += square(kSlack * mean.mean);
    return mean;
  };
  const statistics::Estimate x = mean_of(a, seed), y = mean_of(b, seed + kRuns);
  check.add_p_value(
      statistics::welch_test(x, y).p_value,
      fmt::format("{}: {} {:.5f} +- {:.5f}, {} {:.5f} +- {:.5f}",
                  foggy ? "in fog" : "in empty space", a.name, x.mean, std::sqrt(x.squared_error),
                  b.name, y.mean, std::sqrt(y.squared_error)));
}

StageVertex::StageVertex(const Scene& scene, const GuidingVertex& previous,
                         const SurfacePoint& point, const Medium* medium, bool in_medium,
                         Vec3 towards_previous, std::uint16_t bounce, Transport transport)
    : scene_(scene),
      previous_(previous),
      point_(point),
      medium_(medium),
      scattering_(scattering_at(scene, point_, medium, in_medium, towards_previous, transport)),
      query_{.previous = &previous_,
             .current = {.position = point.position,
                         .normal = in_medium ? Vec3{} : point.normal,
                         .shading_normal = in_medium ? Vec3{} : point.shading.n,
                         .kind = in_medium ? VertexKind::volume : VertexKind::surface,
                         .roughness = scattering_.roughness()},
             .towards_previous = towards_previous,
             .transport = transport,
             .bounce = bounce,
             .scattering = &scattering_,
             .medium = medium} {}

Ray StageVertex::ray_towards(Vec3 direction) const {
  return {scattering_.is_surface() ? point_.origin_towards(direction) : point_.position, direction};
}

ResolvedVertex StageVertex::surface_along(Vec3 direction, Event event) const {
  SurfacePoint hit;
  const Ray ray = ray_towards(direction);
  const float distance = scene_.intersect(ray, hit);
  ResolvedVertex vertex{.direction = direction,
                        .distance = distance,
                        .position = hit.position,
                        .kind = VertexKind::surface,
                        .event = event};
  if (distance == kInfinity) {
    vertex.kind = VertexKind::environment;
    vertex.position = scene_.environment_point(ray.origin, direction);
  }
  if (medium_ != nullptr)
    vertex.medium_density = medium_->leg(ray, channel_shares(Rgb(1)), distance).pass_probability;
  return vertex;
}

std::string StageVertex::text() const {
  const Point3 p = query_.current.position;
  const char* whose = query_.transport == Transport::radiance ? "" : "light path, ";
  return fmt::format("{}bounce {} {} at ({:.3g}, {:.3g}, {:.3g})", whose, query_.bounce,
                     !scattering_.is_surface()       ? "in fog"
                     : scattering_.purely_discrete() ? "on the half mirror"
                                                     : "on a matt surface",
                     p.x, p.y, p.z);
}

std::vector<std::unique_ptr<const StageVertex>> stage_vertices(const Scene& scene,
                                                               std::uint64_t seed,
                                                               Transport transport) {
  constexpr int kOfEachKind = 2;
  int found[2][3] = {};  // by bounce and by kind: fog, mirror, matte
  std::vector<std::unique_ptr<const StageVertex>> all;
  for (std::uint64_t path = 0; path < 400; ++path) {
    Walk walk(scene, seed, path, transport);
    std::vector<std::unique_ptr<const StageVertex>> vertices;
    for (int bounce = 0; bounce < 2; ++bounce) {
      auto vertex = walk.next();
      if (vertex == nullptr) break;
      vertices.push_back(std::move(vertex));
    }
    for (std::size_t bounce = 0; bounce < vertices.size(); ++bounce) {
      const LocalScattering& s = vertices[bounce]->scattering();
      int& count = found[bounce][!s.is_surface() ? 0 : s.purely_discrete() ? 1 : 2];
      if (count++ < kOfEachKind) all.push_back(std::move(vertices[bounce]));
    }
  }
  return all;
}

}  // namespace pharos::conformance
