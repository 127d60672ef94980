// The parameters of the estimation of directions. They are settings of the sampler `aligned`.

#include "direction_field.h"

namespace pharos::aligned {

void EstimationSettings::describe(Schema<EstimationSettings>& s) {
  using S = EstimationSettings;
  s.field("block", &S::block, "Edge of the blocks of pixels that share directions")
      .unit("pixels")
      .at_least(1)
      .at_most(1024);
  s.field("surfaces", &S::surfaces, "Divides each block by the surfaces that its pixels see");
  s.field("grid", &S::grid, "Grid of points at which the integrand of a block is probed");
  s.field("edges", &S::edges, "What counts as an edge");
  s.field("principal", &S::principal, "Which directions of edges are principal directions");
  s.field("reuse", &S::reuse,
          "Whether probed light samples count in the image, each tile as one sample of its pixel; "
          "needs a film with `filter: box` and rarely pays off");
}

void ProbeGrid::describe(Schema<ProbeGrid>& s) {
  s.field("cells", &ProbeGrid::cells, "Cells of the grid along an axis; each cell has one point")
      .at_least(8)
      .at_most(1024);
  s.field("tiles", &ProbeGrid::tiles,
          "Tiles of the grid along an axis, a divisor of cells; each tile belongs to one pixel")
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
  s.field("axis_width", &S::axis_width,
          "Directions at most this far from an axis belong to the axis")
      .unit("degrees")
      .at_least(0)
      .at_most(44);
  s.field("kappa", &S::kappa, "Concentration of the von Mises distributions that are fitted")
      .at_least(1)
      .at_most(1000);
  s.field("floor", &S::floor, "Smallest share of a direction, relative to the mean of all")
      .above(0)
      .at_most(1);
  s.field("window", &S::window, "How far from the highest bin a distribution's mean may lie")
      .unit("degrees")
      .at_least(0)
      .at_most(45);
  s.field("min_distance", &S::min_distance, "Smallest angle between two principal directions")
      .unit("degrees")
      .at_least(1)
      .at_most(90);
  s.field("mass_width", &S::mass_width,
          "Shares of directions at most this far from a mean are summed")
      .unit("degrees")
      .at_least(0)
      .at_most(45);
  s.field("least_mass", &S::least_mass,
          "Smallest sum of shares for which a mean is a principal direction")
      .at_least(0)
      .at_most(1);
}

void SurfaceSettings::describe(Schema<SurfaceSettings>& s) {
  s.field("angle", &SurfaceSettings::angle, "Largest angle between normals of one surface")
      .unit("degrees")
      .at_least(0)
      .at_most(180);
  s.field("depth", &SurfaceSettings::depth,
          "Largest difference of two depths of one surface, relative to the smaller depth")
      .at_least(0);
  s.field("fewest", &SurfaceSettings::fewest,
          "Smallest size of a region; smaller regions join others")
      .unit("pixels");
}

}  // namespace pharos::aligned
