// The parameters of the estimation of directions, which are settings of the sampler `aligned`.

#include "direction_field.h"

namespace pharos::aligned {

void EstimationSettings::describe(Schema<EstimationSettings>& s) {
  using S = EstimationSettings;
  s.field("block", &S::block, "Edge of the blocks that share directions")
      .unit("pixels")
      .at_least(1)
      .at_most(1024);
  s.field("surfaces", &S::surfaces, "Divides blocks by the surface that pixels see");
  s.field("grid", &S::grid, "Where the integrand of a block is looked at");
  s.field("edges", &S::edges, "What counts as an edge");
  s.field("principal", &S::principal, "Which directions of edges stand out");
  s.field("reuse", &S::reuse,
          "Whether the light samples that were looked at count in the image, each tile of them as "
          "one sample of its pixel; needs a film with `filter: box`, and is rarely worth it");
}

void ProbeGrid::describe(Schema<ProbeGrid>& s) {
  s.field("cells", &ProbeGrid::cells, "Of the grid along an axis, a point in each")
      .at_least(8)
      .at_most(1024);
  s.field("tiles", &ProbeGrid::tiles,
          "Of the grid along an axis, each of one pixel of the region; a divisor of cells")
      .at_least(1)
      .at_most(64);
}

void EdgeSettings::describe(Schema<EdgeSettings>& s) {
  s.field("sigma", &EdgeSettings::sigma,
          "Standard deviation of the Gaussian filter before gradients are taken")
      .unit("cells")
      .at_least(0.25)
      .at_most(32);
  s.field("least_step", &EdgeSettings::least_step,
          "Height of the lowest step that counts as an edge, over the range of values")
      .at_least(0)
      .at_most(1);
}

void PrincipalSettings::describe(Schema<PrincipalSettings>& s) {
  using S = PrincipalSettings;
  s.field("axis_width", &S::axis_width, "Directions this near to an axis are its own")
      .unit("degrees")
      .at_least(0)
      .at_most(44);
  s.field("kappa", &S::kappa, "Concentration of the von Mises distributions that are fitted")
      .at_least(1)
      .at_most(1000);
  s.field("floor", &S::floor, "Least share of a direction, over the mean of all")
      .above(0)
      .at_most(1);
  s.field("window", &S::window, "How far from the highest bin a distribution's mean may lie")
      .unit("degrees")
      .at_least(0)
      .at_most(45);
  s.field("min_distance", &S::min_distance, "Between two principal directions")
      .unit("degrees")
      .at_least(1)
      .at_most(90);
  s.field("mass_width", &S::mass_width, "Shares this far from a mean are added up")
      .unit("degrees")
      .at_least(0)
      .at_most(45);
  s.field("least_mass", &S::least_mass, "Sum of shares that makes a mean a principal direction")
      .at_least(0)
      .at_most(1);
}

void SurfaceSettings::describe(Schema<SurfaceSettings>& s) {
  s.field("angle", &SurfaceSettings::angle, "Most between normals of one surface")
      .unit("degrees")
      .at_least(0)
      .at_most(180);
  s.field("depth", &SurfaceSettings::depth,
          "Most difference of two depths of one surface, over the smaller one")
      .at_least(0);
  s.field("fewest", &SurfaceSettings::fewest, "Smaller regions join others").unit("pixels");
}

}  // namespace pharos::aligned
