#include "preetham.h"

#include <array>
#include <cmath>
#include <numbers>

namespace pharos {
namespace {

/// Luminance [cd/m^2] per mean spectral radiance [W/(m^2 sr nm)]: the maximal luminous efficacy
/// [lm/W] times the integral of the matching function of Y [nm].
constexpr double kLuminancePerRadiance = 683.002 * 106.856895;

/// Spectral data from which the share of sunlight transmitted by the atmosphere follows.
struct SpectralRow {
  double sun;          ///< radiance outside the atmosphere [W/(m^2 sr nm)]
  double ozone;        ///< absorption [1/cm]
  double water_vapor;  ///< absorption [1/cm]
};

constexpr double kFirstWavelength = 380, kWavelengthStep = 10;  // [nm]

/// The paper's table 2 up to 750 nm. Mixed gases absorb only at longer wavelengths.
constexpr std::array<SpectralRow, 38> kSpectrum{{
    {16559.0, 0, 0},         {16233.7, 0, 0},          {21127.5, 0, 0},     {25888.2, 0, 0},
    {25829.1, 0, 0},         {24232.3, 0, 0},          {26760.5, 0, 0},     {29658.3, 0.003, 0},
    {30545.4, 0.006, 0},     {30057.5, 0.009, 0},      {30663.7, 0.014, 0}, {28830.4, 0.021, 0},
    {28712.1, 0.030, 0},     {27825.0, 0.040, 0},      {27100.6, 0.048, 0}, {27233.6, 0.063, 0},
    {26361.3, 0.075, 0},     {25503.8, 0.085, 0},      {25060.2, 0.103, 0}, {25311.6, 0.120, 0},
    {25355.9, 0.120, 0},     {25134.2, 0.115, 0},      {24631.5, 0.125, 0}, {24173.2, 0.120, 0},
    {23685.3, 0.105, 0},     {23212.1, 0.090, 0},      {22827.7, 0.079, 0}, {22339.8, 0.067, 0},
    {21970.2, 0.057, 0},     {21526.7, 0.048, 0},      {21097.9, 0.036, 0}, {20728.3, 0.028, 0.016},
    {20240.4, 0.023, 0.024}, {19870.8, 0.018, 0.0125}, {19427.2, 0.014, 1}, {19072.4, 0.011, 0.87},
    {18628.9, 0.010, 0.061}, {18259.2, 0.009, 0.001},
}};

double cubic(double t, double c3, double c2, double c1, double c0) {
  return ((c3 * t + c2) * t + c1) * t + c0;
}

/// The share of light of `wavelength` [nm] that is transmitted through `mass` times the vertical
/// air mass, with the paper's amounts of ozone and water.
double transmittance(const SpectralRow& row, double wavelength, double mass, double turbidity) {
  constexpr double kOzone = 0.35, kWater = 2, kAerosolExponent = 1.3;  // [cm], [cm], [1]
  const double micrometres = wavelength / 1000;
  const double aerosol = 0.04608365822050 * turbidity - 0.04586025928522;
  const double wet = row.water_vapor * kWater * mass;
  return std::exp(-0.008735 * std::pow(micrometres, -4.08) * mass -
                  aerosol * std::pow(micrometres, -kAerosolExponent) * mass -
                  row.ozone * kOzone * mass - 0.2385 * wet / std::pow(1 + 20.07 * wet, 0.45));
}

}  // namespace

double PreethamSky::Perez::evaluate(double zenith, double gamma) const {
  const double cosine = std::cos(gamma);
  return (1 + a * std::exp(b / std::cos(zenith))) *
         (1 + c * std::exp(d * gamma) + e * cosine * cosine);
}

PreethamSky::PreethamSky(double turbidity, double sun_zenith) {
  const double t = turbidity, s = sun_zenith;
  perez_[0] = {0.17872 * t - 1.46303, -0.35540 * t + 0.42749, -0.02266 * t + 5.32505,
               0.12064 * t - 2.57705, -0.06696 * t + 0.37027};
  perez_[1] = {-0.01925 * t - 0.25922, -0.06651 * t + 0.00081, -0.00041 * t + 0.21247,
               -0.06409 * t - 0.89887, -0.00325 * t + 0.04517};
  perez_[2] = {-0.01669 * t - 0.26078, -0.09495 * t + 0.00921, -0.00792 * t + 0.21023,
               -0.04405 * t - 1.65369, -0.01092 * t + 0.05291};
  const double chi = (4.0 / 9 - t / 120) * (std::numbers::pi - 2 * s);
  zenith_[0] = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
  zenith_[1] = t * t * cubic(s, 0.00165, -0.00374, 0.00208, 0) +
               t * cubic(s, -0.02902, 0.06377, -0.03202, 0.00394) +
               cubic(s, 0.11693, -0.21196, 0.06052, 0.25885);
  zenith_[2] = t * t * cubic(s, 0.00275, -0.00610, 0.00316, 0) +
               t * cubic(s, -0.04214, 0.08970, -0.04153, 0.00515) +
               cubic(s, 0.15346, -0.26756, 0.06669, 0.26688);
  for (int i = 0; i < 3; ++i) norm_[i] = 1 / perez_[i].evaluate(0, s);
}

Rgb PreethamSky::radiance(double zenith, double gamma) const {
  double value[3];
  for (int i = 0; i < 3; ++i) {
    value[i] = zenith_[i] * norm_[i] * perez_[i].evaluate(zenith, gamma);
  }
  const double luminance = 1000 * std::max(0.0, value[0]);
  return rgb_from_xyz(xyz_from_xyy(value[1], value[2], luminance / kLuminancePerRadiance));
}

Rgb preetham_sun_radiance(double turbidity, double sun_zenith) {
  const double degrees = sun_zenith * 180 / std::numbers::pi;
  const double mass = 1 / (std::cos(sun_zenith) + 0.15 * std::pow(93.885 - degrees, -1.253));
  Xyz sum;
  double weights = 0;
  for (std::size_t i = 0; i < kSpectrum.size(); ++i) {
    const double wavelength = kFirstWavelength + kWavelengthStep * static_cast<double>(i);
    const Xyz matching = matching_functions(wavelength);
    sum += kSpectrum[i].sun * transmittance(kSpectrum[i], wavelength, mass, turbidity) * matching;
    weights += matching.y;
  }
  return rgb_from_xyz((1 / weights) * sum);
}

}  // namespace pharos
