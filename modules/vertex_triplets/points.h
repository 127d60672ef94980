#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <pharos/core/simd.h>
#include <pharos/statistics/gaussian.h>

namespace pharos::vertex_triplets {

using statistics::Matrix;
using statistics::Vector;

/// Points with weights > 0, stored by coordinate in registers of eight. Unused lanes of the last
/// register have weight 0.
template <int D>
class Points {
 public:
  void add(const std::array<float, D>& x, float weight) {
    const std::size_t lane = size_ % 8;
    if (lane == 0) {
      registers_.emplace_back();
      // Fills unused lanes with a point, not with zero, so that their densities are harmless.
      for (int axis = 0; axis < D; ++axis) registers_.back().x[axis] = all8(x[axis]);
    }
    for (int axis = 0; axis < D; ++axis) registers_.back().x[axis][lane] = x[axis];
    registers_.back().weight[lane] = weight;
    ++size_;
  }
  /// Adds point `i` of other points.
  void add(const Points& others, std::size_t i) {
    add(others.at(i), others.registers_[i / 8].weight[i % 8]);
  }
  void add(const Points& others) {
    for (std::size_t i = 0; i < others.size(); ++i) add(others, i);
  }

  struct Register {
    std::array<Float8, D> x;
    Float8 weight{};
  };
  std::size_t size() const { return size_; }
  /// Returns point `i`.
  std::array<float, D> at(std::size_t i) const {
    std::array<float, D> x;
    for (int axis = 0; axis < D; ++axis) x[axis] = registers_[i / 8].x[axis][i % 8];
    return x;
  }
  const std::vector<Register>& registers() const { return registers_; }

 private:
  std::vector<Register> registers_;
  std::size_t size_ = 0;
};

/// Sums over points with weights v, about an origin near them.
template <int D>
struct Sums {
  static constexpr int kPairs = D * (D + 1) / 2;

  double weight = 0;          ///< of v
  double squared_weight = 0;  ///< of v^2
  Vector<D> first = Vector<D>::Zero();
  Matrix<D> second = Matrix<D>::Zero();

  /// Returns the effective number of points (Kish 1965; Schuessler et al. 2022, eq. 43). Requires
  /// weight > 0.
  double count() const { return weight * weight / squared_weight; }
  /// Returns the vector from the origin to the mean. Requires weight > 0.
  Vector<D> offset() const { return first / weight; }
  /// Returns the covariance about the mean. Requires weight > 0.
  Matrix<D> covariance() const { return second / weight - offset() * offset().transpose(); }
};

/// The same sums for eight streams of points side by side.
template <int D>
struct Sums8 {
  Float8 weight{}, squared_weight{};
  std::array<Float8, D> first{};
  std::array<Float8, Sums<D>::kPairs> second{};

  /// Adds a point in each lane, at `d` from the origin.
  void add(const Float8& v, const std::array<Float8, D>& d) {
    weight += v;
    squared_weight += v * v;
    for (int row = 0, i = 0; row < D; ++row) {
      const Float8 weighted = v * d[row];
      first[row] += weighted;
      for (int column = 0; column <= row; ++column) second[i++] += weighted * d[column];
    }
  }
  Sums<D> summed() const {
    Sums<D> sums;
    sums.weight = sum(weight);
    sums.squared_weight = sum(squared_weight);
    for (int row = 0, i = 0; row < D; ++row) {
      sums.first[row] = sum(first[row]);
      for (int column = 0; column <= row; ++column) {
        sums.second(row, column) = sums.second(column, row) = sum(second[i++]);
      }
    }
    return sums;
  }
};

}  // namespace pharos::vertex_triplets
