// Checks of made-up command lines.

#include "command_lines.h"

#include <string>

#include <doctest/doctest.h>

namespace pharos::docs {
namespace {

CommandCheck check(const std::string& commands, const std::string& language = "") {
  const Workbench bench;
  return check_commands(parse_page("```" + language + "\n" + commands + "\n```\n"), bench);
}

void check_right(const std::string& commands, int executed) {
  CAPTURE(commands);
  const CommandCheck result = check(commands);
  CHECK(result.checked > 0);
  CHECK(result.executed == executed);
  for (const std::string& problem : result.problems) FAIL_CHECK(problem);
}

void check_wrong(const std::string& commands, const std::string& says) {
  CAPTURE(commands);
  const CommandCheck result = check(commands);
  REQUIRE(result.problems.size() == 1);
  CAPTURE(result.problems[0]);
  CHECK(result.problems[0].starts_with("line 2: "));
  CHECK(result.problems[0].find(says) != std::string::npos);
}

TEST_CASE("commands: those that are run") {
  check_right("./run plugins path\npharos plugins sampler", 2);
  check_right("./run pharos validate configs/cornell-box.yaml", 1);
  check_right("./run pharos points --sampler sobol -n 16 --realizations 2 -o points.png", 1);
  check_right("./run render configs/cornell-box.yaml --set 'budget={ seconds: 20 }'", 1);
  check_right("./run render configs/cornell-box.yaml --replay 256,300,7", 1);
  check_right(
      "./run render configs/cornell-box.yaml --set output.model=a.model \\\n"
      "  --set 'integrator.guiding={ learner: focal, guider: focal }'\n"
      "./run inspect a.model --slice y=0 -o slice.png",
      2);
}

TEST_CASE("commands: those that are not run") {
  check_right("./run render CONFIG --set film.width=256", 0);
  check_right("./run render configs/cornell-box.yaml --set 'integrator.guiding=…'", 0);
  check_right("./run inspect hole.model --cloud -o cloud.png", 0);
  check_right("./run compare A.exr B.exr --reference R.exr --json -", 0);
  check_right("./run test -L bsdfs", 0);
  check_right("PHAROS_MODULE_PATH=build/plugins ./run pharos plugins stripes", 0);
  check_right("./run experiment configs/experiments/samplers-quick.yaml", 0);
  check_right(
      "pharos conformance [NAME|CONTRACT]… [--module M] [--all]\n"
      "pharos synthesize, pharos directions   commands of a module",
      0);
  CHECK(check("cmake -B build\nninja no-such-target").checked == 0);
  CHECK(check("./run no-such-command", "cpp").checked == 0);
}

TEST_CASE("commands: mistakes are found") {
  check_wrong("./run rendre CONFIG", "./run has no command 'rendre'");
  check_wrong("pharos rendre CONFIG", "pharos has no command 'rendre'");
  check_wrong("./run points -o points.png", "./run has no command 'points'");
  check_wrong("./run render CONFIG --spp 4", "'render' has no option '--spp'");
  check_wrong("pharos render CONFIG [--spp N] [--quiet]", "'render' has no option '--spp'");
  check_wrong("./run inspect a.model -x", "'inspect' has no option '-x'");
  check_wrong("./run render configs/no-such-config.yaml", "no 'configs/no-such-config.yaml'");
  check_wrong("./run render cornell-box.yaml", "no 'cornell-box.yaml'");
  check_wrong("./run inspect a.model --scene configs/x", "no 'configs/x'");
  check_wrong("./run plugins pth", "'path'");
  check_wrong("./run render configs/cornell-box.yaml --set film.widht=3", "'width'");
  check_wrong("./run experiment configs/experiments/gone.yaml", "gone.yaml");
}

TEST_CASE("commands: plugins that the page teaches to write need not exist") {
  const Workbench bench;
  const std::string use = "```\n./run plugins glossy\n```\n";
  CHECK(check_commands(parse_page(use), bench).problems.size() == 1);
  const std::string code = "```cpp\n  registry.add<pharos::Glossy>(\"glossy\", \"A lobe\");\n```\n";
  CHECK(check_commands(parse_page(code + use), bench).problems.empty());
}

}  // namespace
}  // namespace pharos::docs
