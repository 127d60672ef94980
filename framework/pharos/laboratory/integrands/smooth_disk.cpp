#include <algorithm>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/laboratory/integrands/smooth_disk.h>
#include <pharos/laboratory/normal_integrals.h>

namespace pharos::laboratory {

void SmoothDisk::Settings::describe(Schema<Settings>& s) {
  s.field("center", &Settings::center, "Center of the disk").unit("sides of the square");
  s.field("radius", &Settings::radius, "Distance at which the value is one half")
      .unit("sides of the square")
      .above(0);
  s.field("width", &Settings::width, "Standard deviation of the blur")
      .unit("sides of the square")
      .at_least(0.001);
}

SmoothDisk::SmoothDisk(const Settings& settings)
    : center_{settings.center.x, settings.center.y},
      radius_(settings.radius),
      width_(settings.width) {
  // Further out, the value is below 1e-9.
  const double reach = radius_ + 6 * width_;
  const double room = std::min({center_.x, 1 - center_.x, center_.y, 1 - center_.y});
  if (reach > room) {
    throw InputError(fmt::format(
        "expected the disk within the unit square, 'radius' and six times 'width' from 'center': "
        "they reach {:.4g}, the nearest border is {:.4g} away",
        reach, room));
  }
}

double SmoothDisk::mean() const {
  const double s = radius_ / width_;
  return std::numbers::pi * ((radius_ * radius_ + width_ * width_) * normal_distribution(s) +
                             radius_ * width_ * normal_density(s));
}

}  // namespace pharos::laboratory
