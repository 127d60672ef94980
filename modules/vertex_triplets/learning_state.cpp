#include "learning_state.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <pharos/core/counting_sort.h>
#include <pharos/core/random.h>

namespace pharos::vertex_triplets {
namespace {

/// The number of waiting samples (44 bytes each) at which they are inserted into cells.
constexpr std::size_t kBatch = 1u << 20;

/// The purpose of a random number, which is a part of its key.
enum class Draw : std::uint64_t { jitter = 1, insert, join };

/// Returns the cube around a region. If the region is empty or has no extent, the edge is one.
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
                                 .tolerance = settings.em_tolerance}},
            .inherit = settings.inherit,
            .translation = settings.translation},
      seed_(context.seed),
      tree_(cube_around(context.region)),
      cells_{Cell{Reservoir(settings.reservoir)}},
      pixels_(settings.weights == SampleWeights::relative ? context.window : PixelRect{}) {}

void VertexTripletsLearningState::absorb(const PathLog& log) {
  SampleRule rule{.environment = rule_.kind.environment,
                  .light_paths = settings_.light_paths,
                  .light_samples = settings_.light_samples,
                  .suffixes = settings_.weights == SampleWeights::suffix};
  for (std::size_t i = 0; i < log.size(); ++i) {
    const PathView path = log[i];
    const bool is_relative = settings_.weights == SampleWeights::relative;
    if (is_relative && path.transport == Transport::importance) continue;
    if (is_relative) rule.scale = static_cast<float>(pixels_.mean() / pixels_.at(path.film));
    extract_samples(path, rule, incident_, samples_);
    if (is_relative) add_to_pixel(path);
  }
  if (samples_.size() >= kBatch) insert();
}

void VertexTripletsLearningState::add_to_pixel(const PathView& path) {
  const RecordedVertex& lens = path.vertices[0];
  const double value = luminance(lens.throughput * lens.local_weight * incident_[0]);
  const std::span<const Technique> techniques = path.techniques(lens);
  // A guide of the camera chooses some pixels more often than others.
  const double paths = techniques.empty() ? 1 : double{techniques[0].density} / lens.pdf;
  if (std::isfinite(value) && std::isfinite(paths)) pixels_.add(path.film, value, paths);
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

Learned VertexTripletsLearningState::update(const TrainingStage&) {
  insert();
  const std::vector<double> counted = counts();
  const double all = std::accumulate(counted.begin(), counted.end(), 0.0);
  const double threshold = std::max(all / settings_.cells, settings_.least_effective);
  collapse(threshold);
  Learned learned = fit();
  if (learned.model == nullptr) return learned;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) cells_[i].origin = i;
  camera_region_ = static_cast<std::uint32_t>(cells_.size());
  divide(threshold, static_cast<const VertexTripletsModel&>(*learned.model));
  for (Cell& cell : cells_) cell.count = 0;
  pixels_.update(settings_.pixel_radius, settings_.least_pixel);
  return learned;
}

std::vector<double> VertexTripletsLearningState::counts() const {
  std::vector<double> result;
  for (const Cell& cell : cells_) {
    result.push_back(settings_.least_effective > 0 ? cell.reservoir.effective_size() : cell.count);
  }
  return result;
}

void VertexTripletsLearningState::collapse(double threshold) {
  const Octree::Origins origins = tree_.collapse(counts(), threshold);
  std::vector<Cell> joined;
  for (std::size_t c = 0; c < origins.size(); ++c) {
    joined.push_back(std::move(cells_[origins[c][0]]));
    Cell& cell = joined.back();
    if (origins[c].size() > 1) cell.inheritance = {};
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

void VertexTripletsLearningState::inherit(std::span<Cell> parts, const VertexTripletsModel& model,
                                          std::uint32_t divided_cell, const Cube& divided) const {
  if (!(settings_.inherit > 0)) return;
  const CellKnowledge knowledge = model.knowledge(divided_cell);
  for (unsigned c = 0; c < parts.size(); ++c) {
    parts[c].inheritance = inheritance(knowledge, divided, divided.part(c));
  }
}

void VertexTripletsLearningState::divide(double threshold, const VertexTripletsModel& model) {
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
    inherit(std::span(divided).subspan(first), model, from, before.cube(from));
    const Point3 center = before.cube(from).center;
    // The parts share the samples of one reservoir. Therefore none overflows, and no random number
    // is drawn.
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

Learned VertexTripletsLearningState::fit() const {
  std::vector<CellFit> fits(cells_.size());
  parallel_for(cells_.size(), [&](std::size_t c) {
    const Reservoir& reservoir = cells_[c].reservoir;
    const Inheritance& inheritance = cells_[c].inheritance;
    if (reservoir.size() == 0 && inheritance.empty()) return;
    fits[c] = fit_cell(reservoir, tree_.cube(static_cast<std::uint32_t>(c)), rule_, inheritance);
  });
  double total = 0;
  for (const CellFit& f : fits) total += f.knowledge.share;
  if (!(total > 0)) return {};
  std::vector<CellKnowledge> knowledge;
  std::vector<FirstVertex> camera;
  std::vector<std::uint32_t> origins;
  for (std::size_t c = 0; c < fits.size(); ++c) {
    knowledge.push_back(std::move(fits[c].knowledge));
    knowledge.back().share = static_cast<float>(knowledge.back().share / total);
    knowledge.back().samples = static_cast<float>(cells_[c].reservoir.size());
    for (FirstVertex& first : fits[c].camera) {
      first.gaussian.weight = static_cast<float>(first.gaussian.weight / total);
      if (first.gaussian.weight > 0) camera.push_back(first);
    }
    origins.push_back(cells_[c].origin);
  }
  origins.push_back(camera_region_);
  return {std::make_shared<VertexTripletsModel>(rule_.kind, tree_, knowledge,
                                                CameraMixture(std::move(camera)), sample_bytes()),
          std::move(origins)};
}

void VertexTripletsLearningState::archive(Archive& archive) {
  archive.heading("vertex_triplets_learning", 4);
  archive(camera_region_, lessons_, tree_, samples_, pixels_);
  archive.list(cells_, [&] { return Cell{Reservoir(settings_.reservoir)}; });
  bool is_sound = cells_.size() == tree_.cell_count();
  const bool pairs = settings_.vertices == Prefix::pair;
  for (const Cell& cell : cells_) {
    const Inheritance& inherited = cell.inheritance;
    is_sound &= cell.count >= 0 && (pairs ? inherited.triplets.empty() : inherited.pairs.empty());
  }
  archive.expect(is_sound, "what was learned of vertex triplets");
}

}  // namespace pharos::vertex_triplets
