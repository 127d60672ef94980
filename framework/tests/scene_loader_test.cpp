#include <doctest/doctest.h>

#include <pharos/scene/scene_loader.h>

#include "fixtures.h"
#include "scene_fixtures.h"

namespace pharos {
namespace {

class Grey : public Texture {
 public:
  struct Settings {
    float value = 0.5f;
    static void describe(Schema<Settings>& s) { s.field("value", &Settings::value, "Value"); }
  };
  explicit Grey(Settings settings) : value_(settings.value) {}
  Rgb evaluate(const SurfacePoint&) const override { return Rgb(value_); }
  float maximum() const override { return value_; }
  Rgb average() const override { return Rgb(value_); }

 private:
  float value_;
};

/// Black, yet it has a texture to show.
class Painted : public test::BlackBsdf {
 public:
  struct Settings {
    Ref<Texture> reflectance = {};
    static void describe(Schema<Settings>& s) {
      s.field("reflectance", &Settings::reflectance, "Colour").otherwise("0.5");
    }
  };
  explicit Painted(Settings settings) : texture_(std::move(settings.reflectance)) {}
  const Texture& texture() const { return *texture_; }

 private:
  Ref<Texture> texture_;
};

class Square : public test::MeshShape {
 public:
  struct Settings {
    float height = 0;
    static void describe(Schema<Settings>& s) { s.field("height", &Settings::height, "Height"); }
  };
  explicit Square(Settings settings) : MeshShape(test::square_at(settings.height)) {}
};

template <bool on_shape>
class Shiner : public test::PlacedEmitter {
 public:
  using Settings = NoSettings;
  explicit Shiner(Settings) : PlacedEmitter(on_shape) {}
};

class Eye : public test::PointSensor {
 public:
  using Settings = NoSettings;
  explicit Eye(Settings) : PointSensor({}) {}
};

const Registry& registry() {
  static const Registry all = [] {
    Registry r;
    r.add<Grey>("constant", "");
    r.set_shorthand<Texture>("constant", "value");
    r.add<Painted>("diffuse", "");
    r.set_default<Bsdf>("diffuse");
    r.add<Square>("square", "");
    r.add<Shiner<true>>("area", "");
    r.add<Shiner<false>>("sky", "");
    r.add<Eye>("eye", "");
    r.add<test::ClearMedium>("clear", "");
    return r;
  }();
  return all;
}

struct Loaded {
  SceneParts parts;
  ConfigNode resolved;
};

Loaded load(const ConfigNode& node) {
  BuildContext context{registry()};
  Loaded loaded;
  loaded.parts = Value<SceneParts>::read(node, context, loaded.resolved);
  return loaded;
}

Loaded load(const std::string& yaml) {
  return load(parse_yaml(yaml, "scene.yaml"));
}

void check_error(const std::string& yaml, const std::string& expected) {
  const std::string message = test::input_error([&] { load(yaml); });
  INFO(message);
  CHECK(message.find(expected) != std::string::npos);
}

float reflectance(const SceneObject& object) {
  return dynamic_cast<const Painted&>(*object.bsdf).texture().average().r;
}

const char* const kEverything =
    "textures: { dark: 0.25 }\n"
    "materials:\n"
    "  wall: { type: diffuse, reflectance: dark }\n"
    "  same: wall\n"
    "media: { fog: clear }\n"
    "shapes:\n"
    "  - { type: square, height: 3, material: wall, interior: fog, exterior: clear }\n"
    "  - { type: square, emitter: area }\n"
    "  - { type: square, material: { type: diffuse, reflectance: 0.75 } }\n"
    "  - square\n"
    "emitters: [ sky ]\n"
    "sensor: eye\n"
    "medium: fog\n";

TEST_CASE("all parts of a scene are read") {
  const SceneParts parts = load(kEverything).parts;
  REQUIRE(parts.objects.size() == 4);
  CHECK(parts.objects[0].shape->bounds().low.z == 3);
  CHECK(reflectance(parts.objects[0]) == 0.25f);
  CHECK(parts.objects[0].interior == parts.medium);
  CHECK(parts.objects[0].exterior != nullptr);
  CHECK(parts.objects[0].exterior != parts.medium);
  CHECK(parts.objects[0].emitter == nullptr);
  CHECK(parts.objects[1].emitter != nullptr);
  CHECK(parts.objects[1].interior == nullptr);
  CHECK(reflectance(parts.objects[1]) == 0.5f);  // the default material
  CHECK(reflectance(parts.objects[2]) == 0.75f);
  CHECK(reflectance(parts.objects[3]) == 0.5f);
  CHECK(parts.emitters.size() == 1);
  CHECK(parts.sensor != nullptr);
  const Scene scene(parts);
  CHECK(scene.lights().size() == 2);
  CHECK(scene.has_media());
}

TEST_CASE("the resolved scene states everything and reads as the same scene") {
  const Loaded first = load(kEverything);
  const std::string text = to_yaml(first.resolved);
  INFO(text);
  CHECK(text.find("reflectance: dark") != std::string::npos);
  const ConfigNode* shapes = first.resolved.find("shapes");
  REQUIRE(shapes != nullptr);
  CHECK(shapes->items()[1].entries()[0].key == "type");
  CHECK(shapes->items()[1].find("height")->text() == "0");
  CHECK(shapes->items()[3].find("material")->find("type")->text() == "diffuse");
  const Loaded second = load(text);
  CHECK(to_yaml(second.resolved) == text);
  CHECK(reflectance(second.parts.objects[0]) == 0.25f);
}

TEST_CASE("a scene may lack any part") {
  const SceneParts parts = load("shapes: []\nsensor: null\n").parts;
  CHECK(parts.objects.empty());
  CHECK(parts.sensor == nullptr);
  CHECK(parts.medium == nullptr);
  CHECK(load("{}").parts.emitters.empty());
}

TEST_CASE("names belong to one scene and shadow nothing in the next") {
  BuildContext context{registry()};
  ConfigNode resolved;
  const auto read = [&](const char* yaml) {
    return Value<SceneParts>::read(parse_yaml(yaml, "scene.yaml"), context, resolved);
  };
  read("materials: { wall: { type: diffuse, reflectance: 0.1 } }");
  const SceneParts second = read(
      "materials: { wall: { type: diffuse, reflectance: 0.9 } }\n"
      "shapes: [ { type: square, material: wall } ]");
  CHECK(reflectance(second.objects[0]) == 0.9f);
}

TEST_CASE("a path stands for the scene in that file, relative to the file that says so") {
  const test::TemporaryFolder folder;
  folder.write("base.yaml", "shapes: [ square ]\nsensor: eye\n");
  folder.write("scene.yaml", "extends: base.yaml\nemitters: [ sky ]\n");
  const auto config = folder.write("config.yaml", "scene: scene.yaml\n");
  const Loaded loaded = load(*read_yaml(config).find("scene"));
  CHECK(loaded.parts.objects.size() == 1);
  CHECK(loaded.parts.emitters.size() == 1);
  CHECK(loaded.resolved.is_mapping());

  const auto wrong = folder.write("wrong.yaml", "\nscene: absent.yaml\n");
  const std::string message =
      test::input_error_in(folder, [&] { load(*read_yaml(wrong).find("scene")); });
  CHECK(message == "wrong.yaml:2:8: error: there is no scene file 'absent.yaml'");
}

TEST_CASE("what does not fit together is an error with its place") {
  check_error("shape: []", "scene.yaml:1:1: error: unknown key 'shape'");
  check_error("shape: []", "'shapes'");
  check_error("type: scene", "unknown key 'type'");
  check_error("[ square ]", "scene.yaml:1:1");
  check_error("shapes: { type: square }", "a list of shapes");
  check_error("materials: [ diffuse ]", "a mapping from names to bsdf");
  check_error("shapes:\n  - { type: square, materiel: wall }", "scene.yaml:2:21");
  check_error("shapes:\n  - { type: square, materiel: wall }", "did you mean 'material'?");
  check_error("shapes:\n  - { type: square, hight: 1 }", "did you mean 'height'?");
  check_error("shapes: [ { type: sqare } ]", "did you mean 'square'?");
  check_error("shapes: [ { height: 1 } ]", "'type'");
  check_error("shapes: [ { type: square, material: wal } ]\nmaterials: { wall: diffuse }",
              "did you mean 'wall'?");
  check_error("shapes:\n- { type: square, emitter: sky }", "scene.yaml:2:28");
  check_error("shapes:\n- { type: square, emitter: sky }", "stands alone");
  check_error("emitters: [ area ]", "scene.yaml:1:13: error: this emitter needs a shape");
  check_error("textures: { a: b }", "unknown texture 'b'");
}

}  // namespace
}  // namespace pharos
