// Renders with a preview: what arrives at a viewer, and that no viewer can block a render.

#include <chrono>
#include <cstring>
#include <thread>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/rendering/tev_preview.h>

#include "renders.h"
#include "tev_listener.h"

namespace pharos::testing {
namespace {

using Clock = std::chrono::steady_clock;

/// A preview to 127.0.0.1 that stores its warnings.
struct Watched {
  explicit Watched(std::uint16_t port)
      : preview({"127.0.0.1", port}, "folder/image.exr",
                [this](const std::string& message) { warnings.push_back(message); }) {}

  /// Shows an image as the image of a render that is half done, one second after the previous
  /// image.
  void show(const Image& image) {
    seconds += 1;
    preview.show({.progress = {.fraction = 0.5, .seconds = seconds}, .image = [&] {
                    ++images_made;
                    return image;
                  }});
  }

  double seconds = 0;
  int images_made = 0;
  std::vector<std::string> warnings;
  TevPreview preview;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Calls `step` until `done` is true. Returns false if this takes more than ten seconds.
template <class Done, class Step>
bool repeat_until(Done&& done, Step&& step) {
  for (const auto start = Clock::now(); seconds_since(start) < 10;) {
    if (done()) return true;
    step();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

Image some_image(int width, int height, float scale = 0.37f) {
  Image image(width, height, {"R", "G", "B", "depth.Z"});
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    image.values()[i] = static_cast<float>(i) * scale - 5;
  }
  return image;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// Checks that the packets of a connection result in the colors of `image`.
void check_shown(const std::string& bytes, const Image& image) {
  const ShownImage shown = show_packets(bytes);
  CHECK(shown.name == "folder/image.exr");
  CHECK(shown.focus);
  CHECK(shown.channels == std::vector<std::string>{"R", "G", "B"});
  CHECK(shown.width == image.width());
  CHECK(shown.height == image.height());
  CHECK(same_bits(shown.values, select_layers(image, {}).values()));
}

TEST_CASE("a watched render: the viewer ends with its image, which has the same bits") {
  const std::string yaml = fmt::format(
      "scene: {}/cornell-box/scene.yaml\nfilm: {{ width: 48, height: 40 }}\n"
      "sampler: independent\nbudget: {{ spp: 32 }}\n",
      PHAROS_SCENES);
  TevListener viewer(Manner::reads);
  Watched watched(viewer.port());
  bool seen = false;
  RenderControl control;
  control.on_pass = [&](const RenderSnapshot& snapshot) {
    seen = seen || repeat_until([&] { return viewer.byte_count() > 0; },
                                [&] { watched.preview.show(snapshot); });
  };
  const LoadedConfig loaded = config_from(yaml);
  const RenderResult result = RenderJob(loaded.config).run(control);
  watched.preview.show_last(result.image);
  watched.preview.finish();
  CHECK(seen);
  CHECK(watched.warnings.empty());
  const std::string bytes = viewer.received(0);
  check_shown(bytes, result.image);
  CHECK(show_packets(bytes).updates >= 2);
  CHECK(same_bits(result.image.values(), render(yaml).image.values()));
}

TEST_CASE("large images come in packets that every version of tev takes") {
  const Image image = some_image(700, 301);
  TevListener viewer(Manner::reads);
  Watched watched(viewer.port());
  watched.preview.show_last(image);
  watched.preview.finish();
  const std::string bytes = viewer.received(0);
  check_shown(bytes, image);
  CHECK(show_packets(bytes).largest_packet <= 1u << 20);
  CHECK(watched.warnings.empty());
}

TEST_CASE("nobody listens: no image is made, one warning at once and one at the end") {
  Watched watched(silent_port());
  const Image image = some_image(4, 4);
  REQUIRE(repeat_until([&] { return !watched.warnings.empty(); }, [&] { watched.show(image); }));
  for (int i = 0; i < 5; ++i) watched.show(image);
  watched.preview.show_last(image);
  watched.preview.finish();
  CHECK(watched.images_made == 0);
  REQUIRE(watched.warnings.size() == 2);
  CHECK(watched.warnings[0].find("no preview for now") != std::string::npos);
  CHECK(watched.warnings[1].find("the last image") != std::string::npos);
  for (const std::string& warning : watched.warnings) {
    CHECK(warning.find("127.0.0.1:") != std::string::npos);
    CHECK(warning.find("Connection refused") != std::string::npos);
  }
}

TEST_CASE("a viewer that is started late gets the image") {
  const std::uint16_t port = silent_port();
  Watched watched(port);
  const Image image = some_image(30, 20);
  REQUIRE(repeat_until([&] { return !watched.warnings.empty(); }, [&] { watched.show(image); }));
  TevListener viewer(Manner::reads, port);
  SUBCASE("while the render goes on") {
    CHECK(repeat_until([&] { return viewer.byte_count() > 0; }, [&] { watched.show(image); }));
  }
  SUBCASE("just before it ends") {}
  const Image last = some_image(30, 20, 1.5f);
  watched.preview.show_last(last);
  watched.preview.finish();
  check_shown(viewer.received(0), last);
  CHECK(watched.warnings.size() == 1);
}

/// Shows an image to a viewer that closes the connection, and shows it again after the viewer is
/// back.
void check_shown_again(const Image& image, bool before_the_end) {
  TevListener viewer(Manner::hangs_up_at_first);
  Watched watched(viewer.port());
  REQUIRE(repeat_until([&] { return viewer.byte_count() > 0; }, [&] { watched.show(image); }));
  REQUIRE_FALSE(viewer.received(0).empty());
  if (before_the_end) {
    CHECK(repeat_until([&] { return viewer.connections() > 1; }, [&] { watched.show(image); }));
  }
  watched.preview.show_last(image);
  watched.preview.finish();
  check_shown(viewer.received(1), image);
}

TEST_CASE("a viewer that hangs up gets the whole image when it is back") {
  // When the viewer closes the connection, the small image has been sent completely, and the large
  // one has not.
  for (const int width : {20, 3000}) {
    CAPTURE(width);
    check_shown_again(some_image(width, 400), true);
    check_shown_again(some_image(width, 400), false);
  }
}

TEST_CASE("a viewer that takes no data holds nothing up") {
  TevListener viewer(Manner::never_reads);
  Watched watched(viewer.port());
  const Image image = some_image(2048, 1024);  // 24 MiB, more than the buffers hold
  REQUIRE(repeat_until([&] { return watched.images_made > 0; }, [&] { watched.show(image); }));
  const auto start = Clock::now();
  watched.show(image);
  watched.preview.show_last(image);
  CHECK(seconds_since(start) < 1);
  watched.preview.finish();
  CHECK(seconds_since(start) < TevPreview::kLastSeconds + 2);
  REQUIRE(watched.warnings.size() == 1);
  CHECK(watched.warnings[0].find("no answer in time") != std::string::npos);
}

TEST_CASE("a preview that is given up mid-render ends at once") {
  TevListener viewer(Manner::never_reads);
  const auto start = Clock::now();
  {
    Watched watched(viewer.port());
    watched.preview.show_last(some_image(2048, 1024));
    CHECK(repeat_until([&] { return viewer.connections() > 0; }, [] {}));
  }
  CHECK(seconds_since(start) < 5);
}

TEST_CASE("a host without an address is a warning") {
  std::vector<std::string> warnings;
  TevPreview preview({"no-such-host.invalid", 1}, "x",
                     [&](const std::string& message) { warnings.push_back(message); });
  preview.show_last(some_image(2, 2));
  preview.finish();
  CHECK(warnings.size() == 1);
}

}  // namespace
}  // namespace pharos::testing
