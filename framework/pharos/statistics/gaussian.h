#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Cholesky>

#include <pharos/core/archive.h>

/// Normal distributions in D dimensions and the moments of points that they are made of. All in
/// double precision.
namespace pharos::statistics {

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;
template <int D>
using Matrix = Eigen::Matrix<double, D, D>;

/// A normal distribution. The covariance is symmetric and positive definite.
template <int D>
struct Gaussian {
  Vector<D> mean = Vector<D>::Zero();
  Matrix<D> covariance = Matrix<D>::Identity();
  void archive(Archive& archive) { archive(mean, covariance); }
};

/// Weighted moments of points about a fixed origin.
template <int D>
struct Moments {
  double weight = 0;                     ///< sum of w
  Vector<D> first = Vector<D>::Zero();   ///< sum of w x
  Matrix<D> second = Matrix<D>::Zero();  ///< sum of w x x^T

  void archive(Archive& archive) { archive(weight, first, second); }

  Moments& operator+=(const Moments& other) {
    weight += other.weight;
    first += other.first;
    second += other.second;
    return *this;
  }
  Moments& operator*=(double factor) {
    weight *= factor;
    first *= factor;
    second *= factor;
    return *this;
  }
  friend Moments operator+(Moments a, const Moments& b) { return a += b; }

  /// Returns the weighted mean. Requires weight > 0.
  Vector<D> mean() const { return first / weight; }
  /// Returns the sum of w (x - center) (x - center)^T.
  Matrix<D> scatter(const Vector<D>& center) const {
    const Matrix<D> mixed = first * center.transpose();
    return second - mixed - mixed.transpose() + weight * center * center.transpose();
  }
  /// Returns the weighted covariance about the mean. Requires weight > 0.
  Matrix<D> covariance() const { return scatter(mean()) / weight; }

  /// Returns the moments of points with this weight, mean and covariance.
  static Moments of(double weight, const Vector<D>& mean, const Matrix<D>& covariance) {
    return {weight, weight * mean, weight * (covariance + mean * mean.transpose())};
  }
};

/// Splits points with these moments into two halves whose moments add up to them. The means of the
/// halves lie at distance `apart` on both sides of the mean, with apart = S e / (2 sqrt(e^T S e))
/// for the covariance S and a direction e. Each half has the covariance S - apart apart^T (3/4 of
/// the variance along e). Requires weight > 0.
template <int D>
std::array<Moments<D>, 2> halves(const Moments<D>& moments, const Vector<D>& direction) {
  const Matrix<D> covariance = moments.covariance();
  const double variance = direction.dot(covariance * direction);
  Vector<D> apart = Vector<D>::Zero();
  if (variance > 0) apart = covariance * direction / (2 * std::sqrt(variance));
  const Matrix<D> left = covariance - apart * apart.transpose();
  const Vector<D> mean = moments.mean();
  return {Moments<D>::of(moments.weight / 2, mean + apart, left),
          Moments<D>::of(moments.weight / 2, mean - apart, left)};
}

/// Returns the symmetric matrix with all eigenvalues below `floor` raised to `floor`. The
/// eigenvectors stay the same. D is 2, 3, 6 or 9.
template <int D>
Matrix<D> with_eigenvalues_above(double floor, const Matrix<D>& symmetric);

/// Returns the unit eigenvectors as columns, in the order of ascending eigenvalues. D is 3, 6 or 9.
template <int D>
Matrix<D> eigenvectors(const Matrix<D>& symmetric);

/// Returns the unit eigenvector of the largest eigenvalue.
Vector<3> principal_axis(const Matrix<3>& symmetric);

/// The logarithm of a normal density, prepared for evaluation: log N(x) = constant - |W x -
/// center|^2 / 2, where W is the inverse of the covariance's lower Cholesky factor.
template <int D>
class LogDensity {
 public:
  LogDensity() = default;
  explicit LogDensity(const Gaussian<D>& gaussian) {
    const Eigen::LLT<Matrix<D>> factor(gaussian.covariance);
    const Matrix<D> inverse = factor.matrixL().solve(Matrix<D>::Identity());
    whitening_ = inverse;
    center_ = inverse * gaussian.mean;
    constant_ = inverse.diagonal().array().log().sum() - 0.5 * D * std::log(2 * EIGEN_PI);
  }

  /// Evaluates the logarithm at the point with these coordinates [log 1/unit^D]. T is a number, or
  /// a vector of numbers for several points side by side.
  template <class T>
  T operator()(const std::array<T, D>& x) const {
    T squared{};
    for (int row = 0; row < D; ++row) {
      T white = whitening_(row, 0) * x[0] - center_[row];
      for (int column = 1; column <= row; ++column) {
        white = white + whitening_(row, column) * x[column];
      }
      squared = squared + white * white;
    }
    return constant_ - 0.5 * squared;
  }

 private:
  Matrix<D> whitening_;
  Vector<D> center_;
  double constant_ = 0;
};

}  // namespace pharos::statistics
