// `pharos render --preview`: the image is the same, whatever the viewer does.

#include <chrono>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>

#include "refusal.h"
#include "tev_listener.h"

namespace pharos::testing {
namespace {

/// A config whose image fills the buffers of the connection if the viewer reads nothing: 9.6 MB of
/// colors.
std::string large_render() {
  return "scene: { sensor: { type: perspective, to_world: { translate: [0, 0, 5] } }, "
         "shapes: [sphere], emitters: [constant] }\n"
         "film: { width: 1000, height: 800 }\nbudget: { spp: 2 }\noutput: { png: false }\n";
}

struct Timed {
  Outcome outcome;
  Image image;
  double seconds = 0;
};

/// Renders image.exr from large_render() with further options.
Timed render_timed(const std::string& options) {
  const ScratchFolder folder;
  folder.write("image.yaml", large_render());
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = run_pharos("render image.yaml -q " + options, folder.path());
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  return {outcome, read_image(folder.path() / "image.exr"), time.count()};
}

std::string preview_at(std::uint16_t port) {
  return fmt::format("--preview 127.0.0.1:{}", port);
}

/// Time limit for a render with a viewer [s]. If a viewer could block a render, it would block it
/// forever. Shorter delays come from a busy machine.
constexpr double kPatience = 15;

TEST_CASE("--preview changes no bit and holds nothing up") {
  static const Timed alone = render_timed("");
  SUBCASE("a viewer that reads") {
    TevListener viewer(Manner::reads);
    const Timed watched = render_timed(preview_at(viewer.port()));
    CHECK(watched.outcome.exit_code == 0);
    CHECK(watched.outcome.err.empty());
    CHECK(watched.image.values() == alone.image.values());
    const ShownImage shown = show_packets(viewer.received(0));
    CHECK(shown.name == "image.exr");
    CHECK(shown.values == alone.image.values());
  }
  SUBCASE("nobody listens") {
    const Timed watched = render_timed(preview_at(silent_port()));
    CHECK(watched.outcome.exit_code == 0);
    CHECK(watched.outcome.err.find("Connection refused") != std::string::npos);
    CHECK(watched.image.values() == alone.image.values());
    CHECK(watched.seconds < alone.seconds + kPatience);
  }
  SUBCASE("a viewer that takes no data") {
    TevListener viewer(Manner::never_reads);
    const Timed watched = render_timed(preview_at(viewer.port()));
    CHECK(watched.outcome.exit_code == 0);
    CHECK(watched.outcome.err.find("no preview of the last image") != std::string::npos);
    CHECK(watched.image.values() == alone.image.values());
    CHECK(watched.seconds < alone.seconds + kPatience);
  }
  SUBCASE("a viewer that hangs up") {
    TevListener viewer(Manner::hangs_up_at_first);
    const Timed watched = render_timed(preview_at(viewer.port()));
    CHECK(watched.outcome.exit_code == 0);
    CHECK(watched.image.values() == alone.image.values());
    CHECK(show_packets(viewer.received(1)).values == alone.image.values());
  }
}

TEST_CASE("--preview with what is no address") {
  const auto typed = [](const std::string& options) {
    check_refused(
        {.arguments = "render good.yaml " + options,
         .prepare = [](const ScratchFolder& f) { f.write("good.yaml", config_with("")); }},
        {"--preview"});
  };
  typed("--preview localhost:0");
  typed("--preview localhost:70000");
  typed("--preview localhost:");
  typed("--preview ::1");
  typed("--preview ''");
  typed("--preview 'two words'");
  typed("--preview");
  typed("--preview localhost --replay 0,0,0");
}

}  // namespace
}  // namespace pharos::testing
