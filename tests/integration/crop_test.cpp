// Renders of a window of the film (film.crop).

#include <bit>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "renders.h"

namespace pharos::testing {
namespace {

constexpr PixelRect kWindow{11, 5, 40, 23};

std::string cornell(const std::string& film, const std::string& rest) {
  return fmt::format(
      "scene: {}/cornell-box/scene.yaml\nfilm: {{ width: 48, height: 40, tile: 16, {} }}\n{}",
      PHAROS_SCENES, film, rest);
}

std::string crop(const PixelRect& window) {
  return fmt::format("crop: {{ x: {}, y: {}, width: {}, height: {} }}", window.x0, window.y0,
                     window.width(), window.height());
}

/// Returns the number of values of `part` that differ in any bit from the values of `whole` at the
/// position of the window. A border of `border` pixels is left out.
int differences(const Image& part, const Image& whole, int border) {
  int count = 0;
  for (int y = border; y < part.height() - border; ++y) {
    for (int x = border; x < part.width() - border; ++x) {
      for (int c = 0; c < part.channel_count(); ++c) {
        const float a = part.pixel(x, y)[c], b = whole.pixel(kWindow.x0 + x, kWindow.y0 + y)[c];
        count += std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ? 0 : 1;
      }
    }
  }
  return count;
}

TEST_CASE("a window has the bits of the whole picture, whatever the sampler") {
  for (const char* sampler : {"independent", "sobol"}) {
    CAPTURE(sampler);
    const std::string rest = fmt::format("sampler: {}\nbudget: {{ spp: 16 }}\n", sampler);
    const Image whole = render(cornell("filter: box", rest)).image;
    const RenderResult part = render(cornell("filter: box, " + crop(kWindow), rest));
    REQUIRE(part.image.width() == kWindow.width());
    REQUIRE(part.image.height() == kWindow.height());
    CHECK(part.counters.paths == 16 * kWindow.area());
    CHECK(part.samples_per_pixel == 16);
    CHECK(differences(part.image, whole, 0) == 0);
    CHECK(differences(render(cornell("filter: box, " + crop(kWindow), rest + "seed: 2\n")).image,
                      whole, 0) > 0);
  }
}

TEST_CASE("a window has other bits only where the filter reaches beyond it") {
  const std::string rest = "budget: { spp: 8 }\n", filter = "filter: { type: tent, radius: 2 }";
  const Image whole = render(cornell(filter, rest)).image;
  const Image part = render(cornell(filter + ", " + crop(kWindow), rest)).image;
  CHECK(differences(part, whole, 2) == 0);
  CHECK(differences(part, whole, 0) > 0);
}

TEST_CASE("a window of one pixel, and one that is the whole film") {
  const std::string rest = "budget: { spp: 4 }\n";
  const Image whole = render(cornell("filter: box", rest)).image;
  const Image pixel = render(cornell("filter: box, " + crop({47, 39, 48, 40}), rest)).image;
  REQUIRE(pixel.values().size() == static_cast<std::size_t>(pixel.channel_count()));
  CHECK(pixel.rgb(0, 0) == whole.rgb(47, 39));
  const Image all = render(cornell("filter: box, " + crop({0, 0, 48, 40}), rest)).image;
  CHECK(all.values().size() == whole.values().size());
  CHECK(all.rgb(20, 20) == whole.rgb(20, 20));
}

TEST_CASE("a window may be part of a film that is too large to render") {
  const LoadedConfig loaded = config_from(
      fmt::format("scene: {}/cornell-box/scene.yaml\nbudget: {{ spp: 1 }}\n"
                  "film: {{ width: 32768, height: 32768, crop: {{ x: 20000, y: 16000, width: 4, "
                  "height: 3 }} }}\n",
                  PHAROS_SCENES));
  const Image image = RenderJob(loaded.config).run().image;
  CHECK(image.width() == 4);
  CHECK(image.height() == 3);
  CHECK(image_mean(image) > 0);
}

TEST_CASE("paths are replayed by their pixel of the whole film") {
  const std::string rest = "sampler: independent\nbudget: { spp: 1 }\n";
  const std::string film = "filter: box, " + crop(kWindow);
  const LoadedConfig loaded = config_from(cornell(film, rest));
  RenderJob job(loaded.config);
  const Rgb seen = job.run().image.rgb(20 - kWindow.x0, 15 - kWindow.y0);
  const Rgb replayed = job.replay(20, 15, 0, 0).radiance;
  CHECK(seen.r == doctest::Approx(replayed.r));
  CHECK(seen.g == doctest::Approx(replayed.g));
}

}  // namespace
}  // namespace pharos::testing
