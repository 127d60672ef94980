// Stub (a): a method that guides directions only. Its model has a row of cells along x, each with a
// histogram of incident radiance over directions. With `refine`, the number of cells doubles in
// every iteration, and the learned mixing policy (e) must follow.

#include <algorithm>
#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/radiance_estimate.h>

#include "stubs.h"
#include "table.h"

namespace pharos::stubs {
namespace {

constexpr std::uint32_t kRows = 4, kColumns = 8, kBins = kRows * kColumns;
constexpr std::uint32_t kFinestCells = 8;

std::uint32_t bin_of(Vec3 direction) {
  const Vec2 u = warp::square_from_sphere(direction);
  const auto column = std::min(static_cast<std::uint32_t>(u.x * kColumns), kColumns - 1);
  const auto row = std::min(static_cast<std::uint32_t>(u.y * kRows), kRows - 1);
  return row * kColumns + column;
}

/// Returns the cell of a point, among `count` cells of equal width along x.
std::uint32_t cell_of(Point3 p, const Bounds3& region, std::uint32_t count) {
  const float x = (p.x - region.low.x) / std::max(region.extent().x, 1e-20f);
  return static_cast<std::uint32_t>(
      std::clamp(x * static_cast<float>(count), 0.0f, static_cast<float>(count - 1)));
}

class BinRadiance final : public RadianceAround {
 public:
  explicit BinRadiance(const double* bins) : bins_(bins) {}
  float relative(Vec3 direction) const override {
    return static_cast<float>(kBins * bins_[bin_of(direction)]);
  }

 private:
  const double* bins_;
};

class DirectionModel final : public TableModel, public RadianceEstimate {
 public:
  static constexpr std::string_view kName = "stub_direction";
  using TableModel::TableModel;

  RadianceTraits radiance_traits() const override { return {.around = true}; }
  const RadianceAround* radiance_around(const GuidingQuery& query, Arena& arena) const override {
    return table().empty() ? nullptr : arena.make<BinRadiance>(histogram(query.region));
  }

  ModelInfo info() const override {
    ModelInfo info = table_info(kName);
    info.regions = std::max(cell_count(), 1u);
    return info;
  }
  void archive(Archive& archive) override { archive_table(archive, kBins, kFinestCells); }
  Place place(const GuidingVertex& vertex) const override {
    Place place = TableModel::place(vertex);
    if (place.evidence > 0) place.region = cell(vertex.position);
    return place;
  }
  double density(Point3 p, const Vec3* direction) const override {
    return direction == nullptr ? 1 : histogram(cell(p))[bin_of(*direction)];
  }

  /// Returns the probabilities of the bins of a cell, which add up to one.
  const double* histogram(std::uint32_t cell) const { return table().data() + cell * kBins; }

 private:
  std::uint32_t cell_count() const { return static_cast<std::uint32_t>(table().size() / kBins); }
  std::uint32_t cell(Point3 p) const { return cell_of(p, region(), cell_count()); }
};

class DirectionState final : public TableState {
 public:
  DirectionState(const LearningContext& context, bool refine)
      : TableState(kFinestCells * kBins), region_(context.region), refine_(refine) {}

  void absorb(const PathLog& log) override {
    for_each_step(log, [&](const PathView& path, std::size_t i, double weight) {
      const RecordedVertex& vertex = path.vertices[i];
      const std::uint32_t cell = cell_of(vertex.position, region_, kFinestCells);
      sums_[cell * kBins + bin_of(vertex.direction)] += weight;
    });
  }

  Learned update(const TrainingStage&) override {
    const bool refines = refine_ && cells_ > 0 && cells_ < kFinestCells;
    cells_ = cells_ == 0 ? 1 : refines ? 2 * cells_ : cells_;
    Table table{std::vector<double>(cells_ * kBins), region_};
    for (std::uint32_t i = 0; i < sums_.size(); ++i) {
      const std::uint32_t cell = i / kBins * cells_ / kFinestCells;
      table.values[cell * kBins + i % kBins] += sums_[i];
    }
    for (std::uint32_t cell = 0; cell < cells_; ++cell) {
      normalize(table.values.data() + cell * kBins);
    }
    Learned learned{std::make_shared<DirectionModel>(std::move(table))};
    for (std::uint32_t i = 0; refines && i < cells_; ++i) learned.region_origins.push_back(i / 2);
    return learned;
  }

  void archive(Archive& archive) override {
    TableState::archive(archive);
    archive(cells_);
    archive.expect(cells_ <= kFinestCells, "the number of cells");
  }

 private:
  /// Normalizes the bins of a cell: nine parts learned, one part uniform.
  static void normalize(double* bins) {
    double total = 0;
    for (std::uint32_t b = 0; b < kBins; ++b) total += bins[b];
    for (std::uint32_t b = 0; b < kBins; ++b) {
      bins[b] = 0.1 / kBins + 0.9 * (total > 0 ? bins[b] / total : 1.0 / kBins);
    }
  }

  Bounds3 region_;
  bool refine_;
  std::uint32_t cells_ = 0;
};

class DirectionLearner final : public Learner {
 public:
  struct Settings {
    bool refine = false;
    static void describe(Schema<Settings>& s) {
      s.field("refine", &Settings::refine, "Double the number of regions each iteration");
    }
  };
  explicit DirectionLearner(Settings settings) : settings_(settings) {}

  LearnerTraits traits() const override { return {.records = {.light_samples = true}}; }
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override {
    return std::make_unique<DirectionState>(context, settings_.refine);
  }
  std::shared_ptr<GuidingModel> empty_model() const override {
    return std::make_shared<DirectionModel>();
  }

 private:
  Settings settings_;
};

struct DirectionGuiderSettings {
  bool adversarial = false;
  float pdf_scale = 1;

  static void describe(Schema<DirectionGuiderSettings>& s) {
    s.field("adversarial", &DirectionGuiderSettings::adversarial,
            "Prefer directions that the model considers unlikely: inefficient, but unbiased");
    s.field("pdf_scale", &DirectionGuiderSettings::pdf_scale,
            "Planted fault: factor on the density");
  }
};

class DirectionDistribution final : public GuidingDistribution {
 public:
  DirectionDistribution(const DirectionModel& model, std::uint32_t cell,
                        const DirectionGuiderSettings& settings, double* bins)
      : bins_(bins), pdf_scale_(settings.pdf_scale) {
    double total = 0;
    for (std::uint32_t b = 0; b < kBins; ++b) {
      const double p = model.histogram(cell)[b];
      total += bins_[b] = settings.adversarial ? 1 / p : p;
    }
    for (std::uint32_t b = 0; b < kBins; ++b) bins_[b] /= total;
  }

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    double u = stream.get_1d(Purpose::guide_choice);
    std::uint32_t bin = 0;
    while (bin + 1 < kBins && u >= bins_[bin]) u -= bins_[bin++];
    const Vec2 v = stream.get_2d(Purpose::guide_direction);
    const Vec2 square{(static_cast<float>(bin % kColumns) + v.x) / kColumns,
                      (static_cast<float>(bin / kColumns) + v.y) / kRows};
    return Proposal{.direction = warp::sphere_from_square(square)};
  }
  float density(const ResolvedVertex& vertex) const override {
    const double per_bin = bins_[bin_of(vertex.direction)] * kBins;
    return pdf_scale_ * static_cast<float>(per_bin) * warp::sphere_pdf();
  }

 private:
  double* bins_;
  float pdf_scale_;
};

class DirectionGuider final : public GuiderOf<DirectionModel> {
 public:
  using Settings = DirectionGuiderSettings;
  explicit DirectionGuider(Settings settings) : settings_(settings) {}

  GuiderTraits traits() const override { return {.guides_light_paths = true}; }
  const GuidingDistribution* query(const DirectionModel& model, const GuidingQuery& query,
                                   Arena& arena) const override {
    return arena.make<DirectionDistribution>(model, query.region, settings_,
                                             arena.make_array<double>(kBins));
  }

 private:
  Settings settings_;
};

}  // namespace

void register_direction(Registry& registry) {
  registry.add<DirectionLearner>("stub_direction", "Histogram of incident radiance");
  registry.add<DirectionGuider>("stub_direction", "Directions from the histogram");
}

}  // namespace pharos::stubs
