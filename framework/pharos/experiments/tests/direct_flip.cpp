#include "direct_flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace pharos::test {
namespace {

using Triple = std::array<double, 3>;
using Values = std::vector<double>;
using Picture = std::vector<Triple>;

// The white point, and the conversion back to RGB, with nine digits.
constexpr Triple kWhite{0.950428545, 1, 1.088900371};

Triple xyz(const Triple& c) {
  return {(10135552 * c[0] + 8788810 * c[1] + 4435075 * c[2]) / 24577794,
          (2613072 * c[0] + 8788810 * c[1] + 887015 * c[2]) / 12288897,
          (1425312 * c[0] + 8788810 * c[1] + 70074185 * c[2]) / 73733382};
}

Triple rgb(const Triple& v) {
  return {3.241003275 * v[0] - 1.537398934 * v[1] - 0.498615861 * v[2],
          -0.969224334 * v[0] + 1.875930071 * v[1] + 0.041554224 * v[2],
          0.055639423 * v[0] - 0.204011202 * v[1] + 1.057148933 * v[2]};
}

Triple ycxcz(const Triple& linear) {
  const Triple v = xyz(linear);
  const double x = v[0] / kWhite[0], y = v[1] / kWhite[1], z = v[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Triple rgb_of_ycxcz(const Triple& c) {
  const double y = (c[0] + 16) / 116;
  return rgb({(y + c[1] / 500) * kWhite[0], y * kWhite[1], (y - c[2] / 200) * kWhite[2]});
}

Triple hunt_lab(const Triple& linear) {
  const Triple v = xyz(linear);
  Triple f{};
  for (int i = 0; i < 3; ++i) {
    const double t = v[i] / kWhite[i];
    f[i] = t > std::pow(6.0 / 29, 3) ? std::cbrt(t) : t * std::pow(29.0 / 6, 2) / 3 + 4.0 / 29;
  }
  const double lightness = 116 * f[1] - 16;
  return {lightness, lightness / 100 * 500 * (f[0] - f[1]), lightness / 100 * 200 * (f[1] - f[2])};
}

double hyab(const Triple& a, const Triple& b) {
  return std::abs(a[0] - b[0]) + std::sqrt(std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
}

/// A square table of filter weights.
struct Table {
  int radius;
  Values weights;

  Table(int r, const std::function<double(int, int)>& weight) : radius(r) {
    for (int y = -r; y <= r; ++y) {
      for (int x = -r; x <= r; ++x) weights.push_back(weight(x, y));
    }
  }
  double at(const std::function<double(int, int)>& value, int x, int y) const {
    double sum = 0;
    std::size_t i = 0;
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) sum += weights[i++] * value(x + dx, y + dy);
    }
    return sum;
  }
};

Table sensitivity(double a1, double b1, double a2, double b2, double degrees) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * M_PI * M_PI)) * degrees));
  Table table(radius, [&](int x, int y) {
    const double z = (x * x + y * y) / (degrees * degrees);
    return a1 * std::sqrt(M_PI / b1) * std::exp(-M_PI * M_PI * z / b1) +
           a2 * std::sqrt(M_PI / b2) * std::exp(-M_PI * M_PI * z / b2);
  });
  double sum = 0;
  for (const double w : table.weights) sum += w;
  for (double& w : table.weights) w /= sum;
  return table;
}

/// Returns a detector along x, or along y if `turned` is true.
Table detector(bool point, bool turned, double degrees) {
  const double deviation = 0.5 * 0.082 * degrees;
  Table table(static_cast<int>(std::ceil(3 * deviation)), [&](int x, int y) {
    if (turned) std::swap(x, y);
    const double gauss = std::exp(-(x * x + y * y) / (2 * deviation * deviation));
    return gauss * (point ? x * x / (deviation * deviation) - 1 : -x);
  });
  double above = 0, below = 0;
  for (const double w : table.weights) (w > 0 ? above : below) += std::abs(w);
  for (double& w : table.weights) w /= w > 0 ? above : below;
  return table;
}

/// The filter responses of one displayed image at a pixel.
struct Response {
  Triple color;
  double edge, point;
};

std::vector<Response> respond(const Picture& shown, int width, int height, double degrees) {
  const Table a = sensitivity(1, 0.0047, 0, 1e-5, degrees);
  const Table rg = sensitivity(1, 0.0053, 0, 1e-5, degrees);
  const Table by = sensitivity(34.1, 0.04, 13.5, 0.025, degrees);
  const auto opponent = [&](int channel) {
    return [&, channel](int x, int y) {
      const int column = std::clamp(x, 0, width - 1), row = std::clamp(y, 0, height - 1);
      return ycxcz(shown[static_cast<std::size_t>(row) * width + column])[channel];
    };
  };
  const auto lightness = [&](int x, int y) { return (opponent(0)(x, y) + 16) / 116; };
  const Table ex = detector(false, false, degrees), ey = detector(false, true, degrees);
  const Table px = detector(true, false, degrees), py = detector(true, true, degrees);
  std::vector<Response> all;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Triple c = rgb_of_ycxcz(
          {a.at(opponent(0), x, y), rg.at(opponent(1), x, y), by.at(opponent(2), x, y)});
      for (double& v : c) v = std::clamp(v, 0.0, 1.0);
      all.push_back({hunt_lab(c), std::hypot(ex.at(lightness, x, y), ey.at(lightness, x, y)),
                     std::hypot(px.at(lightness, x, y), py.at(lightness, x, y))});
    }
  }
  return all;
}

double difference(const Response& a, const Response& b) {
  const double most = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
  const double color = std::pow(hyab(a.color, b.color), 0.7);
  const double error = color < 0.4 * most
                           ? 0.95 / (0.4 * most) * color
                           : 0.95 + (color - 0.4 * most) / (most - 0.4 * most) * (1 - 0.95);
  const double feature =
      std::sqrt(std::max(std::abs(a.edge - b.edge), std::abs(a.point - b.point)) / std::sqrt(2.0));
  return std::pow(error, 1 - feature);
}

Values differences(const PixelPair& pair, double degrees,
                   const std::function<double(double)>& tone) {
  const auto shown = [&](const std::vector<Rgb>& pixels) {
    Picture picture;
    for (const Rgb& c : pixels) {
      picture.push_back({std::clamp(tone(c.r), 0.0, 1.0), std::clamp(tone(c.g), 0.0, 1.0),
                         std::clamp(tone(c.b), 0.0, 1.0)});
    }
    return picture;
  };
  const auto a = respond(shown(pair.image), pair.width, pair.height, degrees);
  const auto b = respond(shown(pair.reference), pair.width, pair.height, degrees);
  Values result;
  for (std::size_t i = 0; i < a.size(); ++i) result.push_back(difference(a[i], b[i]));
  return result;
}

}  // namespace

std::vector<double> direct_flip(const PixelPair& pair, double pixels_per_degree) {
  return differences(pair, pixels_per_degree, [](double v) { return v; });
}

std::vector<double> direct_hdr_flip(const PixelPair& pair, double pixels_per_degree) {
  // Narkowicz' curve is applied to 0.6 x. The x with the value 0.85 is the root of a quadratic
  // equation.
  const auto tone = [](double v) {
    const double x = 0.6 * std::max(v, 0.0);
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  };
  const double a = 2.51 - 0.85 * 2.43, b = 0.03 - 0.85 * 0.59, c = -0.85 * 0.14;
  const double shown = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a) / 0.6;
  Values luminances;
  for (const Rgb& p : pair.reference) {
    luminances.push_back(0.2126 * p.r + 0.7152 * p.g + 0.0722 * p.b);
  }
  std::sort(luminances.begin(), luminances.end());
  const std::size_t n = luminances.size();
  const double median = 0.5 * (luminances[(n - 1) / 2] + luminances[n / 2]);
  const double start = std::log2(shown / luminances.back()), stop = std::log2(shown / median);
  const int count = std::max(2, static_cast<int>(std::ceil(stop - start)));
  Values worst(pair.reference.size());
  for (int i = 0; i < count; ++i) {
    const double scale = std::pow(2, start + i * (stop - start) / (count - 1));
    const Values errors =
        differences(pair, pixels_per_degree, [&](double v) { return tone(scale * v); });
    for (std::size_t k = 0; k < worst.size(); ++k) worst[k] = std::max(worst[k], errors[k]);
  }
  return worst;
}

}  // namespace pharos::test
