#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// The lights that next event estimation samples at a vertex.
enum class LightSelection {
  one,  ///< one light, chosen in proportion to power
  all   ///< every light, each in a branch of its own
};

template <>
struct EnumNames<LightSelection> {
  static constexpr auto names = std::to_array<EnumName<LightSelection>>(
      {{"one", LightSelection::one}, {"all", LightSelection::all}});
};

/// Chooses lights of a scene by a selection policy. Constant and thread-safe.
class LightSelector {
 public:
  LightSelector(const Scene& scene, LightSelection selection);

  /// Returns the number of light samples to take at each vertex.
  std::uint16_t branches() const { return branches_; }
  /// Returns whether choose() uses its random number, that is, whether there is more than one light
  /// to choose from.
  bool needs_number() const { return cumulative_.size() > 1; }
  /// Returns the index in Scene::lights() of the light for a branch; `u` is in [0,1).
  int choose(std::uint16_t branch, float u) const;
  /// Returns the probability [1] of choosing a light; 1 with `all`.
  float probability(int light) const { return probability_[static_cast<std::size_t>(light)]; }

 private:
  LightSelection selection_;
  std::uint16_t branches_ = 0;
  std::vector<float> probability_;
  std::vector<float> cumulative_;  ///< upper ends of the lights' intervals, ascending to 1
};

}  // namespace pharos
