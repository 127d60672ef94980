// Rendering from the command line: files, metadata, exit codes, interruption.

#include <chrono>
#include <fstream>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>

#include "process.h"

namespace pharos::testing {
namespace {

std::string small_render() {
  return fmt::format(
      "scene: {}/cornell-box/scene.yaml\nfilm: {{ width: 40, height: 30 }}\n"
      "budget: {{ spp: 4 }}\noutput: {{ aovs: [albedo, depth, variance] }}\n",
      PHAROS_SCENES);
}

TEST_CASE("render writes EXR and PNG and says what it did") {
  const ScratchFolder folder;
  folder.write("box.yaml", small_render());
  const Outcome outcome = run_pharos("render box.yaml", folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find("box.exr: 40 x 30, 4 samples") != std::string::npos);
  CHECK(folder.has("box.png"));
  CHECK(folder.file_count() == 3);  // nothing temporary is left

  const Image image = read_image(folder.path() / "box.exr");
  CHECK(image.width() == 40);
  CHECK(image.height() == 30);
  CHECK(image.channel_index("albedo.R") >= 0);
  CHECK(image.channel_index("depth.Z") >= 0);
  CHECK(image.channel_index("normal.X") == -1);
  const Metadata metadata = read_metadata(folder.path() / "box.exr");
  CHECK(metadata.at("pharos:seed") == "1");
  CHECK(metadata.at("pharos:samples_per_pixel") == "4");
  CHECK(metadata.at("pharos:config").find("max_depth: 12") != std::string::npos);
}

TEST_CASE("--quiet, --output, --set and --threads") {
  const ScratchFolder folder;
  folder.write("box.yaml", small_render());
  const Outcome outcome = run_pharos(
      "render box.yaml --quiet -o other.exr --set film.width=8 --set output.png=false --threads 3",
      folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  CHECK(read_image(folder.path() / "other.exr").width() == 8);
  CHECK_FALSE(folder.has("other.png"));
  CHECK_FALSE(folder.has("box.exr"));
}

TEST_CASE("a validated config renders the same image") {
  const ScratchFolder folder;
  folder.write("box.yaml", small_render());
  const Outcome resolved = run_pharos("validate box.yaml", folder.path());
  REQUIRE(resolved.exit_code == 0);
  folder.write("resolved.yaml", resolved.out);
  CHECK(run_pharos("validate resolved.yaml", folder.path()).out == resolved.out);
  REQUIRE(run_pharos("render box.yaml", folder.path()).exit_code == 0);
  REQUIRE(run_pharos("render resolved.yaml", folder.path()).exit_code == 0);
  CHECK(read_image(folder.path() / "box.exr").values() ==
        read_image(folder.path() / "resolved.exr").values());
}

TEST_CASE("the config in an image's metadata renders that image again") {
  const ScratchFolder folder;
  folder.write("box.yaml", small_render());
  REQUIRE(run_pharos("render box.yaml -q", folder.path()).exit_code == 0);
  folder.write("again.yaml", read_metadata(folder.path() / "box.exr").at("pharos:config"));
  REQUIRE(run_pharos("render again.yaml -q", folder.path()).exit_code == 0);
  CHECK(read_image(folder.path() / "box.exr").values() ==
        read_image(folder.path() / "again.exr").values());
}

TEST_CASE("an image names the papers of the plugins that it was rendered with") {
  const ScratchFolder folder;
  folder.write("box.yaml", small_render());
  REQUIRE(run_pharos("render box.yaml -q", folder.path()).exit_code == 0);
  CHECK(read_metadata(folder.path() / "box.exr").count("pharos:papers") == 0);
  REQUIRE(run_pharos("render box.yaml -q --set integrator.guiding=robust-ears", folder.path())
              .exit_code == 0);
  const std::string papers = read_metadata(folder.path() / "box.exr").at("pharos:papers");
  for (const char* authors : {"A. Rath, P. Grittmann", "T. Müller, M. Gross", "L. Ruppert"}) {
    CHECK_MESSAGE(papers.find(authors) != std::string::npos, papers);
  }
}

TEST_CASE("pixels beyond the range of a float are counted") {
  const ScratchFolder folder;
  folder.write("box.yaml",
               "scene:\n  emitters: [{ type: constant, radiance: 3e38 }]\n  sensor: perspective\n"
               "film: { width: 8, height: 8 }\nbudget: { spp: 64 }\n");
  const Outcome outcome = run_pharos("render box.yaml", folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK_MESSAGE(outcome.err.find(" pixels are NaN or infinite") != std::string::npos, outcome.err);
  CHECK(read_metadata(folder.path() / "box.exr").at("pharos:invalid_pixels") != "0");
}

TEST_CASE("an image whose folder vanishes is kept elsewhere") {
  const ScratchFolder folder;
  folder.write("box.yaml", small_render());
  std::filesystem::create_directory(folder.path() / "sub");
  std::filesystem::create_directory(folder.path() / "kept");
  const Outcome outcome = run_pharos("render box.yaml -o sub/box.exr --set 'budget={ seconds: 2 }'",
                                     folder.path(), "{ (sleep 1; rm -r sub) & } && TMPDIR=kept");
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.err.find("cannot write 'sub/box.exr'") != std::string::npos);
  CHECK(outcome.err.find("it is kept as 'kept/pharos-") != std::string::npos);
  int images = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "kept")) {
    images += read_image(entry.path()).width() == 40 ? 1 : 0;
  }
  CHECK(images == 2);  // the EXR file and its PNG
}

TEST_CASE("a disk that is full is noticed before the render") {
  const ScratchFolder folder;
  folder.write("box.yaml", small_render());
  const Outcome outcome = run_pharos(
      "render box.yaml --set film.width=512 --set film.height=512 --set budget.spp=10000",
      folder.path(), "ulimit -f 100;");
  CHECK(outcome.exit_code == 3);
  CHECK_MESSAGE(outcome.err.find("the image needs up to") != std::string::npos, outcome.err);
}

TEST_CASE("with too little memory, a render ends with a message, and before it starts") {
  const ScratchFolder folder;
  folder.write("box.yaml", small_render());
  if (run_pharos("validate box.yaml", folder.path(), "ulimit -v 8388608;").exit_code != 0) {
    MESSAGE("skipped: this program needs more address space than can be limited (sanitizers)");
    return;
  }
  // With the lower limits, the scene cannot be built; with the last one, images could not be
  // written, which is noticed before the render starts. The render would last until it is killed.
  bool is_unloaded = false;
  for (double kilobytes = 150e3; kilobytes < 4e6 && !is_unloaded; kilobytes *= 1.01) {
    CAPTURE(kilobytes);
    const Outcome outcome = run_pharos("render box.yaml --set budget.spp=100000000", folder.path(),
                                       fmt::format("ulimit -v {:.0f};", kilobytes));
    const bool is_killed = outcome.exit_code == 124 || outcome.exit_code == 137;
    REQUIRE_FALSE(is_killed);  // it waited for ever, or rendered
    const bool by_loader = outcome.exit_code == 127;
    CHECK_MESSAGE((outcome.exit_code == 3 || by_loader), outcome.exit_code);
    if (!by_loader) CHECK(outcome.err.find("pharos: error: ") != std::string::npos);
    is_unloaded = outcome.err.find("images cannot be read or written: ") != std::string::npos;
  }
  CHECK(is_unloaded);
}

TEST_CASE("output that cannot be written is an error") {
  const ScratchFolder folder;
  folder.write("box.yaml", small_render());
  CHECK(run_pharos("validate box.yaml >/dev/full; (echo $? >code)", folder.path()).exit_code == 0);
  std::ifstream in(folder.path() / "code");
  int code = 0;
  in >> code;
  CHECK(code == 3);
}

TEST_CASE("Ctrl-C and SIGTERM keep what was rendered") {
  for (const char* signal : {"INT", "TERM"}) {
    const ScratchFolder folder;
    folder.write("box.yaml", small_render());
    // A busy machine takes longer to load the scene and to render a first pass.
    const auto start = std::chrono::steady_clock::now();
    REQUIRE(run_pharos("render box.yaml -q -o first.exr", folder.path()).exit_code == 0);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    const Outcome outcome = interrupt_pharos("render box.yaml --set budget.spp=1000000",
                                             folder.path(), 1.5 + 2 * taken.count(), signal);
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.err.find("(interrupted)") != std::string::npos);
    REQUIRE(folder.has("box.exr"));
    CHECK(read_metadata(folder.path() / "box.exr").at("pharos:stopped") == "true");
    CHECK(read_image(folder.path() / "box.exr").rgb(20, 25).r > 0);
  }
}

TEST_CASE("shapes without area are left out with a warning, or refused with --strict") {
  const ScratchFolder folder;
  folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  folder.write("lamp.yaml",
               "scene:\n  sensor: perspective\n  shapes:\n    - { type: mesh, file: line.obj }\n"
               "    - { type: mesh, file: line.obj, emitter: { type: area, radiance: 1 } }\n"
               "  emitters: [ { type: constant, radiance: 1 } ]\n"
               "film: { width: 8, height: 8 }\nbudget: { spp: 1 }\n");
  const Outcome outcome = run_pharos("render lamp.yaml", folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find("lamp.yaml:4:7: the shape has no area and is left out (2 times)") !=
        std::string::npos);
  const Outcome strict = run_pharos("render lamp.yaml --strict", folder.path());
  CHECK(strict.exit_code == 2);
  CHECK(strict.err.find("lamp.yaml:4:7: error: the shape has no area") == 0);
}

TEST_CASE("a black image is explained") {
  const ScratchFolder folder;
  const auto stderr_with = [&](const std::string& lights) {
    folder.write("dark.yaml",
                 "scene:\n  sensor: { type: perspective, to_world: { translate: [0, 0, -5] } }\n"
                 "  shapes: [ { type: quad, flip_normals: true } ]\n" +
                     lights + "film: { width: 8, height: 8 }\nbudget: { spp: 4 }\n");
    const Outcome outcome = run_pharos("render dark.yaml", folder.path());
    CHECK(outcome.exit_code == 0);
    return outcome.err;
  };
  const std::string none = stderr_with("");
  CHECK(none.find("dark.exr: none of 256 paths found light") != std::string::npos);
  CHECK(none.find("'bidirectional'") != std::string::npos);
  CHECK(stderr_with("  emitters: [ { type: constant, radiance: 1 } ]\n").find("found light") ==
        std::string::npos);
  for (const char* integrator : {"path", "light", "bidirectional"}) {
    CAPTURE(integrator);
    const std::string lamp =
        "  emitters: [ { type: point, position: [0, 0, -3], intensity: 1 } ]\n";
    CHECK(stderr_with(lamp + fmt::format("integrator: {}\n", integrator)).find("found light") ==
          std::string::npos);
  }
}

TEST_CASE("--replay prints one path") {
  const ScratchFolder folder;
  folder.write("box.yaml", small_render());
  const Outcome outcome = run_pharos("render box.yaml --replay 20,25,1", folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("0 sensor") != std::string::npos);
  CHECK(outcome.out.find("1 surface") != std::string::npos);
  CHECK_FALSE(folder.has("box.exr"));
  CHECK(run_pharos("render box.yaml --replay 99,0,0", folder.path()).exit_code == 2);
}

TEST_CASE("plugins lists contracts, plugins and parameters") {
  const ScratchFolder folder;
  const Outcome all = run_pharos("plugins", folder.path());
  CHECK(all.exit_code == 0);
  for (const char* name : {"bsdf", "rough_conductor", "sampler", "sobol", "integrator", "path"}) {
    CHECK_MESSAGE(all.out.find(name) != std::string::npos, name);
  }
  const Outcome path = run_pharos("plugins path", folder.path());
  CHECK(path.out.find("max_depth") != std::string::npos);
  CHECK(path.out.find("one | all") != std::string::npos);
  const Outcome edge = run_pharos("plugins edge", folder.path());
  CHECK(edge.out.find("integrand 'edge'") != std::string::npos);
  CHECK(edge.out.find("one to eight angles") != std::string::npos);
  const Outcome adjoint = run_pharos("plugins adjoint", folder.path());
  CHECK(adjoint.out.find("Please cite J. Vorba, J. Křivánek: Adjoint-Driven") != std::string::npos);
  const Outcome unknown = run_pharos("plugins pth", folder.path());
  CHECK(unknown.exit_code == 2);
  CHECK(unknown.err.find("did you mean 'path'?") != std::string::npos);
}

}  // namespace
}  // namespace pharos::testing
