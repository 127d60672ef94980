#pragma once

#include <vector>

#include <pharos/config/schema.h>
#include <pharos/laboratory/convex_region.h>

namespace pharos::laboratory {

/// edge: 1 in the intersection of half planes, 0 outside. One angle makes a straight edge across
/// the square, two make a corner, three make a triangle or the part of it in the square. The mean
/// is the area of the square clipped by the half planes.
class Edge {
 public:
  struct Settings {
    std::vector<double> angles{30};
    std::vector<double> offsets;
    static void describe(Schema<Settings>& schema);
  };

  explicit Edge(const Settings& settings)
      : region_(region_of(settings.angles, settings.offsets)),
        mean_(required_area(region_, "the edges")) {}

  double operator()(PlanePoint p) const { return region_.contains(p) ? 1 : 0; }
  double mean() const { return mean_; }

 private:
  ConvexRegion region_;
  double mean_;
};

/// Declares the parameters `angles` and `offsets` of settings that have them.
template <class Settings>
void describe_edges(Schema<Settings>& s) {
  s.field("angles", &Settings::angles,
          "Directions of the edges' outward normals, from the x axis towards the y axis")
      .unit("degrees")
      .check("one to eight angles",
             [](const std::vector<double>& a) { return !a.empty() && a.size() <= 8; });
  s.field("offsets", &Settings::offsets,
          "Distance of each edge from the center of the square along its normal; empty: all 0")
      .unit("sides of the square");
}

}  // namespace pharos::laboratory
