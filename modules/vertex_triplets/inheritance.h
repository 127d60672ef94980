#pragma once

#include <vector>

#include "model.h"

namespace pharos::vertex_triplets {

/// The mixtures that a cell inherited when it was made by dividing another cell. They are relative
/// to the center of the new cell [scene units]. The shares of all components add up to one.
struct Inheritance {
  // Only the mixtures of the model's prefix are used. The other vector is empty.
  std::vector<ConditionalMixtures<3>::Run> pairs;
  std::vector<ConditionalMixtures<6>::Run> triplets;

  bool empty() const { return pairs.empty() && triplets.empty(); }
  void archive(Archive& archive) { archive(pairs, triplets); }
};

/// Returns the part of a cell's mixtures that concerns a cell made by dividing it. The weight of a
/// component is multiplied by the probability that its current vertex is in the new cell, computed
/// as if the three coordinates of this vertex were independent. Components with less than a
/// thousandth of the divided cell's weight in the part are left out.
Inheritance inheritance(const CellKnowledge& knowledge, const Cube& divided, const Cube& part);

}  // namespace pharos::vertex_triplets
