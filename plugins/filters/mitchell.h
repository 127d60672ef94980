#pragma once

#include <pharos/config/schema.h>
#include <pharos/rendering/filter.h>

namespace pharos {

/// See mitchell.cpp.
class MitchellFilter final : public Filter {
 public:
  struct Settings {
    float b = 1.0f / 3;
    float c = 1.0f / 3;
    float radius = 2;
    static void describe(Schema<Settings>& s);
  };
  explicit MitchellFilter(const Settings& settings);

  float radius() const override { return radius_; }
  float evaluate(Vec2 offset) const override { return profile(offset.x) * profile(offset.y); }
  float integral() const override;

 private:
  float profile(float x) const;

  float radius_;
  float inner_[4], outer_[4];  ///< cubic coefficients for t in [0,1) and [1,2), constant first
};

}  // namespace pharos
