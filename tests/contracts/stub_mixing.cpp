// Stub (e): a mixing policy that learns a fraction for each region by one EM step an iteration, and
// carries what it learned over when the guide's regions are refined.

#include <algorithm>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/mixing.h>

#include "stubs.h"
#include "table.h"

namespace pharos::stubs {
namespace {

class RegionFractions final : public MixingFractions {
 public:
  explicit RegionFractions(std::vector<float> fractions) : fractions_(std::move(fractions)) {}
  float unguided_fraction(std::uint32_t region) const override { return fractions_.at(region); }

 private:
  std::vector<float> fractions_;
};

class StubMixingState final : public MixingState {
 public:
  void absorb(const PathLog& log) override {
    for_each_step(log, [&](const PathView& path, std::size_t i, double weight) {
      const RecordedVertex& vertex = path.vertices[i];
      if (vertex.guided_pdf == 0) return;
      Region& region = regions_.at(vertex.region);
      region.total += weight;
      region.unguided += weight * vertex.unguided_fraction * vertex.unguided_pdf / vertex.pdf();
    });
  }

  std::shared_ptr<const MixingFractions> update(std::uint32_t region_count,
                                                std::span<const std::uint32_t> origins) override {
    for (Region& region : regions_) {
      if (region.total > 0) {
        region.fraction = std::clamp(region.unguided / region.total, 0.1, 0.9);
      }
    }
    std::vector<Region> next(region_count);
    std::vector<float> fractions;
    for (std::uint32_t i = 0; i < region_count; ++i) {
      const std::uint32_t origin = origins.empty() ? i : origins[i];
      if (origin < regions_.size()) next[i].fraction = regions_[origin].fraction;
      fractions.push_back(static_cast<float>(next[i].fraction));
    }
    regions_ = std::move(next);
    return std::make_shared<RegionFractions>(std::move(fractions));
  }

  void save(std::ostream& out) const override {
    std::vector<double> table;
    for (const Region& r : regions_) table.insert(table.end(), {r.total, r.unguided, r.fraction});
    write_table(out, table);
  }
  void load(std::istream& in) override {
    const std::vector<double> table = read_table(in, 3 * regions_.size());
    for (std::size_t i = 0; i < regions_.size(); ++i) {
      regions_[i] = {table[3 * i], table[3 * i + 1], table[3 * i + 2]};
    }
  }
  void merge(const MixingState& other) override {
    const auto& theirs = static_cast<const StubMixingState&>(other).regions_;
    for (std::size_t i = 0; i < regions_.size(); ++i) {
      regions_[i].total += theirs[i].total;
      regions_[i].unguided += theirs[i].unguided;
    }
  }

 private:
  struct Region {
    double total = 0, unguided = 0;
    double fraction = 0.5;
  };
  std::vector<Region> regions_;
};

class StubMixing final : public MixingPolicy {
 public:
  using Settings = NoSettings;
  explicit StubMixing(Settings) {}
  std::unique_ptr<MixingState> begin() const override {
    return std::make_unique<StubMixingState>();
  }
};

}  // namespace

void register_mixing(Registry& registry) {
  registry.add<StubMixing>("stub_learned", "A fraction for each region");
}

}  // namespace pharos::stubs
