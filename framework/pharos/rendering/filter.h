#pragma once

#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/vec.h>

namespace pharos {

/// Contract: the weight of a sample by its offset from a pixel's center.
class Filter : public Component {
 public:
  static constexpr std::string_view contract_name = "filter";

  /// Half-width of the square outside which the weight is zero [pixels], > 0.
  virtual float radius() const = 0;
  /// Weight at an offset [1]; may be negative in places; the overall factor does not matter.
  virtual float evaluate(Vec2 offset) const = 0;
  /// Integral of evaluate() over the plane [pixels^2], > 0; splats are normalized by it.
  virtual float integral() const = 0;
};

}  // namespace pharos
