// Wrong model files in configs. The program reports the mistake at the key of the config, before it
// renders anything.

#include <fstream>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>

#include "learned_model.h"
#include "refusal.h"

namespace pharos::testing {
namespace {

/// A config that takes the model of the stub `method` from `file`, in line 9 from column 12 on.
std::string config_with_model(const std::string& file, const std::string& method) {
  return fmt::format(
      "scene: box.yaml\nfilm: {{ width: 24, height: 16 }}\nbudget: {{ spp: 4 }}\n"
      "integrator:\n  type: path\n  guiding:\n    learner: {0}\n    guider: {0}\n    model: {1}\n",
      method, file);
}

void check_model_refused(const std::string& file, const std::vector<std::string>& says,
                         const std::function<void(const ScratchFolder&)>& spoil = {},
                         const std::string& method = "stub_segments") {
  std::vector<std::string> all = says;
  all.push_back("use.yaml:9:12: error: ");
  all.push_back("the model file '");
  all.push_back(file);
  check_refused({.arguments = "render use.yaml",
                 .prepare =
                     [&](const ScratchFolder& f) {
                       write_learned_model(f);
                       f.write("use.yaml", config_with_model(file, method));
                       if (spoil) spoil(f);
                     },
                 .environment = kStandIns},
                all);
}

TEST_CASE("a model is learned once and rendered with many times") {
  const ScratchFolder folder;
  write_learned_model(folder);
  folder.write("use.yaml", config_with_model("box.model", "stub_segments"));
  const auto render = [&](const std::string& arguments) {
    const Outcome outcome = run_pharos("render use.yaml -q " + arguments, folder.path(), kStandIns);
    CHECK(outcome.err.empty());
    REQUIRE(outcome.exit_code == 0);
  };
  render("--threads 1 --set output.model=again.model");
  render("--threads 3 -o three.exr");
  CHECK(read_image(folder.path() / "use.exr").values() ==
        read_image(folder.path() / "three.exr").values());
  const Metadata metadata = read_metadata(folder.path() / "use.exr");
  CHECK(metadata.at("pharos:samples_per_pixel") == "4");
  CHECK(metadata.at("pharos:seconds_training") == "0.000");
  CHECK(metadata.at("pharos:config").find("box.model") != std::string::npos);
  CHECK(test::bytes_of(folder.path() / "again.model") ==
        test::bytes_of(folder.path() / "box.model"));
}

TEST_CASE("a model that nobody learned is not written, and that is told") {
  const ScratchFolder folder;
  write_learned_model(folder);
  const Outcome outcome =
      run_pharos("render train.yaml --set integrator.guiding=null --set output.model=none.model",
                 folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find("none.model: not written, since nothing was learned") !=
        std::string::npos);
  CHECK_FALSE(folder.has("none.model"));
}

TEST_CASE("model files that are missing or no files") {
  check_model_refused("bx.model", {"no such file (did you mean 'box.model'?)"});
  check_model_refused(".", {"found a folder"});
  check_model_refused("/dev/zero", {"pipe or device"});
}

TEST_CASE("model files that are damaged or something else") {
  check_model_refused("box.yaml", {"is no model of Pharos"});
  check_model_refused("empty", {"is no model of Pharos"},
                      [](const ScratchFolder& f) { f.write("empty", ""); });
  for (const std::size_t kept : {20, 70, 1000}) {
    CAPTURE(kept);
    check_model_refused("box.model", {"is cut off"}, [&](const ScratchFolder& f) {
      std::filesystem::resize_file(f.path() / "box.model", kept);
    });
  }
  check_model_refused("box.model", {"goes on for 4 bytes"}, [](const ScratchFolder& f) {
    std::ofstream(f.path() / "box.model", std::ios::app) << "more";
  });
}

TEST_CASE("model files of another learner") {
  check_model_refused("box.model",
                      {"was learned by 'stub_segments'", "the learner 'stub_direction'"}, {},
                      "stub_direction");
}

TEST_CASE("a model of one method among several, and by --set") {
  const auto prepare = [](const ScratchFolder& f) {
    write_learned_model(f);
    f.write(
        "use.yaml",
        "scene: box.yaml\nbudget: { spp: 4 }\nintegrator:\n  type: path\n  guiding:\n    methods:\n"
        "      - { learner: stub_direction, guider: stub_direction }\n"
        "      - { learner: stub_segments, guider: stub_segments, model: no.model }\n");
  };
  check_refused({.arguments = "render use.yaml", .prepare = prepare, .environment = kStandIns},
                {"use.yaml:8:65: error: ", "no.model"});
  check_refused({.arguments = "validate train.yaml --set integrator.guiding.model=no.model",
                 .prepare = write_learned_model,
                 .environment = kStandIns},
                {"--set integrator.guiding.model=no.model: error: ", "no.model"});
  check_refused({.arguments = "render use.yaml --set integrator.guiding.methods.1.model=null --set "
                              "integrator.guiding.model=box.model",
                 .prepare = prepare,
                 .environment = kStandIns},
                {"--set integrator.guiding.model=box.model: error: ",
                 "was learned by 'stub_segments', which the learner 'stub_direction' cannot read"});
}

}  // namespace
}  // namespace pharos::testing
