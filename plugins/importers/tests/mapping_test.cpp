// The scene as a whole: names, notes, errors and locations.
#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "mapping_test_kit.h"

namespace pharos::mitsuba::test {
namespace {

using Messages = std::vector<std::string>;

/// Returns the error message from importing `contents`.
std::string error_of(const std::vector<ObjectRef>& contents) {
  try {
    import_of(contents);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("mapping: an id is a material's name, and two shapes share it") {
  const ObjectRef red = bsdf("diffuse", {value("reflectance", rgb(1, 0, 0))}, "Red");
  const Import import =
      import_of({red, shape("rectangle", {nested(red)}), shape("cube", {nested(red)})});
  CHECK(part(import, "scene.materials") == "{ Red: { type: diffuse, reflectance: [1, 0, 0] } }");
  CHECK(part(import, "scene.shapes.0.material") == "Red");
  CHECK(part(import, "scene.shapes.1.material") == "Red");
  const LoadedConfig config = built(import);
  REQUIRE(config.config.scene.objects.size() == 2);
  CHECK(config.config.scene.objects[0].bsdf == config.config.scene.objects[1].bsdf);
}

TEST_CASE("mapping: all objects with errors are found at once, each error once") {
  const ObjectRef wrong = object("bsdf", "difuse", {}, "Red", 3);
  try {
    import_of({shape("rectangle", {nested(wrong)}), shape("cube", {nested(wrong)}),
               object("shape", "qube", {}, {}, 7), object("emitter", "pont", {}, {}, 8)});
    FAIL("nothing was thrown");
  } catch (const InputErrors& errors) {
    REQUIRE(errors.all().size() == 3);
    CHECK(errors.all()[0].where().line == 3);
    CHECK(errors.all()[1].where().line == 7);
    CHECK(errors.all()[2].where().line == 8);
  }
}

TEST_CASE("mapping: ids that cannot be names are made such, each of its own") {
  const auto with = [](const char* id) { return shape("cube", {nested(bsdf("diffuse", {}, id))}); };
  const Import import =
      import_of({with("my wood"), with("my.wood"), with("null"), with("12"), with("default")});
  const char* names[] = {"my_wood", "my_wood_2", "material_null", "material_12",
                         "material_default"};
  for (int i = 0; i < 5; ++i) {
    CHECK(part(import, "scene.shapes." + std::to_string(i) + ".material") == names[i]);
  }
  CHECK(built(import).config.scene.objects.size() == 5);
}

TEST_CASE("mapping: materials stand after those that they are made of") {
  const ObjectRef inner = bsdf("diffuse", {}, "inner");
  const ObjectRef outer = bsdf("twosided", {nested(inner)}, "outer");
  const Import import = import_of({outer, inner, shape("cube", {nested(outer)})});
  CHECK(part(import, "scene.materials") ==
        "{ inner: { type: diffuse, reflectance: 0.5 }, outer: { type: two_sided, bsdf: inner } }");
  CHECK(built(import).config.scene.objects.size() == 1);
}

TEST_CASE("mapping: what is left out is noted once a kind, with how often and where first") {
  const ObjectRef odd = shape("sphere", {value("subdiv", std::int64_t{200}, 7)});
  const Import import = import_of({odd, odd, shape("cube", {value("subdiv", std::int64_t{2}, 9)})});
  CHECK(notes(import) == Messages{"the scene has no sensor", "shape sphere: 'subdiv' is left out",
                                  "shape cube: 'subdiv' is left out"});
  CHECK(import.notes[1].times == 2);
  CHECK(import.notes[1].where.to_string() == "scene.xml:7:5");
  CHECK(import.notes[2].times == 1);
}

TEST_CASE("mapping: objects that are left out are noted") {
  const Import import = import_of({shape("sphere", {nested(object("subsurface", "dipole"))})});
  CHECK(notes(import)[1] == "shape sphere: the subsurface 'dipole' in it is left out");
}

TEST_CASE("mapping: unknown types, with the nearest one") {
  CHECK(error_of({object("shape", "rectangel", {}, "", 4)})
            .starts_with("scene.xml:4:3: error: unknown shape 'rectangel' (did you mean "
                         "'rectangle'?); known: "));
  CHECK(error_of({shape("cube", {nested(bsdf("difuse"))})}).find("did you mean 'diffuse'?") !=
        std::string::npos);
  CHECK(error_of({emitter("pont")}).find("did you mean 'point'?") != std::string::npos);
  CHECK(error_of({object("sensor", "perspectiv")}).find("did you mean 'perspective'?") !=
        std::string::npos);
}

TEST_CASE("mapping: what has no counterpart is refused by name") {
  CHECK(error_of({shape("hair")}) ==
        "scene.xml:1:3: error: shape 'hair' has no counterpart in Pharos");
  CHECK(error_of({shape("cube", {nested(bsdf("irawan"))})}) ==
        "scene.xml:1:3: error: bsdf 'irawan' has no counterpart in Pharos");
  CHECK(error_of({emitter("collimated")}) ==
        "scene.xml:1:3: error: emitter 'collimated' has no counterpart in Pharos");
  CHECK(error_of({emitter("area")}) ==
        "scene.xml:1:3: error: emitter 'area' needs a shape to stand in");
  CHECK(error_of({shape("cube", {nested(emitter("point"))})}) ==
        "scene.xml:1:3: error: emitter 'point' cannot stand in a shape");
}

TEST_CASE("mapping: properties of the wrong kind, where they stand") {
  CHECK(error_of({shape("sphere", {value("radius", "wide", 6)})}) ==
        "scene.xml:6:5: error: 'radius' must be a number");
  CHECK(error_of({shape("sphere", {value("center", 1.5, 6)})}) ==
        "scene.xml:6:5: error: 'center' must be a point or vector");
  CHECK(error_of({shape("cube", {value("to_world", 1.5, 6)})}) ==
        "scene.xml:6:5: error: 'to_world' must be a transform");
  CHECK(error_of({shape("cube", {value("flip_normals", 1.5, 6)})}) ==
        "scene.xml:6:5: error: 'flip_normals' must be true or false");
  CHECK(error_of({shape("obj")}) == "scene.xml:1:3: error: shape obj: 'filename' is missing");
}

TEST_CASE("mapping: errors of the scene's parts name the place in the scene file") {
  const Import import = import_of({shape("sphere", {value("radius", -1.0, 12)})});
  CHECK_THROWS_WITH_AS(built(import), "scene.xml:12:5: error: radius must be > 0, got -1",
                       InputError);
}

TEST_CASE("mapping: chains of references end in an error, not in the stack") {
  ObjectRef chain = bsdf("diffuse");
  for (int i = 0; i < 5000; ++i) chain = bsdf("twosided", {nested(chain)}, "m" + std::to_string(i));
  CHECK(error_of({shape("cube", {nested(chain)})}) ==
        "scene.xml:1:3: error: objects are nested deeper than 64 levels");
}

TEST_CASE("mapping: files are named relative to where they are named") {
  const Import import = import_of({shape("ply", {value("filename", "meshes\\a.ply")})});
  CHECK(part(import, "scene.shapes.0.file") == "meshes/a.ply");
}

TEST_CASE("mapping: the list of objects says what stands for them") {
  const Import import = import_of({shape("rectangle", {nested(bsdf("roughplastic", {}, "Lamp"))})});
  std::vector<std::string> lines;
  for (const ImportedObject& o : import.objects) lines.push_back(o.what + " -> " + o.stands);
  CHECK(lines == Messages{"shape rectangle -> shape quad",
                          "bsdf roughplastic 'Lamp' -> bsdf rough_plastic"});
}

}  // namespace pharos::mitsuba::test
