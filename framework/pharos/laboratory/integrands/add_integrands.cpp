#include <pharos/laboratory/integrands/add_integrands.h>
#include <pharos/laboratory/integrands/disk.h>
#include <pharos/laboratory/integrands/edge.h>
#include <pharos/laboratory/integrands/half_sky.h>
#include <pharos/laboratory/integrands/smooth.h>
#include <pharos/laboratory/integrands/smooth_disk.h>
#include <pharos/laboratory/integrands/smooth_edge.h>
#include <pharos/laboratory/integrands/textured.h>
#include <pharos/laboratory/integrands/triangle.h>

namespace pharos::laboratory {

void add_integrands(Registry& registry) {
  registry.set_current_module("laboratory");
  registry.add<IntegrandOf<Disk>>("disk", "1 in a disk, 0 outside");
  registry.add<IntegrandOf<Edge>>("edge", "1 in the intersection of half planes, 0 outside");
  registry.add<IntegrandOf<HalfSky>>("half_sky", "Half a sky by a map of the hemisphere");
  registry.add<IntegrandOf<Smooth>>("smooth", "A Gaussian on the torus");
  registry.add<IntegrandOf<SmoothDisk>>("smooth_disk", "A disk blurred along its radius");
  registry.add<IntegrandOf<SmoothEdge>>("smooth_edge", "A straight edge blurred by a Gaussian");
  registry.add<IntegrandOf<Textured>>("textured", "A wave in the intersection of half planes");
  registry.add<IntegrandOf<Triangle>>("triangle", "1 in a triangle, 0 outside");
}

}  // namespace pharos::laboratory
