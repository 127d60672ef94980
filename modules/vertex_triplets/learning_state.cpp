#include "learning_state.h"

#include <algorithm>
#include <numeric>

#include <pharos/core/binary_stream.h>
#include <pharos/core/counting_sort.h>
#include <pharos/core/random.h>

namespace pharos::vertex_triplets {
namespace {

constexpr const char* kHeading = "learning of vertex triplets";
constexpr std::uint32_t kVersion = 1;
/// Samples that wait at most (44 bytes each).
constexpr std::size_t kBatch = 1u << 20;

/// Random numbers of one lesson are keyed by what they are for.
enum class Draw : std::uint64_t { jitter = 1, insert, join };

/// The cube around a region; around nothing one of size one.
Cube cube_around(const Bounds3& region) {
  if (region.empty()) return {};
  const Vec3 e = region.extent();
  const float largest = std::max({e.x, e.y, e.z});
  return {region.center(), largest > 0 ? largest : 1.0f};
}

float size_of(const Bounds3& region) {
  return region.diagonal() > 0 ? region.diagonal() : 1.0f;
}

}  // namespace

VertexTripletsLearningState::VertexTripletsLearningState(const VertexTripletsSettings& settings,
                                                         const LearningContext& context)
    : settings_(settings),
      rule_{.kind = {.prefix = settings.vertices,
                     .both_ways = settings.light_paths,
                     .environment = {settings.environment_distance * size_of(context.region)}},
            .clusters = {.most_components = settings.components,
                         .fit = {.regularization = {.deviation = settings.single_deviation,
                                                    .least_deviation = settings.least_deviation},
                                 .most_iterations = settings.em_iterations,
                                 .tolerance = settings.em_tolerance}}},
      seed_(context.seed),
      tree_(cube_around(context.region)),
      cells_{Cell{Reservoir(settings.reservoir)}} {}

void VertexTripletsLearningState::absorb(const PathLog& log) {
  const SampleRule rule{rule_.kind.environment, settings_.light_paths};
  for (std::size_t i = 0; i < log.size(); ++i) extract_samples(log[i], rule, incident_, samples_);
  if (samples_.size() < kBatch) return;
  insert();
  learned_early_ = true;
}

std::uint32_t VertexTripletsLearningState::jittered_cell(const Sample& sample,
                                                         std::uint64_t number) const {
  const Point3 place = sample.triplet.vertices[1];
  const float size = settings_.jitter * tree_.cube(tree_.cell_at(place)).size;
  RandomStream random(seed_, lessons_, static_cast<std::uint64_t>(Draw::jitter), number);
  const Vec2 xy = random.next_2d();
  const Vec3 offset{xy.x - 0.5f, xy.y - 0.5f, random.next_1d() - 0.5f};
  return tree_.cell_at(place + size * offset);
}

void VertexTripletsLearningState::insert() {
  const std::vector<std::size_t> first = sort_by_key(
      samples_, cells_.size(), [&](std::size_t i) { return jittered_cell(samples_[i], i); });
  parallel_for(cells_.size(), [&](std::size_t c) {
    RandomStream random(seed_, lessons_, static_cast<std::uint64_t>(Draw::insert), c);
    for (std::size_t i = first[c]; i < first[c + 1]; ++i) {
      cells_[c].reservoir.insert(samples_[i].triplet, samples_[i].weight, random);
    }
    cells_[c].count += static_cast<double>(first[c + 1] - first[c]);
  });
  samples_.clear();
  ++lessons_;
}

std::shared_ptr<const GuidingModel> VertexTripletsLearningState::update(std::uint32_t, bool) {
  insert();
  learned_early_ = false;
  const std::vector<double> counted = counts();
  const double threshold = std::accumulate(counted.begin(), counted.end(), 0.0) / settings_.cells;
  collapse(threshold);
  std::shared_ptr<const GuidingModel> model = fit();
  if (model == nullptr) return nullptr;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) cells_[i].origin = i;
  divide(threshold);
  for (Cell& cell : cells_) cell.count = 0;
  return model;
}

std::vector<double> VertexTripletsLearningState::counts() const {
  std::vector<double> result;
  for (const Cell& cell : cells_) result.push_back(cell.count);
  return result;
}

void VertexTripletsLearningState::collapse(double threshold) {
  const Octree::Origins origins = tree_.collapse(counts(), threshold);
  std::vector<Cell> joined;
  for (std::size_t c = 0; c < origins.size(); ++c) {
    joined.push_back(std::move(cells_[origins[c][0]]));
    Cell& cell = joined.back();
    RandomStream random(seed_, lessons_, static_cast<std::uint64_t>(Draw::join), c);
    for (const std::uint32_t other : std::span(origins[c]).subspan(1)) {
      cells_[other].reservoir.for_each([&](const Triplet& triplet, double weight) {
        cell.reservoir.insert(triplet, weight, random);
      });
      cell.count += cells_[other].count;
    }
  }
  cells_ = std::move(joined);
}

void VertexTripletsLearningState::divide(double threshold) {
  const Octree before = tree_;
  const Octree::Origins origins = tree_.divide(counts(), threshold);
  std::vector<Cell> divided;
  for (std::size_t next = 0; next < origins.size();) {
    const std::uint32_t from = origins[next][0];
    Cell& cell = cells_[from];
    const bool stays = next + 1 == origins.size() || origins[next + 1][0] != from;
    next += stays ? 1 : 8;
    if (stays) {
      divided.push_back(std::move(cell));
      continue;
    }
    const std::size_t first = divided.size();
    divided.resize(first + 8, Cell{Reservoir(settings_.reservoir), 0, cell.origin});
    const Point3 center = before.cube(from).center;
    // Each takes what the other took not: none overflows, no number is drawn.
    RandomStream unused(0);
    cell.reservoir.for_each([&](const Triplet& triplet, double weight) {
      unsigned part = 0;
      for (int axis = 0; axis < 3; ++axis) {
        part |= (triplet.vertices[1][axis] >= center[axis] ? 1u : 0u) << axis;
      }
      divided[first + part].reservoir.insert(triplet, weight, unused);
    });
  }
  cells_ = std::move(divided);
}

std::uint64_t VertexTripletsLearningState::sample_bytes() const {
  std::uint64_t bytes = 0;
  for (const Cell& cell : cells_) {
    bytes += cell.reservoir.heavy().size() * sizeof(Reservoir::Entry) +
             cell.reservoir.light().size() * sizeof(Triplet);
  }
  return bytes;
}

std::shared_ptr<const GuidingModel> VertexTripletsLearningState::fit() const {
  std::vector<CellFit> fits(cells_.size());
  parallel_for(cells_.size(), [&](std::size_t c) {
    const Reservoir& reservoir = cells_[c].reservoir;
    if (reservoir.size() == 0) return;
    fits[c] = fit_cell(reservoir, tree_.cube(static_cast<std::uint32_t>(c)), rule_);
  });
  double total = 0;
  for (const CellFit& f : fits) total += f.knowledge.share;
  if (!(total > 0)) return nullptr;
  std::vector<CellKnowledge> knowledge;
  std::vector<FirstVertex> camera;
  std::vector<std::uint32_t> origins;
  for (std::size_t c = 0; c < fits.size(); ++c) {
    knowledge.push_back(std::move(fits[c].knowledge));
    knowledge.back().share = static_cast<float>(knowledge.back().share / total);
    for (FirstVertex& first : fits[c].camera) {
      first.gaussian.weight = static_cast<float>(first.gaussian.weight / total);
      if (first.gaussian.weight > 0) camera.push_back(first);
    }
    origins.push_back(cells_[c].origin);
  }
  return std::make_shared<VertexTripletsModel>(rule_.kind, tree_, knowledge,
                                               CameraMixture(std::move(camera)), std::move(origins),
                                               sample_bytes());
}

void VertexTripletsLearningState::save(std::ostream& out) const {
  save_heading(out, kHeading, kVersion);
  save_number(out, lessons_);
  save_number(out, static_cast<std::uint8_t>(learned_early_));
  tree_.save(out);
  for (const Cell& cell : cells_) {
    save_number(out, cell.count);
    save_number(out, cell.origin);
    save_number(out, cell.reservoir.threshold());
    save_number(out, cell.reservoir.total_weight());
    save_number(out, static_cast<std::uint32_t>(cell.reservoir.heavy().size()));
    for (const Reservoir::Entry& entry : cell.reservoir.heavy()) {
      save_triplet(entry.item, out);
      save_number(out, entry.weight);
    }
    save_number(out, static_cast<std::uint32_t>(cell.reservoir.light().size()));
    for (const Triplet& triplet : cell.reservoir.light()) save_triplet(triplet, out);
  }
  save_number(out, static_cast<std::uint64_t>(samples_.size()));
  for (const Sample& sample : samples_) sample.save(out);
}

VertexTripletsLearningState::Cell VertexTripletsLearningState::load_cell(std::istream& in) const {
  const auto expect = [](bool holds) {
    if (!holds) throw InputError("what was learned of vertex triplets is damaged");
  };
  const auto count = load_finite<double>(in);
  const auto origin = load_number<std::uint32_t>(in);
  const auto threshold = load_finite<double>(in), total = load_finite<double>(in);
  std::vector<Reservoir::Entry> heavy;
  std::vector<Triplet> light;
  for (auto left = load_number<std::uint32_t>(in); left > 0; --left) {
    const Triplet triplet = load_triplet(in);
    heavy.push_back({triplet, load_finite<double>(in)});
    expect(heavy.back().weight > threshold);
  }
  for (auto left = load_number<std::uint32_t>(in); left > 0; --left) {
    light.push_back(load_triplet(in));
  }
  expect(count >= 0 && threshold >= 0 && total >= 0 &&
         heavy.size() + light.size() <= settings_.reservoir && (light.empty() || threshold > 0));
  return {Reservoir(settings_.reservoir, threshold, total, std::move(heavy), std::move(light)),
          count, origin};
}

void VertexTripletsLearningState::load(std::istream& in) {
  expect_heading(in, kHeading, kVersion);
  VertexTripletsLearningState loaded(*this);
  loaded.lessons_ = load_number<std::uint64_t>(in);
  loaded.learned_early_ = load_number<std::uint8_t>(in) != 0;
  loaded.tree_ = Octree::load(in);
  loaded.cells_.clear();
  while (loaded.cells_.size() < loaded.tree_.cell_count()) loaded.cells_.push_back(load_cell(in));
  loaded.samples_.clear();
  for (auto count = load_number<std::uint64_t>(in); count > 0; --count) {
    loaded.samples_.push_back(Sample::load(in));
  }
  *this = std::move(loaded);
}

void VertexTripletsLearningState::merge(const LearningState& other) {
  const auto& theirs = dynamic_cast<const VertexTripletsLearningState&>(other);
  const bool is_alike = theirs.tree_ == tree_ && theirs.lessons_ == lessons_;
  if (!is_alike || learned_early_ || theirs.learned_early_) {
    throw InputError(std::string(kHeading) +
                     ": in another iteration or scene, or after more than a million samples, "
                     "learning cannot be merged");
  }
  samples_.insert(samples_.end(), theirs.samples_.begin(), theirs.samples_.end());
}

}  // namespace pharos::vertex_triplets
