#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/core/warp.h>
#include <pharos/guiding/pipeline/guiding_state.h>
#include <pharos/tests/fixtures.h>

/// The smallest methods and the smallest policy that a render can learn with.
namespace pharos::test {

/// A model with one number for each region.
class TinyModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "tiny";

  TinyModel() = default;
  explicit TinyModel(std::vector<double> numbers) : numbers_(std::move(numbers)) {}
  ModelInfo info() const override {
    return {.name = std::string(kName), .regions = static_cast<std::uint32_t>(numbers_.size())};
  }
  void archive(Archive& archive) override { archive(numbers_); }
  Place place(const GuidingVertex&) const override {
    return {.region = static_cast<std::uint32_t>(numbers_.size()) - 1};
  }
  double density(Point3, const Vec3*) const override { return numbers_.front(); }

 private:
  std::vector<double> numbers_;
};

/// Learns the sum of the light that paths found, halved at each new iteration. Every iteration
/// divides the model's first region.
class TinyState final : public LearningState {
 public:
  void absorb(const PathLog& log) override {
    for (std::size_t i = 0; i < log.size(); ++i) {
      for (const RecordedVertex& vertex : log[i].vertices) found_ += vertex.emission.r;
    }
  }
  Learned update(const TrainingStage&) override {
    light_ = light_ / 2 + found_;
    found_ = 0;
    const std::uint32_t before = regions_++;
    Learned learned{std::make_shared<TinyModel>(std::vector<double>(regions_, light_))};
    for (std::uint32_t i = 0; i < regions_; ++i) {
      learned.region_origins.push_back(i < before ? i : 0);
    }
    return learned;
  }
  void archive(Archive& archive) override { archive(found_, light_, regions_); }

 private:
  double found_ = 0, light_ = 0;
  std::uint32_t regions_ = 0;
};

class TinyLearner final : public Learner {
 public:
  LearnerTraits traits() const override { return {}; }
  std::unique_ptr<LearningState> begin(const LearningContext&) const override {
    return std::make_unique<TinyState>();
  }
  std::shared_ptr<GuidingModel> empty_model() const override {
    return std::make_shared<TinyModel>();
  }
};

/// Samples directions uniformly over the sphere.
class TinyGuider final : public GuiderOf<TinyModel> {
 public:
  GuiderTraits traits() const override { return {.guides_camera = true}; }
  const GuidingDistribution* query(const TinyModel&, const GuidingQuery&,
                                   Arena& arena) const override {
    return arena.make<Sphere>();
  }

 private:
  class Sphere final : public GuidingDistribution {
   public:
    std::optional<Proposal> propose(const VertexStream& stream) const override {
      return Proposal{.direction =
                          warp::sphere_from_square(stream.get_2d(Purpose::guide_direction))};
    }
    float density(const ResolvedVertex&) const override { return warp::sphere_pdf(); }
  };
};

/// A share of unguided samples for each region. The methods divide the rest by their weights.
class TinyShares final : public MixingShares {
 public:
  TinyShares(std::vector<double> paths, std::vector<float> weights, std::size_t silent)
      : paths_(std::move(paths)), weights_(std::move(weights)), silent_(silent) {}
  std::uint32_t at(const MixingQuery& query, std::span<float> shares) const override {
    const std::uint32_t region = query.places.back().region;
    share_by_weight(weights_, query.places, 1 / (2 + static_cast<float>(paths_.at(region))),
                    shares);
    return region;
  }
  bool asks(std::size_t method) const override { return method >= silent_; }

 private:
  std::vector<double> paths_;
  std::vector<float> weights_;
  std::size_t silent_;
};

/// Counts the paths of all iterations, in every region.
class TinyMixingState final : public MixingState {
 public:
  TinyMixingState(std::span<const float> weights, std::size_t silent,
                  std::shared_ptr<std::vector<std::string>> heard)
      : weights_(weights.begin(), weights.end()), silent_(silent), heard_(std::move(heard)) {}
  void absorb(const PathLog& log) override { found_ += static_cast<double>(log.size()); }
  void leave_out(std::size_t method) override {
    if (heard_ != nullptr) heard_->push_back("leave out " + std::to_string(method));
  }
  void end_learning() override {
    if (heard_ != nullptr) heard_->push_back("end learning");
  }
  void update(std::uint32_t regions, std::span<const std::uint32_t> origins, bool) override {
    if (heard_ != nullptr) heard_->push_back("update");
    std::vector<double> next(regions, found_);
    for (std::size_t i = 0; i < regions; ++i) {
      const std::size_t origin = origins.empty() ? i : origins[i];
      if (origin < paths_.size()) next[i] += paths_[origin];
    }
    paths_ = std::move(next);
    found_ = 0;
  }
  std::shared_ptr<const MixingShares> shares() const override {
    return std::make_shared<const TinyShares>(paths_, weights_, silent_);
  }
  void archive(Archive& archive) override { archive(found_, paths_); }

 private:
  double found_ = 0;
  std::vector<double> paths_;
  std::vector<float> weights_;
  std::size_t silent_;
  std::shared_ptr<std::vector<std::string>> heard_;
};

/// A policy that never asks the first `silent` methods. If `heard` is not null, the policy lists
/// the calls of update(), leave_out() and end_learning() there.
class TinyMixing final : public MixingPolicy {
 public:
  explicit TinyMixing(std::size_t silent = 0,
                      std::shared_ptr<std::vector<std::string>> heard = nullptr)
      : silent_(silent), heard_(std::move(heard)) {}
  std::unique_ptr<MixingState> begin(std::span<const float> weights) const override {
    return std::make_unique<TinyMixingState>(weights, silent_, heard_);
  }

 private:
  std::size_t silent_;
  std::shared_ptr<std::vector<std::string>> heard_;
};

/// Returns settings with two learners, where two guiders sample the model of the first learner.
inline GuidingSettings tiny_settings() {
  const auto learner = std::make_shared<const TinyLearner>();
  const auto guider = std::make_shared<const TinyGuider>();
  GuidingSettings settings;
  settings.methods = {{.learner = learner, .guider = guider},
                      {.learner = nullptr, .guider = guider},
                      {.learner = learner, .guider = guider}};
  settings.mixing = std::make_shared<const TinyMixing>();
  return settings;
}

using Methods = std::vector<std::uint32_t>;

/// Returns the methods that are asked at the lens; none if there is no frame.
inline Methods asked_methods(const GuidingState& state) {
  Methods methods;
  if (state.frame() == nullptr) return methods;
  GuidingQuery query{.current = {.kind = VertexKind::sensor}};
  Arena arena;
  for (const GuidePart& part : state.frame()->query(query, arena).parts) {
    methods.push_back(part.method);
  }
  return methods;
}

/// Loads what saved() returned.
inline void load_from(const std::string& bytes, GuidingState& state) {
  std::istringstream in(bytes);
  load(in, state);
}

}  // namespace pharos::test
