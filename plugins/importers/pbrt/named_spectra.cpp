// Metals: Ag, Al, Au and Cu as in plugins/bsdfs/metals.cpp; brass (CuZn) as tabulated for renderers
// from measurements by Querry 1985; MgO by Stephens and Malitson 1952 and TiO2 (ordinary ray) by
// Devore 1951, at 610, 550 and 465 nm. Glasses: catalog values n_d at 587.6 nm; F5,
// F10 and F11 are pbrt's names of SF5, SF10 and SF11. Illuminants: their
// chromaticities for the observer of 1931, by CIE 15:2004, and by the Academy (S-2008-001) for D60.
#include "named_spectra.h"

#include <array>

#include "../shared/color_matching.h"

namespace pharos::pbrt {
namespace {

struct Constant {
  std::string_view name;
  Rgb value;
};
const std::array<Constant, 21> kIndices{{{"glass-BAF10", Rgb(1.6700f)},
                                         {"glass-BK7", Rgb(1.5168f)},
                                         {"glass-FK51A", Rgb(1.4866f)},
                                         {"glass-LASF9", Rgb(1.8503f)},
                                         {"glass-F10", Rgb(1.7283f)},
                                         {"glass-F11", Rgb(1.7847f)},
                                         {"glass-F5", Rgb(1.6727f)},
                                         {"metal-Ag-eta", {0.056f, 0.055f, 0.043f}},
                                         {"metal-Ag-k", {4.35f, 3.53f, 2.57f}},
                                         {"metal-Al-eta", {1.473f, 0.986f, 0.598f}},
                                         {"metal-Al-k", {7.64f, 6.56f, 5.35f}},
                                         {"metal-Au-eta", {0.064f, 0.497f, 1.460f}},
                                         {"metal-Au-k", {3.60f, 2.33f, 1.82f}},
                                         {"metal-Cu-eta", {0.179f, 1.041f, 1.290f}},
                                         {"metal-Cu-k", {3.27f, 2.60f, 2.37f}},
                                         {"metal-CuZn-eta", {0.444f, 0.527f, 1.094f}},
                                         {"metal-CuZn-k", {3.695f, 2.765f, 1.829f}},
                                         {"metal-MgO-eta", {1.736f, 1.739f, 1.747f}},
                                         {"metal-MgO-k", Rgb(0)},
                                         {"metal-TiO2-eta", {2.598f, 2.648f, 2.777f}},
                                         {"metal-TiO2-k", Rgb(0)}}};

struct Illuminant {
  std::string_view name;
  double x, y;  ///< chromaticity
};
constexpr std::array<Illuminant, 16> kIlluminants{{{"illum-acesD60", 0.32168, 0.33767},
                                                   {"stdillum-A", 0.44757, 0.40745},
                                                   {"stdillum-D50", 0.34567, 0.35850},
                                                   {"stdillum-D65", 0.31271, 0.32902},
                                                   {"stdillum-F1", 0.31310, 0.33727},
                                                   {"stdillum-F2", 0.37208, 0.37529},
                                                   {"stdillum-F3", 0.40910, 0.39430},
                                                   {"stdillum-F4", 0.44018, 0.40329},
                                                   {"stdillum-F5", 0.31379, 0.34531},
                                                   {"stdillum-F6", 0.37790, 0.38835},
                                                   {"stdillum-F7", 0.31292, 0.32933},
                                                   {"stdillum-F8", 0.34588, 0.35875},
                                                   {"stdillum-F9", 0.37417, 0.37281},
                                                   {"stdillum-F10", 0.34609, 0.35986},
                                                   {"stdillum-F11", 0.38052, 0.37713},
                                                   {"stdillum-F12", 0.43695, 0.40441}}};

}  // namespace

std::optional<Rgb> named_spectrum(std::string_view name) {
  for (const Constant& constant : kIndices) {
    if (constant.name == name) return constant.value;
  }
  for (const Illuminant& light : kIlluminants) {
    if (light.name == name) return importing::color_of_chromaticity(light.x, light.y);
  }
  return std::nullopt;
}

std::vector<std::string> spectrum_names() {
  std::vector<std::string> names;
  for (const Constant& constant : kIndices) names.emplace_back(constant.name);
  for (const Illuminant& light : kIlluminants) names.emplace_back(light.name);
  return names;
}

}  // namespace pharos::pbrt
