#include <doctest/doctest.h>

#include <pharos/scene/scene_loader.h>

#include "fixtures.h"
#include "scene_fixtures.h"

namespace pharos {
namespace {

class Gray : public Texture {
 public:
  struct Settings {
    float value = 0.5f;
    static void describe(Schema<Settings>& s) { s.field("value", &Settings::value, "Value"); }
  };
  explicit Gray(Settings settings) : value_(settings.value) {}
  Rgb value_at(const SurfacePoint&) const override { return Rgb(value_); }
  Rgb maximum() const override { return Rgb(value_); }
  Rgb average() const override { return Rgb(value_); }

 private:
  float value_;
};

/// A black BSDF that has a texture.
class Painted : public test::BlackBsdf {
 public:
  struct Settings {
    Ref<Texture> reflectance = {};
    static void describe(Schema<Settings>& s) {
      s.field("reflectance", &Settings::reflectance, "Color").otherwise("0.5");
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
    r.add<Gray>("constant", "");
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

const char* const kGroups =
    "shapes:\n"
    "  - { type: instance, group: row, to_world: { translate: [0, 0, 5] } }\n"
    "  - square\n"
    "  - { type: instance, group: tile, to_world: { scale: 2 } }\n"
    "groups:\n"
    "  row:\n"
    "    - { type: instance, group: tile, to_world: { translate: [4, 0, 0] } }\n"
    "    - { type: square, height: 7 }\n"
    "    - { type: instance, group: nothing }\n"
    "  unused: [ square, { type: instance, group: row } ]\n"
    "  tile: [ { type: square, height: 1, material: wall, interior: clear } ]\n"
    "  nothing: []\n"
    "materials: { wall: { type: diffuse, reflectance: 0.25 } }\n";

/// Returns the messages of all errors of a scene.
std::vector<std::string> flaws_of(const std::string& text) {
  std::vector<std::string> messages;
  try {
    load(text);
  } catch (const InputErrors& errors) {
    for (const InputError& error : errors.all()) messages.emplace_back(error.what());
  } catch (const InputError& error) {
    messages.emplace_back(error.what());
  }
  return messages;
}

TEST_CASE("all errors of a scene are found at once") {
  const std::vector<std::string> flaws = flaws_of(
      "materials:\n"
      "  dark: { type: diffuse, reflectance: no-such }\n"
      "shapes:\n"
      "  - { type: square, height: tall, material: dark }\n"
      "  - { type: square, material: dark }\n"
      "  - { type: square, emitter: sky }\n"
      "groups: { a: [ squar ] }\n"
      "emitters: [ area ]\n"
      "sensor: ey\n");
  INFO(flaws.size());
  REQUIRE(flaws.size() == 6);  // `dark` counts once, and not again where it is used
  const char* places[] = {":2:39:", ":7:16:", ":4:29:", ":6:30:", ":8:13:", ":9:9:"};
  for (std::size_t i = 0; i < flaws.size(); ++i) {
    CAPTURE(flaws[i]);
    CHECK(flaws[i].find(places[i]) != std::string::npos);
  }
}

TEST_CASE("all wrong keys of a mapping, or else all wrong values, are found at once") {
  CHECK(flaws_of("shapes: [ { type: square, heigh: tall, colour: 1 } ]").size() == 2);
  CHECK(flaws_of("shapes: 3\nshape: 4\nsensors: eye").size() == 2);
}

TEST_CASE("a section of the wrong type hides no error of the others") {
  CHECK(flaws_of("materials: { dark: no-such }\nshapes: 3\nemitters: {}\nsensor: ey").size() == 4);
  CHECK(flaws_of("shapes: [ { type: instance, group: a }, { type: instance, group: b } ]").size() ==
        2);
}

TEST_CASE("instances are read, nested ones flattened, and groups that nobody sees left out") {
  const SceneParts parts = load(kGroups).parts;
  CHECK(parts.objects.size() == 1);
  REQUIRE(parts.groups.size() == 2);  // in the order in which the loader meets them
  REQUIRE(parts.instances.size() == 3);
  CHECK(parts.groups[0].objects[0].shape->bounds().low.z == 7);
  CHECK(reflectance(parts.groups[1].objects[0]) == 0.25f);
  CHECK(parts.groups[1].objects[0].interior != nullptr);
  CHECK(parts.instances[0].group == 0);
  CHECK(parts.instances[0].to_world.point({1, 0, 0}) == Point3{1, 0, 5});
  CHECK(parts.instances[1].group == 1);
  CHECK(parts.instances[1].to_world.point({1, 0, 0}) == Point3{5, 0, 5});
  CHECK(parts.instances[2].group == 1);
  CHECK(parts.instances[2].to_world.point({1, 0, 0}) == Point3{2, 0, 0});
  const Scene scene(parts);
  CHECK(scene.has_media());
  SurfacePoint p;
  CHECK(scene.intersect({{4.5f, 0, 100}, {0, 0, -1}}, p) == doctest::Approx(94));
  CHECK(reflectance(scene.objects()[p.object]) == 0.25f);
}

TEST_CASE("the maps of nested instances compose from the inside out") {
  const SceneParts parts =
      load(
          "groups:\n"
          "  a: [ square ]\n"
          "  b: [ { type: instance, group: a, to_world: { translate: [1, 2, 3] } } ]\n"
          "  c: [ { type: instance, group: b, to_world: { scale: [2, 3, -4] } } ]\n"
          "shapes: [ { type: instance, group: c, "
          "to_world: { rotate: { axis: [0, 0, 1], degrees: 90 } } } ]\n")
          .parts;
  REQUIRE(parts.instances.size() == 1);
  CHECK(parts.instances[0].to_world.point({1, 1, 1}) == Point3{-9, 4, -16});
}

TEST_CASE("the resolved scene states groups and instances and reads as the same scene") {
  const Loaded first = load(kGroups);
  const std::string text = to_yaml(first.resolved);
  INFO(text);
  const ConfigNode* shapes = first.resolved.find("shapes");
  REQUIRE(shapes != nullptr);
  CHECK(shapes->items()[0].find("type")->text() == "instance");
  CHECK(shapes->items()[0].find("group")->text() == "row");
  CHECK(shapes->items()[0].find("to_world")->find("matrix") != nullptr);
  CHECK(first.resolved.find("groups")->find("unused")->items().size() == 2);
  const Loaded second = load(text);
  CHECK(to_yaml(second.resolved) == text);
  CHECK(second.parts.instances.size() == 3);
  CHECK(second.parts.instances[1].to_world.matrix() == first.parts.instances[1].to_world.matrix());
}

TEST_CASE("groups and instances that cannot be are errors with their place") {
  const auto instance = [](const std::string& rest) {
    return "groups: { a: [ square ], b: [] }\nshapes:\n- { type: instance, " + rest + " }\n";
  };
  check_error(instance("group: a, to_world: { scale: [1, 0, 1] }"), "scene.yaml:3:41");
  check_error(instance("group: a, to_world: { scale: [1, 0, 1] }"), "cannot be inverted");
  check_error(instance("group: aa"),
              "scene.yaml:3:28: error: unknown group 'aa' (did you mean 'a'?)");
  check_error(instance("grop: a"), "did you mean 'group'?");
  check_error(instance("to_world: { scale: 1 }"), "'group'");
  check_error(instance("group: a, material: wall"),
              "scene.yaml:3:31: error: an instance has no 'material'");
  check_error(instance("group: a, emitter: area"), "state it in the group's entries");
  check_error(instance("group: [ a ]"), "scene.yaml:3:28");
  check_error(instance("group: a, to_world: { scale: 1e-13 }"), "beyond what a float can hold");
  check_error(instance("group: a, to_world: { translate: [1, 2, 1e39] }"), "scene.yaml:3");
  check_error("groups: [ square ]", "a mapping from names to lists of shapes");
  check_error("groups: { a: square }", "scene.yaml:1:14: error: expected a list of shapes");
  check_error("groups: { a: [ { type: square, emitter: area } ] }",
              "scene.yaml:1:32: error: an emitter cannot stand in a group");
  check_error("groups: { a: [ { type: instance, group: b } ] }", "unknown group 'b'");
}

TEST_CASE("groups that contain themselves are named, used or not") {
  check_error("groups: { a: [ { type: instance, group: a } ] }",
              "scene.yaml:1:41: error: groups go in a circle: 'a' contains 'a'");
  check_error(
      "groups:\n"
      "  x: [ { type: instance, group: a } ]\n"
      "  a: [ square, { type: instance, group: b } ]\n"
      "  b: [ { type: instance, group: c } ]\n"
      "  c: [ { type: instance, group: a } ]\n",
      "scene.yaml:5:33: error: groups go in a circle: 'a' contains 'b' contains 'c' contains 'a'");
}

/// Returns a scene of `levels` groups. Each group holds two instances of the next group, and the
/// last group holds `last`.
std::string doubling(int levels, const std::string& last, bool outermost_first) {
  std::string text;
  for (int i = 0; i < levels; ++i) {
    const std::string next = "{ type: instance, group: g" + std::to_string(i + 1) + " }";
    const std::string group =
        "  g" + std::to_string(i) + ": [ " + (i + 1 < levels ? next + ", " + next : last) + " ]\n";
    text = outermost_first ? text + group : group + text;
  }
  return "groups:\n" + text + "shapes: [ { type: instance, group: g0 } ]\n";
}

TEST_CASE("instances that multiply beyond measure are refused, empty ones cost nothing") {
  CHECK(load(doubling(11, "square", true)).parts.instances.size() == 1024);
  CHECK(load(doubling(64, "", true)).parts.instances.empty());
  check_error(doubling(26, "square", true), "makes more than 4194304 instances");
  check_error(doubling(64, "square", false), "makes more than 4194304 instances");
  check_error(doubling(65, "square", true), "nested more than 64 levels deep");
  check_error(doubling(65, "square", false), "nested more than 64 levels deep");
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
  CHECK(message ==
        "wrong.yaml:2:8: error: the scene 'absent.yaml': no such file (did you mean 'base.yaml'?)");
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
