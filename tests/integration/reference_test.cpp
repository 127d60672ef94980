// Images against those of an independent renderer, by the protocol of statistics/image_agreement.h.

#include <filesystem>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/statistics/image_agreement.h>

#include "renders.h"

namespace pharos::testing {
namespace {

constexpr int kRenders = 32;

/// Renders of one scene at the references' resolution, with unrelated seeds.
std::vector<Image> renders(const std::string& scene, int depth, int spp,
                           const std::string& sampler) {
  std::vector<Image> images;
  for (int seed = 1; seed <= kRenders; ++seed) {
    images.push_back(render(fmt::format("scene: {}/{}/scene.yaml\n"
                                        "film: {{ width: 128, height: 128, filter: box }}\n"
                                        "sampler: {}\n"
                                        "integrator: {{ type: path, max_depth: {} }}\n"
                                        "budget: {{ spp: {} }}\nseed: {}\n",
                                        PHAROS_SCENES, scene, sampler, depth, spp, seed))
                         .image);
  }
  return images;
}

TEST_CASE("cornell-box agrees with the independent renderer") {
  const std::filesystem::path reference =
      std::filesystem::path(PHAROS_REFERENCES) / "cornell-box-halves.exr";
  if (!std::filesystem::exists(reference)) {
    MESSAGE("no reference images here: skipped");
    return;
  }
  const auto theirs = statistics::ImageSide::of_halves(read_image(reference));
  const int spp = 16;
  std::vector<Image> images = renders("cornell-box", 12, spp, "independent");
  const auto ours = statistics::ImageSide::of_renders(images, spp);
  const statistics::ImageAgreement result = statistics::compare_images(ours, theirs);
  MESSAGE(result.summary());
  CHECK(result.proven());

  // The same test must see an image that is 3 % too bright.
  for (Image& image : images) {
    for (float& value : image.values()) value *= 1.03f;
  }
  const auto brighter = statistics::ImageSide::of_renders(images, spp);
  CHECK_FALSE(statistics::compare_images(brighter, theirs).agree);
}

}  // namespace
}  // namespace pharos::testing
