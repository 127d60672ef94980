// Import of scenes of other programs from the command line.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>

#include "process.h"
#include "refusal.h"

namespace pharos::testing {
namespace {

namespace fs = std::filesystem;

std::string example() {
  return fmt::format("'{}/mitsuba-still-life/scene.xml'", PHAROS_SCENES);
}

constexpr const char* kSmall = "--set film.width=48 --set film.height=30 --set budget.spp=2";

/// A small scene in either dialect.
std::string scene_xml(bool old) {
  const char* max_depth = old ? "maxDepth" : "max_depth";
  const char* to_world = old ? "toWorld" : "to_world";
  const char* int_ior = old ? "intIOR" : "int_ior";
  const char* sample_count = old ? "sampleCount" : "sample_count";
  return fmt::format(R"(<scene version="{}">
  <integrator type="path"><integer name="{}" value="6"/></integrator>
  <sensor type="perspective">
    <float name="fov" value="40"/>
    <transform name="{}"><lookat origin="0,1,6" target="0,0,0" up="0,1,0"/></transform>
    <sampler type="independent"><integer name="{}" value="4"/></sampler>
    <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="24"/></film>
  </sensor>
  <bsdf type="dielectric" id="glass"><float name="{}" value="1.5"/></bsdf>
  <shape type="sphere"><ref id="glass"/></shape>
  <shape type="cube">
    <transform name="{}"><scale value="0.5"/><translate x="2" y="0" z="0"/></transform>
  </shape>
  <shape type="obj"><string name="filename" value="meshes/leaf.obj"/></shape>
  <emitter type="constant"><rgb name="radiance" value="1, 0.8, 0.6"/></emitter>
</scene>
)",
                     old ? "0.6.0" : "3.0.0", max_depth, to_world, sample_count, int_ior, to_world);
}

void write_scene(const ScratchFolder& folder, bool old = false) {
  folder.write("scene.xml", scene_xml(old));
  fs::create_directories(folder.path() / "meshes");
  folder.write("meshes/leaf.obj", "v -2 0 0\nv -1 0 0\nv -1.5 1 0\nf 1 2 3\n");
}

TEST_CASE("a scene of Mitsuba renders as it stands, and within a config") {
  const ScratchFolder folder;
  const Outcome alone = run_pharos(fmt::format("render {} {}", example(), kSmall), folder.path());
  REQUIRE_MESSAGE(alone.exit_code == 0, alone.err);
  CHECK(read_image(folder.path() / "scene.exr").width() == 48);

  folder.write("config.yaml", fmt::format("scene: {}\nfilm: {{ width: 48, height: 30 }}\n"
                                          "integrator: {{ type: path, max_depth: 2 }}\n"
                                          "budget: {{ spp: 2 }}\n",
                                          example()));
  const Outcome within = run_pharos("validate config.yaml", folder.path());
  REQUIRE_MESSAGE(within.exit_code == 0, within.err);
  CHECK(within.out.find("max_depth: 2") != std::string::npos);
  CHECK(within.out.find("type: gaussian") != std::string::npos);  // from the scene file
}

TEST_CASE("a scene as YAML renders without a config, and a scene of pbrt as it stands") {
  const ScratchFolder folder;
  const std::string scene = fmt::format("'{}/cornell-box/scene.yaml'", PHAROS_SCENES);
  const Outcome bare = run_pharos(fmt::format("render {} {}", scene, kSmall), folder.path());
  REQUIRE_MESSAGE(bare.exit_code == 0, bare.err);
  CHECK(read_image(folder.path() / "scene.exr").width() == 48);
  CHECK(run_pharos("validate " + scene, folder.path()).out.find("spp: 64") != std::string::npos);

  folder.write("room.pbrt",
               "Camera \"perspective\" WorldBegin LightSource \"infinite\"\n"
               "Translate 0 0 3 Shape \"sphere\" Translate 0 -1 0\n"
               "Shape \"trianglemesh\" \"point3 P\" [ -1 0 0  1 0 0  0 0 1 ]\n");
  const Outcome pbrt = run_pharos(fmt::format("render room.pbrt {}", kSmall), folder.path());
  REQUIRE_MESSAGE(pbrt.exit_code == 0, pbrt.err);
  CHECK(read_image(folder.path() / "room.exr").height() == 30);
}

TEST_CASE("import copies a scene of pbrt with the files that it names") {
  const ScratchFolder folder;
  folder.write("room.pbrt",
               "Camera \"perspective\" WorldBegin LightSource \"infinite\"\n"
               "Translate 0 0 3 Shape \"trianglemesh\" \"point3 P\" [ -1 0 0  1 0 0  0 1 0 ]\n");
  REQUIRE(run_pharos(fmt::format("render room.pbrt {}", kSmall), folder.path()).exit_code == 0);
  const Outcome outcome = run_pharos("import room.pbrt -o imported/", folder.path());
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  fs::remove(folder.path() / "room.pbrt");
  REQUIRE(
      run_pharos(fmt::format("render imported/render.yaml {}", kSmall), folder.path()).exit_code ==
      0);
  CHECK(read_image(folder.path() / "render.exr").values() ==
        read_image(folder.path() / "room.exr").values());
}

TEST_CASE("members of the integrator and the sampler of a scene are changed one by one") {
  const ScratchFolder folder;
  write_scene(folder);
  std::string xml = scene_xml(false);
  const std::string independent = "sampler type=\"independent\"";
  xml.replace(xml.find(independent), independent.size(), "sampler type=\"multijitter\"");
  folder.write("scene.xml", xml);
  folder.write("config.yaml", "scene: scene.xml\nintegrator: { termination: { depth: 7 } }\n");
  const auto validated = [&](const std::string& options) {
    const Outcome outcome = run_pharos("validate " + options, folder.path());
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    return outcome.out;
  };
  const auto says = [](const std::string& settings, const char* part) {
    return settings.find(part) != std::string::npos;
  };
  for (const char* config : {"config.yaml", "scene.xml --set integrator.termination.depth=7"}) {
    const std::string settings = validated(config);
    CHECK(says(settings, "max_depth: 6"));
    CHECK(says(settings, "depth: 7"));
    CHECK(says(settings, "spp: 4"));
  }
  CHECK(says(validated("scene.xml --set integrator.guiding=robust"), "max_depth: 6"));
  const std::string sampler = validated("scene.xml --set sampler.correlated=false");
  CHECK(says(sampler, "type: multi_jittered"));
  CHECK(says(sampler, "correlated: false"));
  // Another integrator renders the same light unless it states otherwise. A budget is replaced as a
  // whole.
  const std::string other = validated("scene.xml --set 'integrator={ type: light }'");
  CHECK(says(other, "type: light"));
  CHECK(says(other, "max_depth: 6"));
  CHECK(says(other, "termination:\n    type: throughput"));
  CHECK_FALSE(says(other, "guiding"));
  CHECK(says(validated("scene.xml --set 'integrator={ type: light, max_depth: 3 }'"),
             "max_depth: 3"));
  CHECK(says(validated("scene.xml --set 'integrator={ type: path, termination: none }'"),
             "max_depth: 6"));
  CHECK(says(validated("scene.xml --set integrator.roulette=throughput"), "roulette: throughput"));
  CHECK_FALSE(says(validated("scene.xml --set 'budget={ seconds: 2 }'"), "spp: 4"));
}

TEST_CASE("both dialects of a scene give the same bits") {
  std::vector<Image> images;
  for (const bool old : {false, true}) {
    const ScratchFolder folder;
    write_scene(folder, old);
    const Outcome outcome = run_pharos("render scene.xml", folder.path());
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    images.push_back(read_image(folder.path() / "scene.exr"));
  }
  CHECK(images[0].values() == images[1].values());
}

TEST_CASE("import writes a scene with its meshes that renders the same bits") {
  const ScratchFolder folder;
  write_scene(folder);
  REQUIRE(run_pharos("render scene.xml", folder.path()).exit_code == 0);
  const Outcome outcome = run_pharos("import scene.xml -o imported/", folder.path());
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  CHECK(folder.has("imported/scene.yaml"));
  CHECK(folder.has("imported/meshes/leaf.obj"));
  CHECK(test::bytes_of(folder.path() / "imported/scene.yaml").find(folder.path().string()) ==
        std::string::npos);
  const fs::path moved = folder.path() / "elsewhere";
  fs::rename(folder.path() / "imported", moved);
  fs::remove_all(folder.path() / "meshes");
  REQUIRE(run_pharos("render elsewhere/render.yaml", folder.path()).exit_code == 0);
  CHECK(read_image(folder.path() / "render.exr").values() ==
        read_image(folder.path() / "scene.exr").values());

  const Outcome again = run_pharos("import elsewhere/render.yaml -o other", folder.path());
  CHECK(again.exit_code == 2);
  folder.write("full", "");
  CHECK(run_pharos(fmt::format("import {} -o elsewhere", example()), folder.path()).exit_code == 2);
}

TEST_CASE("import reports what stands for every object, and how it approximates") {
  const ScratchFolder folder;
  write_scene(folder);
  const Outcome outcome = run_pharos("import scene.xml --report", folder.path());
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  for (const char* line : {"scene.xml:9:", "'glass'", "sphere", "scene.xml:14:"}) {
    CHECK_MESSAGE(outcome.out.find(line) != std::string::npos, line);
  }
  std::string xml = scene_xml(false);
  xml.replace(xml.find("<sampler type=\"independent\">"), 28, "<sampler type=\"ldsampler\">  ");
  folder.write("scene.xml", xml);
  const Outcome noted = run_pharos("import scene.xml", folder.path());
  CHECK(noted.exit_code == 0);
  CHECK(noted.err.find("scene.xml:6:") != std::string::npos);
  CHECK(run_pharos("import scene.xml --strict", folder.path()).exit_code == 2);
  CHECK(run_pharos("render scene.xml --strict", folder.path()).exit_code == 2);
}

/// `render bad.xml`, where `wrong` replaces `right` in the scene.
Mistake scene_with(const std::string& right, const std::string& wrong) {
  return {.arguments = "render bad.xml", .prepare = [right, wrong](const ScratchFolder& folder) {
            write_scene(folder);
            std::string xml = scene_xml(false);
            xml.replace(xml.find(right), right.size(), wrong);
            folder.write("bad.xml", xml);
          }};
}

TEST_CASE("wrong scenes end in one line that names the place") {
  check_refused(scene_with("type=\"sphere\"", "type=\"shpere\""), {"bad.xml:10:", "'sphere'"});
  check_refused(scene_with("<ref id=\"glass\"/>", "<ref id=\"glas\"/>"),
                {"bad.xml:10:", "'glass'"});
  check_refused(scene_with("leaf.obj", "leav.obj"), {"bad.xml:14:", "leaf.obj"});
  check_refused(scene_with("value=\"40\"", "value=\"forty\""), {"bad.xml:4:"});
  check_refused(scene_with("</scene>", ""), {"bad.xml:"});
  check_refused(scene_with("<float name=\"fov\"", "<flaot name=\"fov\""),
                {"bad.xml:4:", "'float'"});
  check_refused(Mistake{.arguments = "render none.xml"}, {"none.xml"});
  check_refused(Mistake{.arguments = "import none.obj"}, {"none.obj", "'xml'"});
}

}  // namespace
}  // namespace pharos::testing
