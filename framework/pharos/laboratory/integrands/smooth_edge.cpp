#include <pharos/laboratory/integrands/smooth_edge.h>
#include <pharos/laboratory/normal_integrals.h>

namespace pharos::laboratory {
void SmoothEdge::Settings::describe(Schema<Settings>& s) {
  s.field("angle", &Settings::angle,
          "Direction of the edge's outward normal, from the x axis towards the y axis")
      .unit("degrees");
  s.field("offset", &Settings::offset,
          "Distance of the edge from the center of the square along its normal")
      .unit("sides of the square")
      .at_least(-0.5)
      .at_most(0.5);
  s.field("width", &Settings::width, "Standard deviation of the blur")
      .unit("sides of the square")
      .at_least(0.001)
      .at_most(1);
}

double SmoothEdge::mean() const {
  // z = -d / width is linear in p. Along the axes, its slopes are a and b.
  const double a = -edge_.normal.x / width_, b = -edge_.normal.y / width_;
  const double z = edge_.bound / width_;
  if (b == 0) return (first_integral(z + a) - first_integral(z)) / a;
  if (a == 0) return (first_integral(z + b) - first_integral(z)) / b;
  return (second_integral(z + a + b) - second_integral(z + a) - second_integral(z + b) +
          second_integral(z)) /
         (a * b);
}

}  // namespace pharos::laboratory
