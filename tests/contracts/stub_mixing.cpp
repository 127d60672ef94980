// Stub (e): a mixing policy that learns a share of unguided samples for each region by one EM step
// per iteration. If the guide refines its regions, new regions inherit the share of the old ones.

#include <algorithm>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/mixing.h>

#include "stubs.h"
#include "table.h"

namespace pharos::stubs {
namespace {

/// Shares that depend on the region of the first method that knows something at a vertex. This
/// region is the mixing key.
class RegionShares final : public MixingShares {
 public:
  RegionShares(std::vector<float> unguided, std::vector<float> weights)
      : unguided_(std::move(unguided)), weights_(std::move(weights)) {}

  std::uint32_t at(const MixingQuery& query, std::span<float> shares) const override {
    const auto knows = [](const Place& place) { return place.evidence > 0; };
    const auto first = std::find_if(query.places.begin(), query.places.end(), knows);
    share_by_weight(weights_, query.places, unguided_.at(first->region), shares);
    return first->region;
  }

 private:
  std::vector<float> unguided_;  ///< share of unguided samples in each region
  std::vector<float> weights_;   ///< weight of each method
};

constexpr double kLeast = 0.1, kMost = 0.9;

/// The learned data of one region.
struct Region {
  double total = 0, unguided = 0;  ///< sums since the last update
  double share = 0.5;              ///< share of unguided samples
  void archive(Archive& archive) {
    archive(total, unguided, share);
    archive.expect(share >= kLeast && share <= kMost, "a region's share");
  }
};

class StubMixingState final : public MixingState {
 public:
  explicit StubMixingState(std::span<const float> weights)
      : weights_(weights.begin(), weights.end()) {}

  void absorb(const PathLog& log) override {
    for_each_step(log, [&](const PathView& path, std::size_t i, double weight) {
      const RecordedVertex& vertex = path.vertices[i];
      if (vertex.mixing_key == kNoMixing) return;
      const Technique& unguided = path.techniques(vertex)[0];
      Region& region = regions_.at(vertex.mixing_key);
      region.total += weight;
      region.unguided += weight * unguided.share * unguided.density / vertex.pdf;
    });
  }

  void update(std::uint32_t regions, std::span<const std::uint32_t> origins, bool) override {
    for (Region& region : regions_) {
      if (!(region.total > 0)) continue;
      region.share = std::clamp(region.unguided / region.total, kLeast, kMost);
    }
    std::vector<Region> next(regions);
    for (std::uint32_t i = 0; i < regions; ++i) {
      const std::uint32_t origin = origins.empty() ? i : origins[i];
      if (origin < regions_.size()) next[i].share = regions_[origin].share;
    }
    regions_ = std::move(next);
  }

  std::shared_ptr<const MixingShares> shares() const override {
    std::vector<float> unguided;
    for (const Region& region : regions_) unguided.push_back(static_cast<float>(region.share));
    return std::make_shared<RegionShares>(std::move(unguided), weights_);
  }

  void archive(Archive& archive) override { archive(regions_); }

 private:
  std::vector<float> weights_;
  std::vector<Region> regions_;
};

class StubMixing final : public MixingPolicy {
 public:
  using Settings = NoSettings;
  explicit StubMixing(Settings) {}
  std::unique_ptr<MixingState> begin(std::span<const float> weights) const override {
    return std::make_unique<StubMixingState>(weights);
  }
};

}  // namespace

void register_mixing(Registry& registry) {
  registry.add<StubMixing>("stub_learned", "A share for each region");
}

}  // namespace pharos::stubs
