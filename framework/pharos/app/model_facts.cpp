#include "model_facts.h"

#include <algorithm>

#include <fmt/format.h>

namespace pharos {
namespace {

std::vector<ModelFact> facts_of(const ModelHeader& header, const GuidingModel& model) {
  ModelInfo info = model.info();
  const Bounds3& bounds = info.bounds;
  std::vector<ModelFact> facts = {
      {"model", fmt::format("{}, version {}", header.model, header.version)},
      {"learner", header.learner},
      {"saved", fmt::format("{} bytes", header.bytes)},
      {"memory", fmt::format("{} bytes", info.bytes)},
      {"bounds", bounds.empty()
                     ? "none"
                     : fmt::format("{} to {}", point_text(bounds.low), point_text(bounds.high))},
      {"regions", std::to_string(info.regions)}};
  for (ModelFact& fact : info.facts) facts.push_back(std::move(fact));
  return facts;
}

/// Returns the mean shares at vertices of different kinds, wherever in `bounds` a model knows
/// something.
std::vector<ModelFact> facts_of_mixing(const LearnedFile& file, const Bounds3& bounds) {
  std::vector<ModelFact> facts = {{"mixing", file.head.mixing}};
  for (const std::uint16_t bounce : {1, 2}) {
    for (const float roughness : kShownRoughness) {
      if (bounds.empty()) return facts;
      const std::vector<float> shares = mean_shares(file.mixing, bounds, {roughness, bounce});
      if (shares.empty()) return facts;
      std::string text = fmt::format("unguided {:.3f}", shares[0]);
      for (std::size_t i = 0; i < file.head.methods.size(); ++i) {
        text += fmt::format(", {} {:.3f}", file.head.models[file.head.methods[i].model].learner,
                            shares[1 + i]);
      }
      facts.push_back({fmt::format("bounce {}, roughness {:g}", bounce, roughness), text});
    }
  }
  return facts;
}

void print_aligned(const std::vector<ModelFact>& facts) {
  std::size_t width = 0;
  for (const ModelFact& fact : facts) width = std::max(width, fact.name.size());
  for (const ModelFact& fact : facts) fmt::print("{:<{}}  {}\n", fact.name, width, fact.value);
}

}  // namespace

std::string point_text(Point3 p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

void print_facts(const LearnedFile& file, Bounds3 bounds) {
  for (std::size_t i = 0; i < file.models.size(); ++i) {
    print_aligned(facts_of(file.head.models[i], *file.models[i]));
    const Bounds3 own = file.models[i]->info().bounds;
    if (own.empty()) continue;
    bounds.add(own.low);
    bounds.add(own.high);
  }
  print_aligned(facts_of_mixing(file, bounds));
}

}  // namespace pharos
