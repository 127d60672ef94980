#include "../model.h"

#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>

#include "../seen_mixture.h"

namespace pharos::spatial_gaussians {
namespace {

/// Returns a model whose cells have 1, 0, 8, 9 and 17 components.
SpatialGaussiansModel model_of_five_cells(RandomStream& random) {
  const auto between = [&](float low, float high) { return low + (high - low) * random.next_1d(); };
  KdTree tree;
  std::vector<SpatialGaussiansModel::Cell> cells;
  for (const int count : {1, 0, 8, 9, 17}) {
    if (!cells.empty()) tree.divide(tree.leaves().back(), 0, static_cast<float>(cells.size()));
    SpatialGaussiansModel::Cell& cell = cells.emplace_back();
    cell.samples = 100;
    for (int i = 0; i < count; ++i) {
      cell.components.push_back({1 / static_cast<float>(count),
                                 {between(-3, 3), between(-3, 3), between(-3, 3)},
                                 {between(0.1f, 1), between(-1, 1), between(0.1f, 1),
                                  between(-1, 1), between(-1, 1), between(0.1f, 1)}});
    }
  }
  return {std::move(tree), cells};
}

/// Checks that mixtures made from the whitened groups are those made from the components.
void check_whitened(const SpatialGaussiansModel& model, RandomStream& random) {
  for (std::uint32_t cell = 0; cell < 5; ++cell) {
    CAPTURE(cell);
    const GuidingQuery query{.region = cell};
    Arena arena;
    const auto components = model.mixture_at(query, arena);
    const auto whitened = model.whitened_at(query);
    REQUIRE(whitened.size() == (components.size() + 7) / 8);
    if (components.empty()) continue;
    for (const Technique technique : {Technique::exact, Technique::flipped, Technique::plane}) {
      const SeenMixture* kept =
          SeenMixture::make(components, {0.5f, 0, 0}, {}, technique, arena, whitened);
      const SeenMixture* made = SeenMixture::make(components, {0.5f, 0, 0}, {}, technique, arena);
      for (int i = 0; i < 50; ++i) {
        const Vec3 direction = warp::sphere_from_square(random.next_2d());
        CHECK(kept->density(direction) == made->density(direction));
      }
    }
  }
}

TEST_CASE("models keep the whitened components of each cell, also after loading") {
  RandomStream random(3);
  SpatialGaussiansModel model = model_of_five_cells(random);
  check_whitened(model, random);
  std::ostringstream out;
  save(out, model);
  std::istringstream in(out.str());
  SpatialGaussiansModel loaded;
  load(in, loaded);
  check_whitened(loaded, random);
}

}  // namespace
}  // namespace pharos::spatial_gaussians
