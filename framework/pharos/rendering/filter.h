#pragma once

#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/vec.h>

namespace pharos {

/// Contract: the weight of a sample by its offset from a pixel's center.
class Filter : public Component {
 public:
  static constexpr std::string_view contract_name = "filter";

  /// The half-width of the square outside which the weight is zero [pixels], > 0.
  virtual float radius() const = 0;
  /// The weight at an offset [1]. It may be negative, and its overall scale does not matter.
  virtual float evaluate(Vec2 offset) const = 0;
  /// The integral of evaluate() over the plane [pixels^2], > 0. Splats are normalized by it.
  virtual float integral() const = 0;
};

}  // namespace pharos
