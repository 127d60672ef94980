#include "film_estimate.h"

#include <array>
#include <cmath>

#include <pharos/core/parallel.h>

namespace pharos {
namespace {

/// The B3 spline at distances from 0 to 2 [pixels].
constexpr std::array<double, 3> kSpline{3.0 / 8, 1.0 / 4, 1.0 / 16};

}  // namespace

void Denoising::describe(Schema<Denoising>& s) {
  s.field(
       "levels", &Denoising::levels,
       "Number of passes of a filter over 5 x 5 pixels, which lie twice as far apart from pass to "
       "pass; 0: no denoising")
      .at_most(8);
  s.field("albedo_edge", &Denoising::albedo_edge,
          "Pixels whose reflectances differ by more share little")
      .above(0);
  s.field("normal_edge", &Denoising::normal_edge,
          "Pixels whose normals differ by more share little")
      .above(0);
}

void FilmEstimate::add(Vec2 film, const Sample& sample) {
  Pixel& pixel = pixels_[PixelMap::index(window_, film)];
  pixel.value += sample.value;
  pixel.paths += sample.paths;
  // A single undefined feature would stay in the sums forever.
  if (!is_finite(sample.albedo) || !is_finite(sample.normal)) return;
  pixel.count += 1;
  pixel.albedo += sample.albedo;
  pixel.normal += sample.normal;
}

double FilmEstimate::mean() const {
  double value = 0, paths = 0;
  for (const Pixel& pixel : pixels_) {
    value += pixel.value;
    paths += pixel.paths;
  }
  return paths > 0 ? value / paths : 0;
}

std::vector<FilmEstimate::Pixel> FilmEstimate::with_mean_features() const {
  std::vector<Pixel> image = pixels_;
  for (Pixel& pixel : image) {
    const auto each = static_cast<float>(1 / std::max(pixel.count, 1.0));
    pixel.albedo *= each;
    pixel.normal = each * pixel.normal;
  }
  return image;
}

std::vector<FilmEstimate::Pixel> FilmEstimate::filtered(const std::vector<Pixel>& image, int step,
                                                        const Denoising& rule) const {
  const auto similarity = [&](const Pixel& a, const Pixel& b) {
    const Vec3 normals = (a.normal - b.normal) / rule.normal_edge;
    double distance = dot(normals, normals);
    for (int c = 0; c < 3; ++c) {
      distance += square(double{a.albedo[c]} - b.albedo[c]) / square(rule.albedo_edge);
    }
    return std::exp(-distance);
  };
  std::vector<Pixel> result = image;
  parallel_for(static_cast<std::size_t>(window_.height()), [&](std::size_t row) {
    const int y = window_.y0 + static_cast<int>(row);
    for (int x = window_.x0; x < window_.x1; ++x) {
      Pixel& pixel = result[window_.index(x, y)];
      pixel.value = pixel.paths = 0;
      for (int v = -2; v <= 2; ++v) {
        for (int u = -2; u <= 2; ++u) {
          if (!window_.contains(x + step * u, y + step * v)) continue;
          const Pixel& other = image[window_.index(x + step * u, y + step * v)];
          const double weight =
              kSpline[std::abs(u)] * kSpline[std::abs(v)] * similarity(pixel, other);
          pixel.value += weight * other.value;
          pixel.paths += weight * other.paths;
        }
      }
    }
  });
  return result;
}

PixelMap FilmEstimate::denoised(const Denoising& rule) const {
  std::vector<Pixel> image = with_mean_features();
  for (std::uint32_t level = 0; level < rule.levels; ++level) {
    image = filtered(image, 1 << level, rule);
  }
  std::vector<float> values;
  values.reserve(image.size());
  for (const Pixel& pixel : image) {
    values.push_back(pixel.paths > 0 ? static_cast<float>(pixel.value / pixel.paths) : 0.0f);
  }
  return {window_, std::move(values)};
}

void FilmEstimate::archive(Archive& archive) {
  const std::size_t count = pixels_.size();
  archive(pixels_);
  bool is_sound = pixels_.size() == count;
  for (const Pixel& pixel : pixels_) is_sound &= pixel.value >= 0 && pixel.paths >= 0;
  archive.expect(is_sound, "what was learned of pixels");
}

}  // namespace pharos
