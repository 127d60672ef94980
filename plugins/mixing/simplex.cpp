// simplex: learns the shares of unguided sampling and of every method, so that the second moment of
// the estimates of steps is least, or their divergence from the target (`objective: kl`).
//
// Shares are learned for classes of vertices in the cells of a kd-tree of its own: by the roughness
// of the scattering and by whether the vertex is the first. A step is drawn with the density p, and
// its estimate is x = f / p (f: BSDF times estimated incident radiance). If it had been drawn with
// other shares s, its density would be q p with q = sum_i s_i p_i / p, and the second moment of the
// estimates would be E[x^2 / q]. The policy minimizes this convex function of s over the steps of
// an iteration (step_cost.h). Each class keeps a weighted reservoir of its steps.
//
// Guides must earn their shares. Learning begins with the share `unguided` of unguided sampling.
// Each class learns once for the whole scene, with these shares as the prior, and again in each
// cell, with the shares of the whole scene as the prior. Cells that found no light thus learn from
// others. A prior counts like `prior_steps` steps. The shares of an iteration count as many steps
// as their weights are worth, (sum w)^2 / sum w^2, so a single bright step counts as one. In the
// final iteration, methods are asked only where they lower the second moment by the factor `worth`
// that makes up for their cost. A method is dropped only if the steps that speak against it count
// for more than what was known before. In training, each method keeps its part of the share
// `explore`, because a method that is not asked cannot earn anything.
//
// A method that is left out of the rest of the render has no share from then on.
//
// Classes that found no light anywhere in training are not guided in the final iteration. If this
// holds for all of them, or if no method is worth its cost anywhere, the image is rendered as
// without guides.
//
// At a vertex, the share of a method is scaled by e / (e + `evidence`), where e is the evidence of
// its model there, and all shares are scaled to sum to 1.
//
//     mixing: simplex
#include "simplex.h"

#include <array>
#include <cmath>

#include <pharos/core/error.h>
#include <pharos/core/parallel.h>
#include <pharos/guiding/toolkit/kd_tree_cells.h>

#include "class_shares.h"
#include "mixed_steps.h"
#include "step_cost.h"

namespace pharos {
namespace {

using Settings = SimplexMixing::Settings;

constexpr std::uint32_t kScatteringClasses = 4, kBounceClasses = 2;
constexpr std::uint32_t kClasses = kScatteringClasses * kBounceClasses;

/// Returns the class of a vertex: how it scatters (a surface that is almost smooth, glossy or
/// rough, or a medium), and whether it is the first vertex after the lens.
std::uint32_t class_of(const GuidingQuery& query) {
  const GuidingVertex& vertex = query.current;
  const std::uint32_t scattering = vertex.kind == VertexKind::volume ? 3
                                   : vertex.roughness < 0.1f         ? 0
                                   : vertex.roughness < 0.4f         ? 1
                                                                     : 2;
  return scattering * kBounceClasses + (query.bounce == 1 ? 0 : 1);
}

/// A recorded step.
struct Step {
  Point3 origin;
  std::uint32_t vertex_class = 0;
  FoundStep found;
  void archive(Archive& archive) {
    archive(origin, vertex_class, found);
    archive.expect(vertex_class < kClasses, "what was learned of mixing");
  }
};

/// A cell of the kd-tree.
struct Cell {
  std::vector<ClassShares> classes;
  std::uint64_t steps = 0;

  bool knows_something() const { return steps > 0; }
  /// Both halves of a divided cell keep the shares of earlier iterations as a prior.
  void forget(double) {
    for (ClassShares& each : classes) each.drop_steps();
  }
  void archive(Archive& archive) {
    archive(steps, classes);
    archive.expect(classes.size() == kClasses, "what was learned of mixing");
  }
};

/// The shares of all cells, frozen.
class CellShares final : public MixingShares {
 public:
  /// `shares` holds `techniques` numbers for each class of each cell.
  CellShares(KdTree tree, std::vector<float> shares, std::size_t techniques, float evidence)
      : tree_(std::move(tree)),
        shares_(std::move(shares)),
        techniques_(techniques),
        evidence_(evidence) {
    for (std::size_t i = 0; i < shares_.size(); ++i) asked_[i % techniques_] |= shares_[i] > 0;
  }

  /// Returns the number of the class among the classes of all cells as the key.
  std::uint32_t at(const MixingQuery& query, std::span<float> shares) const override {
    const std::uint32_t cell = tree_.cell_at(query.vertex.current.position);
    const std::uint32_t key = cell * kClasses + class_of(query.vertex);
    const float* learned = &shares_[key * techniques_];
    shares[0] = learned[0];
    float total = learned[0];
    for (std::size_t i = 1; i < techniques_; ++i) {
      const float evidence = query.places[i - 1].evidence;
      shares[i] = evidence > 0 ? learned[i] * evidence / (evidence + evidence_) : 0;
      total += shares[i];
    }
    for (float& share : shares) share /= total;
    return key;
  }
  bool asks(std::size_t method) const override { return asked_[1 + method]; }

 private:
  KdTree tree_;
  std::vector<float> shares_;
  std::size_t techniques_;
  std::array<bool, kMostTechniques> asked_{};  ///< techniques with a share in any class
  float evidence_;  ///< evidence with which a method has half of its odds
};

class SimplexState final : public MixingState {
 public:
  SimplexState(const Settings& settings, std::span<const float> weights)
      : settings_(settings), techniques_(weights.size() + 1) {
    Simplex prior{};
    std::copy(weights.begin(), weights.end(), prior.begin() + 1);
    prior = normalized(prior);
    for (double& share : prior) share *= 1 - settings.unguided;
    prior[0] = settings.unguided;
    prior_ = {.training = prior, .final = {1}};
    std::fill_n(in_use_.begin(), techniques_, true);
    scene_.fill(ClassShares(prior_, settings));
    cells_[0].classes.assign(kClasses, ClassShares(prior_, settings));
  }

  void absorb(const PathLog& log) override {
    for_each_mixed_step(log, incident_,
                        [&](const PathView& path, const RecordedVertex& vertex, Rgb incident) {
                          add(path, vertex, incident);
                        });
    if (steps_.size() >= kBatch) teach();
  }

  void update(std::uint32_t, std::span<const std::uint32_t>, bool last) override {
    teach();
    for (ClassShares& each : scene_) each.learn(settings_, techniques_, in_use_, prior_);
    parallel_for(cells_.size(), [&](std::size_t i) {
      for (std::uint32_t k = 0; k < kClasses; ++k) {
        cells_[i].classes[k].learn(settings_, techniques_, in_use_, scene_[k].shares());
      }
    });
    is_last_ = last;
  }

  void leave_out(std::size_t method) override { in_use_[1 + method] = false; }

  void end_learning() override {
    steps_ = {};
    is_last_ = true;
  }

  std::shared_ptr<const MixingShares> shares() const override {
    std::vector<float> all;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      for (const ClassShares& each : cells_[i].classes) {
        const Simplex& own = is_last_ ? each.shares().final : each.shares().training;
        for (std::size_t k = 0; k < techniques_; ++k) all.push_back(static_cast<float>(own[k]));
      }
    }
    return std::make_shared<CellShares>(cells_.tree(), std::move(all), techniques_,
                                        settings_.evidence);
  }

  void archive(Archive& archive) override {
    archive.heading("simplex mixing", 3);
    archive(in_use_, lesson_, is_last_, steps_, scene_);
    archive.expect(in_use_[0], "what was learned of mixing");
    cells_.archive(archive);
  }

 private:
  /// Number of collected steps from which cells are taught before the iteration ends. It limits the
  /// memory.
  static constexpr std::size_t kBatch = 1u << 20;

  void add(const PathView& path, const RecordedVertex& vertex, Rgb incident) {
    const double estimate = mean(vertex.local_weight * incident);
    const double weight =
        settings_.objective == MixingObjective::kl ? estimate : estimate * estimate;
    Step step{vertex.position, vertex.mixing_key % kClasses, {weight, {}}};
    // Zero samples move no share. They count only where cells are divided.
    bool is_sound = std::isfinite(step.found.weight);
    const std::span<const Technique> techniques = path.techniques(vertex);
    for (std::size_t i = 0; estimate > 0 && i < techniques.size(); ++i) {
      step.found.ratios[i] = techniques[i].density / vertex.pdf;
      is_sound &= std::isfinite(step.found.ratios[i]);
    }
    if (is_sound) steps_.push_back(step);
  }

  void teach() {
    RandomStream of_scene(lesson_, 0, 1);
    for (const Step& step : steps_) scene_[step.vertex_class].add(step.found, of_scene);
    const CellDivision division{.cell_samples = settings_.cell_steps, .max_depth = 24};
    cells_.learn(steps_, division, [&](Cell& cell, std::span<const Step> steps, std::size_t i) {
      RandomStream random(lesson_, i);
      for (const Step& step : steps) cell.classes[step.vertex_class].add(step.found, random);
      cell.steps += steps.size();
    });
    ++lesson_;
  }

  const Settings settings_;
  std::size_t techniques_;
  TechniqueSet in_use_{};  ///< techniques that are not left out
  StagedShares prior_;
  std::array<ClassShares, kClasses> scene_;  ///< of each class, in all cells together
  KdTreeCells<Step, Cell> cells_;
  std::vector<Step> steps_;   ///< collected since the last call of teach()
  std::uint64_t lesson_ = 0;  ///< number of calls of teach(); a key of random numbers
  bool is_last_ = false;
  std::vector<Rgb> incident_;  ///< of one path; a member, so that it keeps its memory
};

}  // namespace

void SimplexMixing::Settings::describe(Schema<Settings>& s) {
  s.field("objective", &Settings::objective,
          "Minimized quantity: second moment of the estimate of a step, or divergence from the "
          "target distribution");
  s.field("unguided", &Settings::unguided, "Initial share of unguided samples").above(0).at_most(1);
  s.field("least", &Settings::least, "Least share of unguided samples").at_least(1e-4).at_most(1);
  s.field("explore", &Settings::explore, "Least share of all methods together in training")
      .at_least(0)
      .at_most(0.5);
  s.field("worth", &Settings::worth,
          "Factor by which a method must lower the second moment of the estimates of steps (or the "
          "exponential of the divergence) to be asked in the final iteration")
      .at_least(1);
  s.field("prior_steps", &Settings::prior_steps,
          "Number of steps that the initial shares are worth")
      .above(0);
  s.field("decay", &Settings::decay,
          "Share of the certainty of learned shares that is kept for the next iteration")
      .at_least(0)
      .at_most(1);
  s.field("evidence", &Settings::evidence,
          "Number of training samples with which a method has half of the odds of its share")
      .at_least(0);
  s.field("cell_steps", &Settings::cell_steps, "Number of steps from which a cell is divided")
      .at_least(64);
  s.field("reservoir", &Settings::reservoir, "Number of steps that a class of vertices keeps")
      .at_least(8)
      .at_most(Settings::kMostSteps);
}

SimplexMixing::SimplexMixing(const Settings& settings) : settings_(settings) {
  if (settings.unguided < settings.least) {
    throw InputError("the initial share `unguided` must be at least `least`");
  }
}

std::unique_ptr<MixingState> SimplexMixing::begin(std::span<const float> weights) const {
  return std::make_unique<SimplexState>(settings_, weights);
}

}  // namespace pharos
