#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <pharos/core/parallel.h>

#include "pixel_regions.h"

namespace pharos::aligned {
namespace {

/// The pixels of a block that see one surface. The first of these pixels represents the surface.
struct Patch {
  FirstHit hit;
  std::uint32_t pixels = 0;
  std::uint32_t region = 0;  ///< the patch that this patch has joined, initially itself
};

/// Returns whether two first hits lie on the same surface.
class IsSameSurface {
 public:
  explicit IsSameSurface(const SurfaceSettings& settings)
      : least_cosine_(std::cos(radians(settings.angle))), depth_(settings.depth) {}

  bool operator()(const FirstHit& a, const FirstHit& b) const {
    if (std::isinf(a.depth) || std::isinf(b.depth)) {
      return std::isinf(a.depth) && std::isinf(b.depth);
    }
    return a.object == b.object && dot(a.normal, b.normal) >= least_cosine_ &&
           std::abs(a.depth - b.depth) <= depth_ * std::min(a.depth, b.depth);
  }

 private:
  float least_cosine_, depth_;
};

std::vector<FirstHit> first_hits(const IntegrandProbe& probe) {
  const PixelGrid grid = probe.grid();
  const auto width = static_cast<std::size_t>(grid.width);
  std::vector<FirstHit> hits(width * static_cast<std::size_t>(grid.height));
  parallel_for(static_cast<std::size_t>(grid.height), [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x) {
      hits[y * width + x] = probe.first_hit(static_cast<int>(x), static_cast<int>(y));
    }
  });
  return hits;
}

/// The patches of a film's blocks, block after block.
class Patches {
 public:
  Patches(const PixelGrid& grid, int edge, const std::vector<FirstHit>& hits,
          const IsSameSurface& is_same)
      : columns_((grid.width + edge - 1) / edge),
        blocks_(block_regions(grid, edge)),
        is_same_(is_same),
        patch_of_(hits.size()) {
    for (std::size_t block = 0; block < blocks_.count(); ++block) {
      starts_.push_back(patches_.size());
      for (const std::uint32_t pixel : blocks_.pixels(block)) {
        const std::size_t patch = patch_for(hits[pixel], starts_.back());
        ++patches_[patch].pixels;
        patch_of_[pixel] = static_cast<std::uint32_t>(patch);
      }
    }
    starts_.push_back(patches_.size());
  }

  /// Lets patches with fewer than `fewest` pixels join patches that are large enough.
  void join_small(std::uint32_t fewest) {
    for (std::size_t block = 0; block < blocks_.count(); ++block) {
      for (std::size_t i = starts_[block]; i < starts_[block + 1]; ++i) {
        if (patches_[i].pixels < fewest) patches_[i].region = partner_of(i, block, fewest);
      }
    }
  }

  /// Returns the region of each pixel.
  std::vector<std::uint32_t> regions() const {
    std::vector<std::uint32_t> regions;
    // A patch may join a patch that has itself joined another. The patch at the end is large enough
    // to remain.
    for (const std::uint32_t patch : patch_of_) {
      regions.push_back(patches_[patches_[patch].region].region);
    }
    return regions;
  }

 private:
  /// Returns the patch of this surface among the patches from index `first` on. Adds a patch if
  /// there is none.
  std::size_t patch_for(const FirstHit& hit, std::size_t first) {
    for (std::size_t i = first; i < patches_.size(); ++i) {
      if (is_same_(patches_[i].hit, hit)) return i;
    }
    patches_.push_back({.hit = hit, .region = static_cast<std::uint32_t>(patches_.size())});
    return patches_.size() - 1;
  }

  /// Returns the largest patch of the same surface in one of the four neighboring blocks. If this
  /// patch has too few pixels, returns the largest patch of the block itself. Of patches of equal
  /// size, the first is taken. The result may be the patch itself.
  std::uint32_t partner_of(std::size_t patch, std::size_t block, std::uint32_t fewest) const {
    std::size_t best = patch;
    const auto take_larger = [&](std::size_t i) {
      if (patches_[i].pixels > patches_[best].pixels) best = i;
    };
    const auto column = static_cast<int>(block) % columns_;
    const auto row = static_cast<int>(block) / columns_;
    const int rows = static_cast<int>(blocks_.count()) / columns_;
    for (const auto& [dx, dy] : {std::pair{0, -1}, {-1, 0}, {1, 0}, {0, 1}}) {
      const int x = column + dx, y = row + dy;
      if (x < 0 || y < 0 || x >= columns_ || y >= rows) continue;
      const auto other = static_cast<std::size_t>(y * columns_ + x);
      for (std::size_t i = starts_[other]; i < starts_[other + 1]; ++i) {
        if (is_same_(patches_[i].hit, patches_[patch].hit)) take_larger(i);
      }
    }
    if (patches_[best].pixels >= fewest) return static_cast<std::uint32_t>(best);
    best = starts_[block];
    for (std::size_t i = starts_[block]; i < starts_[block + 1]; ++i) take_larger(i);
    return static_cast<std::uint32_t>(best);
  }

  int columns_;
  PixelRegions blocks_;
  IsSameSurface is_same_;
  std::vector<Patch> patches_;
  std::vector<std::size_t> starts_;      ///< first patch of each block, and the end
  std::vector<std::uint32_t> patch_of_;  ///< patch of each pixel
};

}  // namespace

PixelRegions surface_regions(const IntegrandProbe& probe, int edge,
                             const SurfaceSettings& settings) {
  Patches patches(probe.grid(), edge, first_hits(probe), IsSameSurface(settings));
  patches.join_small(settings.fewest);
  return PixelRegions(patches.regions());
}

}  // namespace pharos::aligned
