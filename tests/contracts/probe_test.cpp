// Tests of the integrand probe. It uses the same primary random numbers as a sampler.

#include <pharos/sampling/integrand_probe.h>
#include <pharos/sampling/keyed_numbers.h>

#include "furnace.h"

namespace pharos::testing {
namespace {

constexpr Dimension kLight{Purpose::light_position, 1, 0};

/// The numbers that a probe holds fixed, with a given value in one dimension.
class Pinned final : public PreparedSampler {
 public:
  Pinned(Dimension pinned, Vec2 value) : pinned_(pinned), value_(value) {}
  std::uint64_t begin(const PathKey& key) const override { return hash_key(key); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    return keyed_numbers(stream.state(), dimension).x;
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    return dimension == pinned_ ? value_ : keyed_numbers(stream.state(), dimension);
  }

 private:
  Dimension pinned_;
  Vec2 value_;
};

/// A floor under a square light, seen from the side. All light is direct.
const std::string kFloorAndLight = R"(
scene:
  shapes:
    - { type: quad, to_world: [ { scale: [4, 4, 1] }, { rotate: { axis: [1, 0, 0], degrees: -90 } } ], material: { type: diffuse, reflectance: 0.5 } }
    - { type: quad, to_world: [ { scale: 0.5 }, { rotate: { axis: [1, 0, 0], degrees: 90 } }, { translate: [0, 2, 0] } ], material: { type: diffuse, reflectance: 0 }, emitter: { type: area, radiance: 10 } }
  sensor: { type: perspective, fov: 30, to_world: { look_at: { origin: [0, 1, -5], target: [0, 0, 0], up: [0, 1, 0] } } }
film: { width: 16, height: 16, filter: box }
)";

struct Prepared {
  explicit Prepared(const std::string& yaml)
      : loaded(config_from(yaml)),
        scene(loaded.config.scene),
        sensor(scene.sensor().prepare(16, 16)),
        integrator(loaded.config.integrator->prepare({scene, *sensor, 16, 16})) {}

  LoadedConfig loaded;
  Scene scene;
  std::unique_ptr<const PreparedSensor> sensor;
  std::unique_ptr<const PreparedIntegrator> integrator;
};

TEST_CASE("a probed value is what the integrator finds with those numbers") {
  const Prepared p(path_config(kFloorAndLight, 2, "", 1));
  const auto probe = p.integrator->probe();
  REQUIRE(probe != nullptr);
  CHECK(probe->light_branches() == 1);
  const std::vector<Vec2> points{{0.1f, 0.2f}, {0.5f, 0.5f}, {0.9f, 0.3f}, {0.25f, 0.99f}};
  for (const auto& [x, y] : {std::pair{2, 8}, {13, 9}, {3, 10}}) {
    PathKey key{.seed = 3, .index = static_cast<std::uint64_t>(y) * 16 + x};
    std::vector<Rgb> values(points.size());
    probe->evaluate({.x = x, .y = y, .dimension = kLight, .others = key}, points, values);
    // A whole path may also hit the light by its BSDF sample, which is the same for every point.
    // Differences between points therefore come from the light sample only.
    const auto whole = [&](Vec2 light) {
      return mean(p.integrator->replay(key, {Pinned(kLight, light)}).radiance);
    };
    CHECK(mean(values[0]) > 0);
    for (std::size_t i = 1; i < points.size(); ++i) {
      CHECK_FALSE(values[i] == values[0]);
      CHECK(mean(values[i]) - mean(values[0]) ==
            doctest::Approx(whole(points[i]) - whole(points[0])).epsilon(1e-3));
    }
  }
}

TEST_CASE("numbers of other dimensions are probed by whole paths") {
  const Prepared p(path_config(kFloorAndLight, 3, "", 1));
  const auto probe = p.integrator->probe();
  const std::vector<Vec2> points{{0.1f, 0.2f}, {0.5f, 0.5f}, {0.9f, 0.3f}};
  const PathKey key{.seed = 3, .index = 8 * 16 + 2};
  std::vector<Rgb> values(points.size());
  for (const Dimension dimension : {Dimension{Purpose::bsdf_direction, 1}, {Purpose::pixel}}) {
    probe->evaluate({.x = 2, .y = 8, .dimension = dimension, .others = key}, points, values);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Rgb path = p.integrator->replay(key, {Pinned(dimension, points[i])}).radiance;
      CHECK(mean(values[i]) == doctest::Approx(mean(path)).epsilon(1e-5));
    }
  }
}

TEST_CASE("whole paths are the image's, however long") {
  const Prepared p(path_config(kFloorAndLight, 3, "", 1));
  const auto probe = p.integrator->probe();
  const Vec2 u{0.3f, 0.6f};
  for (const std::uint32_t sample : {0u, 1u, 2u}) {
    const PathKey key{.seed = 3, .index = 8 * 16 + 2, .sample = sample};
    for (const Dimension dimension : {kLight, Dimension{Purpose::bsdf_direction, 1}}) {
      const FilmSample path = probe->whole_path(
          {.x = 2, .y = 8, .dimension = dimension, .others = key, .max_depth = 1}, u);
      CHECK(path.radiance == p.integrator->replay(key, {Pinned(dimension, u)}).radiance);
      CHECK(mean(path.radiance) > 0);
      const Vec2 in_pixel = path.film - Vec2{2, 8};
      const Vec2 number = keyed_numbers(hash_key(key), {Purpose::pixel});
      CHECK(in_pixel.x == doctest::Approx(number.x).epsilon(1e-5));
      CHECK(in_pixel.y == doctest::Approx(number.y).epsilon(1e-5));
    }
  }
}

/// Returns the radiance of the first pixel and of the next one, with `spp` samples per pixel.
std::pair<float, float> first_pixels(const std::string& guiding, float left_over, int spp) {
  const std::string sampler = fmt::format("{{ type: stub_probing, left_over: {} }}", left_over);
  const Image image = render(path_config(kFloorAndLight, 2, guiding, spp, sampler)).image;
  return {mean(image.rgb(0, 0)), mean(image.rgb(1, 0))};
}

TEST_CASE("what a sampler has left over counts as one path of its pixel") {
  // No light reaches the first pixels.
  CHECK(first_pixels("", 0, 4) == std::pair{0.0f, 0.0f});
  CHECK(first_pixels("", 10, 4) == std::pair{2.0f, 0.0f});
  const std::string trained =
      "{ learner: stub_direction, guider: stub_direction, training: { iterations: 2, images: "
      "discard } }";
  CHECK(first_pixels(trained, 10, 8) == std::pair{2.0f, 0.0f});
  // Paths of a guided camera are splats. Their pixels have no mean over samples to which a
  // left-over sample could be added.
  CHECK(first_pixels("{ learner: stub_camera, guider: stub_camera }", 10, 8).first < 1);
}

TEST_CASE("what a sampler has left over needs a filter that stays within the pixel") {
  std::string config =
      path_config(kFloorAndLight, 2, "", 1, "{ type: stub_probing, left_over: 1 }");
  const std::string box = "filter: box";
  config.replace(config.find(box), box.size(), "filter: gaussian");
  CHECK_THROWS_WITH_AS(render(config), doctest::Contains("need a film with `filter: box`"),
                       InputError);
}

TEST_CASE("paths longer than is asked for do not count") {
  const Prepared p(path_config(kFloorAndLight, 3, "", 1));
  const auto probe = p.integrator->probe();
  const std::vector<Vec2> points{{0.3f, 0.6f}};
  const auto value = [&](Dimension dimension, std::uint16_t max_depth) {
    std::vector<Rgb> values(1);
    probe->evaluate(
        {.x = 2, .y = 8, .dimension = dimension, .others = {.seed = 3}, .max_depth = max_depth},
        points, values);
    return mean(values[0]);
  };
  // The floor does not emit, so a path needs a second segment to find light.
  for (const Dimension dimension : {kLight, Dimension{Purpose::bsdf_direction, 1}}) {
    CHECK(value(dimension, 1) == 0);
    CHECK(value(dimension, 2) > 0);
  }
  CHECK(value({Purpose::light_position, 1, 1}, 3) == 0);  // there is one branch
}

TEST_CASE("first hits know depth and normal") {
  const Prepared p(path_config(kFloorAndLight, 2, "", 1));
  const auto probe = p.integrator->probe();
  const FirstHit floor = probe->first_hit(8, 8);
  // The pixel's center is half a pixel beside and below the view axis, which descends by 1 over a
  // distance of 5.
  const double half_pixel = std::tan(15 * double{kPi} / 180) / 16;
  const double fall = (1 + 5 * half_pixel) / std::sqrt(26.0);
  CHECK(floor.depth == doctest::Approx(std::sqrt(1 + 2 * half_pixel * half_pixel) / fall));
  CHECK(floor.normal.y == doctest::Approx(1));
  const FirstHit sky = probe->first_hit(0, 0);
  CHECK(std::isinf(sky.depth));
}

TEST_CASE("with all lights every light has a branch of its own") {
  const std::string config = path_config(kDiffuseScene, 2, "", 1);
  const Prepared p(config + "# two lights\n");
  CHECK(p.integrator->probe()->light_branches() == 1);
  LoadedConfig loaded = config_from(kDiffuseScene +
                                    "integrator: { type: path, light_selection: all }\nsampler: "
                                    "independent\nbudget: { spp: 1 }\n");
  const auto all = loaded.config.integrator->prepare({p.scene, *p.sensor, 16, 16});
  const auto probe = all->probe();
  CHECK(probe->light_branches() == 2);
  const std::vector<Vec2> points{{0.3f, 0.6f}, {0.7f, 0.2f}, {0.1f, 0.9f}, {0.6f, 0.4f}};
  std::vector<Rgb> wall(points.size()), ball(points.size());
  const auto evaluate = [&](std::uint16_t branch, std::span<Rgb> values) {
    probe->evaluate(
        {.x = 8, .y = 8, .dimension = {Purpose::light_position, 1, branch}, .others = {.seed = 3}},
        points, values);
  };
  evaluate(0, wall);
  evaluate(1, ball);
  int lit = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    lit += mean(wall[i]) > 0 ? 1 : 0;
    if (!is_black(wall[i])) CHECK_FALSE(wall[i] == ball[i]);
  }
  CHECK(lit > 0);
}

}  // namespace
}  // namespace pharos::testing
