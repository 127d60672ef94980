// Wrong command lines: subcommands, options, overrides, configs and outputs.

#include <array>
#include <sys/stat.h>
#include <unistd.h>

#include <doctest/doctest.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

/// Arguments for a run in a folder that contains the valid config good.yaml.
Mistake typed(const std::string& arguments) {
  return {.arguments = arguments,
          .prepare = [](const ScratchFolder& f) { f.write("good.yaml", config_with("")); }};
}

TEST_CASE("subcommands and options") {
  check_refused(typed(""), {"pharos: error: ", "expected a command", "'render'"});
  check_refused(typed("rendre good.yaml"), {"did you mean 'render'?"});
  check_refused(typed("--wrong"), {"--wrong"});
  check_refused(typed("render"), {"config"});
  check_refused(typed("render good.yaml other.yaml"), {"other.yaml"});
  check_refused(typed("render good.yaml --spp 3"), {"--spp"});
  check_refused(typed("render good.yaml --threads=-1"), {"--threads", "-1"});
  check_refused(typed("render good.yaml --threads 100000"), {"--threads", "100000"});
  check_refused(typed("render good.yaml --threads many"), {"--threads", "many"});
  check_refused(typed("render good.yaml --threads 99999999999999999999"), {"--threads"});
  check_refused(typed("render good.yaml --threads"), {"--threads"});
  check_refused(typed("plugins pth"), {"did you mean 'path'?"});
  check_refused(typed("plugins a b"), {"b"});
  check_refused(typed("--"), {"expected a command"});
  check_refused(typed("render good.yaml -o " + std::string(300, 'x') + ".exr"), {"too long"});
  check_refused(typed("conformance diffuse --module sensors"), {"sensors"});
  check_refused(typed("conformance diffuse --json /nowhere/x.json"), {"does not exist"});
}

TEST_CASE("replays of paths that are not there") {
  check_refused(typed("render good.yaml --replay 512,0,0"), {"--replay: error: ", "512 x 512"});
  check_refused(typed("render good.yaml --replay 1,2"), {"--replay"});
  check_refused(typed("render good.yaml --replay 1,2,x"), {"--replay", "x"});
  check_refused(typed("render good.yaml --replay 0,0,0,7"), {"iteration 7"});
  check_refused(typed("render good.yaml --replay 0,0,1"), {"no sample 1: iteration 0 has 1"});
}

/// A glTF mesh of one triangle in `file`.
std::string gltf_of(const std::string& file) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
         file + "\"}]}";
}

/// The buffer of this mesh.
std::string triangle_bytes() {
  constexpr std::array<float, 9> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
  return {reinterpret_cast<const char*>(positions.data()), sizeof positions};
}

TEST_CASE("outputs that are inputs, or the same file twice") {
  const auto refused = [](const std::string& arguments, const std::vector<std::string>& says) {
    check_refused({.arguments = arguments,
                   .prepare =
                       [](const ScratchFolder& f) {
                         f.write("good.exr", config_with(""));
                         f.write("base.yaml", config_with(""));
                         f.write("over.yaml", "extends: base.yaml\n");
                         f.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
                         f.write("mesh.yaml", config_with_shape("{ type: mesh, file: quad.obj }"));
                         f.write("a buffer.bin", triangle_bytes());
                         f.write("tri.gltf", gltf_of("a%20buffer.bin"));
                         f.write("gltf.yaml", config_with_shape("{ type: mesh, file: tri.gltf }"));
                         std::filesystem::create_symlink("quad.obj", f.path() / "link.exr");
                       }},
                  says);
  };
  refused("render good.exr", {"good.exr: error: ", "'output.image' would overwrite an input"});
  refused("render over.yaml --set output.model=base.yaml", {"base.yaml: error: ", "an input"});
  refused("render over.yaml --set output.model=./over.yaml", {"over.yaml: error: ", "an input"});
  refused("render mesh.yaml --set output.model=quad.obj", {"quad.obj: error: ", "an input"});
  refused("render mesh.yaml -o link.exr", {"link.exr: error: ", "an input"});
  refused("render mesh.yaml -o a.exr --set output.model=./a.exr",
          {"'output.image' and 'output.model' name the same file"});
  refused("render gltf.yaml --set output.model='a buffer.bin'", {"a buffer.bin: error: "});
  refused("render gltf.yaml --set output.checkpoint='a buffer.bin'", {"an input"});
  refused("render mesh.yaml -o a.exr --set output.checkpoint=a.png",
          {"'output.png' and 'output.checkpoint' name the same file"});
}

TEST_CASE("input outside of the folder that --confine names") {
  const auto refused = [](const std::string& arguments, const std::vector<std::string>& says) {
    check_refused(
        {.arguments = arguments,
         .prepare =
             [](const ScratchFolder& f) {
               std::filesystem::create_directory(f.path() / "in");
               f.write("out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
               f.write("in/mesh.yaml", config_with_shape("{ type: mesh, file: ../out.obj }"));
               f.write("in/scene.xml",
                       "<scene version=\"3.0.0\"><shape type=\"obj\"><string "
                       "name=\"filename\" value=\"../out.obj\"/></shape></scene>");
               f.write("out.yaml", config_with(""));
               f.write("in/over.yaml", "extends: ../out.yaml\n");
               std::filesystem::create_symlink("../out.obj", f.path() / "in/link.obj");
               f.write("in/link.yaml", config_with_shape("{ type: mesh, file: link.obj }"));
               f.write("out.exr", "");
               f.write("in/image.yaml",
                       "scene:\n  sensor: perspective\n  emitters: [{ type: "
                       "environment_map, file: ../out.exr }]\nbudget: { spp: 1 }\n");
               f.write("out.bin", triangle_bytes());
               f.write("in/buffer.gltf", gltf_of("../out.bin"));
               f.write("in/buffer.yaml", config_with_shape("{ type: mesh, file: buffer.gltf }"));
             }},
        says);
  };
  for (const char* file :
       {"mesh.yaml", "scene.xml", "over.yaml", "link.yaml", "image.yaml", "buffer.yaml"}) {
    refused(std::string("render --confine in in/") + file, {"lies outside of '", "--confine"});
  }
  refused("validate --confine in out.yaml", {"lies outside of '"});
  // Without a folder, nothing would be confined.
  for (const char* none : {"''", "nowhere", "out.yaml"}) {
    refused(std::string("validate out.yaml --confine ") + none,
            {"--confine: error: expected a folder"});
  }
}

TEST_CASE("with --confine, a render leaves checkpoints, and goes on") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path() / "in");
  folder.write("in/a.yaml", config_with("film: { width: 8, height: 8 }\n"));
  const std::string render =
      "render --confine in in/a.yaml -o a.exr --set output.checkpoint=a.checkpoint";
  CHECK(run_pharos(render, folder.path()).exit_code == 0);
  const Outcome again = run_pharos(render + " --resume", folder.path());
  CHECK(again.exit_code == 0);
  CHECK(again.err.find("starts anew") == std::string::npos);
  CHECK(run_pharos(render + " --continue a.exr --set budget.spp=2", folder.path()).exit_code == 0);
}

TEST_CASE("overrides") {
  const auto overridden = [](const std::string& assignment, const std::vector<std::string>& says) {
    check_refused(typed("render good.yaml --set '" + assignment + "'"), says);
  };
  overridden("film.widht=3", {"--set film.widht=3: error: ", "'width'"});
  overridden("film.width=no", {"--set film.width=no: error: ", "an integer", "'no'"});
  overridden("film.width=0", {"--set film.width=0: error: ", ">= 1"});
  overridden("film.width", {"--set film.width: error: ", "KEY=VALUE"});
  overridden("=3", {"--set =3: error: ", "KEY=VALUE"});
  overridden("film..width=3", {"--set film..width=3: error: ", "KEY=VALUE"});
  overridden(".=3", {"--set .=3: error: ", "KEY=VALUE"});
  overridden("film.width=[1", {"--set film.width=[1: error: ", "YAML"});
  overridden("film.width=", {"--set film.width=: error: ", "nothing"});
  overridden("scene.shapes.7=sphere", {"--set ", "index", "'7'"});
  overridden("scene.shapes.first=sphere", {"--set ", "index", "'first'"});
  overridden("budget.spp.x=1", {"--set ", "cannot set 'x'", "'budget.spp'"});
  check_refused(typed("render good.yaml --set"), {"--set"});
}

TEST_CASE("configs that are no files") {
  check_refused(typed("render goood.yaml"), {"goood.yaml: error: ", "'good.yaml'"});
  check_refused(typed("validate goood.yaml"), {"goood.yaml: error: ", "'good.yaml'"});
  check_refused(typed("render ."), {".: error: ", "found a folder"});
  check_refused(typed("render /dev/zero"), {"/dev/zero: error: ", "pipe or device"});
  check_refused(typed("render good.yaml/more.yaml"), {"good.yaml/more.yaml: error: "});
  check_refused(typed("render " + std::string(5000, 'x')), {": error: ", "name too long"});
  check_refused(
      {.arguments = "render pipe",
       .prepare = [](const ScratchFolder& f) { mkfifo((f.path() / "pipe").c_str(), 0600); }},
      {"pipe: error: ", "pipe or device"});
}

TEST_CASE("outputs that cannot be written") {
  check_refused(typed("render good.yaml -o no-such-folder/x.exr"),
                {"no-such-folder", "does not exist"});
  check_refused(typed("render good.yaml -o good.yaml/x.exr"), {"'good.yaml'"});
  check_refused(typed("render good.yaml -o picture.jpg"), {"picture.jpg", ".exr"});
  check_refused(typed("render good.yaml -o /dev/full"), {"/dev/full", ".exr"});
  check_refused(typed("render good.yaml --set output.model=."), {"is a folder"});
  check_refused(typed("render good.yaml --set output.model=/dev/full"), {"/dev/full"});
  check_refused(typed("render good.yaml --set output.model=none/model"), {"'none'"});
  for (const char* name : {"x.exr", "x.png"}) {
    check_refused({.arguments = "render good.yaml -o x.exr",
                   .prepare =
                       [&](const ScratchFolder& f) {
                         f.write("good.yaml", config_with(""));
                         std::filesystem::create_directory(f.path() / name);
                       }},
                  {name, "is a folder"});
  }
}

TEST_CASE("what only root may do" * doctest::skip(geteuid() == 0)) {
  using std::filesystem::perms;
  check_refused({.arguments = "render secret.yaml",
                 .prepare =
                     [](const ScratchFolder& f) {
                       f.write("secret.yaml", config_with(""));
                       permissions(f.path() / "secret.yaml", perms::none);
                     }},
                {"secret.yaml: error: ", "may not be read"});
  check_refused({.arguments = "render good.yaml -o locked/x.exr",
                 .prepare =
                     [](const ScratchFolder& f) {
                       f.write("good.yaml", config_with(""));
                       std::filesystem::create_directory(f.path() / "locked");
                       permissions(f.path() / "locked", perms::owner_read | perms::owner_exec);
                     }},
                {"locked/x.exr", "not writable"});
}

}  // namespace
}  // namespace pharos::testing
