#include "power_spectrum_loss.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <tuple>

#include <pharos/core/error.h>
#include <pharos/core/parallel.h>

#include "sixteen_floats.h"

namespace pharos::aligned {
namespace {

/// Number of points whose waves are multiplied at once. It is small enough for their table to stay
/// in the cache.
constexpr std::size_t kBlock = 128;
constexpr std::size_t kVectors = kBlock / SixteenFloats::kCount;

/// Largest number of partial sums of amplitudes, for any number of threads.
constexpr std::size_t kMostParts = 16;

/// exp(-2 pi i f u) of one frequency f for the coordinates u of a block of points; 0 at unused
/// places.
struct Waves {
  SixteenFloats real[kVectors], imaginary[kVectors];
};

/// Computes the products of two waves, which are the waves of the sum of both frequencies.
void multiply(const Waves& a, const Waves& b, Waves& product) {
  for (std::size_t k = 0; k < kVectors; ++k) {
    const SixteenFloats real = a.real[k] * b.real[k] - a.imaginary[k] * b.imaginary[k];
    product.imaginary[k] = a.real[k] * b.imaginary[k] + a.imaginary[k] * b.real[k];
    product.real[k] = real;
  }
}

/// Returns the waves of `frequency` for coordinates [begin, end), at most one block of coordinates.
Waves waves_of(const std::vector<double>& coordinates, std::size_t begin, std::size_t end,
               int frequency) {
  float real[kBlock] = {}, imaginary[kBlock] = {};
  for (std::size_t i = begin; i < end; ++i) {
    const double turns = frequency * (coordinates[i] - std::floor(coordinates[i]));
    const double angle = -2 * std::numbers::pi * (turns - std::floor(turns));
    real[i - begin] = static_cast<float>(std::cos(angle));
    imaginary[i - begin] = static_cast<float>(std::sin(angle));
  }
  Waves waves;
  std::memcpy(waves.real, real, sizeof real);
  std::memcpy(waves.imaginary, imaginary, sizeof imaginary);
  return waves;
}

/// Returns the index at which part `part` of `parts` begins, for `count` elements.
std::size_t part_begin(std::size_t part, std::size_t parts, std::size_t count) {
  return part * count / parts;
}

std::size_t block_count(const Coordinates& points) {
  return (points.size() + kBlock - 1) / kBlock;
}

}  // namespace

/// A block of points with the waves of the points' y coordinates for all frequencies.
class PowerSpectrumLoss::Block {
 public:
  Block(const PowerSpectrumLoss& loss, const Coordinates& points, std::size_t number)
      : loss_(loss),
        begin_(number * kBlock),
        end_(std::min(begin_ + kBlock, points.size())),
        step_(waves_of(points.x, begin_, end_, 1)),
        first_(waves_of(points.x, begin_, end_, loss.rows_.front().x)),
        along_y_(static_cast<std::size_t>(loss.highest_y_) + 1) {
    const Waves once = waves_of(points.y, begin_, end_, 1);
    along_y_[0] = waves_of(points.y, begin_, end_, 0);
    for (std::size_t y = 1; y < along_y_.size(); ++y) multiply(along_y_[y - 1], once, along_y_[y]);
  }

  /// Adds the sums of this block's waves to `sums`, which holds the real and imaginary part of each
  /// term.
  void add_amplitudes(std::vector<double>& sums) const {
    for_each_row([&](const Row& row, const Waves& along_x) {
      for (std::size_t i = row.begin; i < row.end; ++i) {
        const Waves& along_y = along_y_[static_cast<std::size_t>(loss_.terms_[i].y)];
        SixteenFloats real, imaginary;
        for (std::size_t k = 0; k < kVectors; ++k) {
          real += along_x.real[k] * along_y.real[k] - along_x.imaginary[k] * along_y.imaginary[k];
          imaginary +=
              along_x.real[k] * along_y.imaginary[k] + along_x.imaginary[k] * along_y.real[k];
        }
        sums[2 * i] += real.sum();
        sums[2 * i + 1] += imaginary.sum();
      }
    });
  }

  /// Adds the contribution of all terms to the gradient of this block's points. The contribution of
  /// a term with factor f is the imaginary part of conj(f) times the wave of the point, times the
  /// frequency. `factors` holds the real and imaginary part of each factor.
  void add_gradient(const std::vector<float>& factors, Coordinates& gradient) const {
    SixteenFloats by_x[kVectors], by_y[kVectors];
    for_each_row([&](const Row& row, const Waves& along_x) {
      for (std::size_t k = 0; k < kVectors; ++k) {
        const SixteenFloats x_real = along_x.real[k], x_imaginary = along_x.imaginary[k];
        SixteenFloats of_row, of_y = by_y[k];
        for (std::size_t i = row.begin; i < row.end; ++i) {
          const Waves& along_y = along_y_[static_cast<std::size_t>(loss_.terms_[i].y)];
          const SixteenFloats real = x_real * along_y.real[k] - x_imaginary * along_y.imaginary[k];
          const SixteenFloats imaginary =
              x_real * along_y.imaginary[k] + x_imaginary * along_y.real[k];
          const SixteenFloats part = factors[2 * i] * imaginary - factors[2 * i + 1] * real;
          of_row += part;
          of_y += static_cast<float>(loss_.terms_[i].y) * part;
        }
        by_x[k] += static_cast<float>(row.x) * of_row;
        by_y[k] = of_y;
      }
    });
    for (std::size_t i = begin_; i < end_; ++i) {
      const std::size_t k = (i - begin_) / SixteenFloats::kCount,
                        lane = (i - begin_) % SixteenFloats::kCount;
      gradient.x[i] += static_cast<double>(by_x[k][lane]);
      gradient.y[i] += static_cast<double>(by_y[k][lane]);
    }
  }

 private:
  /// Calls `use` with each row and the waves of the row's x.
  template <class Use>
  void for_each_row(Use&& use) const {
    Waves along_x = first_;
    int x = loss_.rows_.front().x;
    for (const Row& row : loss_.rows_) {
      for (; x < row.x; ++x) multiply(along_x, step_, along_x);
      use(row, along_x);
    }
  }

  const PowerSpectrumLoss& loss_;
  std::size_t begin_, end_;
  Waves step_, first_;
  std::vector<Waves> along_y_;
};

PowerSpectrumLoss::PowerSpectrumLoss(const std::vector<TargetPower>& frequencies) {
  double weights = 0;
  for (const TargetPower& v : frequencies) {
    if (v.x == 0 && v.y == 0) throw InputError("the power at frequency (0, 0) cannot be chosen");
    const bool is_lower = v.y < 0 || (v.y == 0 && v.x < 0);
    terms_.push_back({is_lower ? -v.x : v.x, is_lower ? -v.y : v.y, v.power, v.weight});
    weights += v.weight;
    highest_y_ = std::max(highest_y_, terms_.back().y);
  }
  if (!(weights > 0)) throw InputError("expected a frequency of positive weight, found none");
  std::ranges::sort(terms_, {}, [](const Term& t) { return std::tuple(t.x, t.y); });
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    terms_[i].weight /= weights;
    if (rows_.empty() || rows_.back().x != terms_[i].x) rows_.push_back({terms_[i].x, i, i});
    rows_.back().end = i + 1;
  }
}

/// Returns F of each term: real and imaginary part.
std::vector<double> PowerSpectrumLoss::amplitudes(const Coordinates& points) const {
  const std::size_t blocks = block_count(points), parts = std::min(kMostParts, blocks);
  std::vector<std::vector<double>> sums(parts);
  parallel_for(parts, [&](std::size_t part) {
    sums[part].resize(2 * terms_.size());
    const std::size_t end = part_begin(part + 1, parts, blocks);
    for (std::size_t b = part_begin(part, parts, blocks); b < end; ++b) {
      Block(*this, points, b).add_amplitudes(sums[part]);
    }
  });
  for (std::size_t part = 1; part < parts; ++part) {
    for (std::size_t i = 0; i < sums[0].size(); ++i) sums[0][i] += sums[part][i];
  }
  return std::move(sums[0]);
}

double PowerSpectrumLoss::evaluate(const Coordinates& points, double scale,
                                   Coordinates& gradient) const {
  const std::vector<double> amplitude = amplitudes(points);
  const auto count = static_cast<double>(points.size());
  std::vector<float> factors(amplitude.size());
  double loss = 0;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Term& term = terms_[i];
    const double real = amplitude[2 * i], imaginary = amplitude[2 * i + 1];
    const double root = std::sqrt((real * real + imaginary * imaginary) / count);
    const double error = root - std::sqrt(term.power);
    loss += term.weight * error * error;
    // The derivative of the squared error with respect to P_v. If the power is zero, the gradient
    // has no direction and is set to zero.
    const double slope = root > 0 ? error / root : 0;
    // d P_v / d x = (4 pi v_x / N) Im(conj(F_v) exp(-2 pi i v.x)), and likewise for y.
    const double factor = scale * term.weight * slope * 4 * std::numbers::pi / count;
    factors[2 * i] = static_cast<float>(factor * real);
    factors[2 * i + 1] = static_cast<float>(factor * imaginary);
  }
  parallel_for(block_count(points),
               [&](std::size_t b) { Block(*this, points, b).add_gradient(factors, gradient); });
  return loss;
}

}  // namespace pharos::aligned
