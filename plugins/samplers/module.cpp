#include <pharos/config/module.h>

#include "halton.h"
#include "independent.h"
#include "multi_jittered.h"
#include "pmj02.h"
#include "pmj02bn.h"
#include "point_list.h"
#include "sheared.h"
#include "sobol.h"
#include "stratified.h"
#include "toroidal_shift.h"
#include "z_sobol.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::HaltonSampler>("halton", "Padded Halton points with Owen scrambling");
  registry.add<pharos::IndependentSampler>("independent", "Independent uniform numbers");
  registry.add<pharos::MultiJitteredSampler>("multi_jittered", "Correlated multi-jittered points");
  registry.add<pharos::Pmj02Sampler>("pmj02", "Progressive multi-jittered (0,2) sequences");
  registry.add<pharos::Pmj02bnSampler>("pmj02bn", "pmj02 with larger distances between points");
  registry.add<pharos::PointListSampler>("point_list", "Points from a file, moved on the torus");
  registry.add<pharos::ShearedSampler>("sheared",
                                       "Points stratified along lines of a given direction");
  registry.add<pharos::SobolSampler>("sobol", "Padded (0,2)-sequences with Owen scrambling");
  registry.add<pharos::StratifiedSampler>("stratified", "Jittered points, one per cell of a grid");
  registry.add<pharos::ToroidalShiftSampler>(
      "toroidal_shift",
      "The same points in every pixel, moved on the torus by an offset per pixel");
  registry.add<pharos::ZSobolSampler>(
      "z_sobol", "One Sobol' sequence for the whole image, with a blue-noise error");
  registry.set_default<pharos::Sampler>("sobol");
}
