#include "component.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

namespace pharos::vertex_triplets {
namespace {

/// Returns the component for the Cholesky factor L of a covariance. Entries above the diagonal are
/// ignored.
template <int P>
Component<P> from_factor(double weight, const statistics::Vector<P + 3>& mean,
                         const statistics::Matrix<P + 3>& l) {
  Component<P> result;
  result.weight = static_cast<float>(weight);
  for (int row = 0, i = 0; row < P + 3; ++row) {
    result.mean[row] = static_cast<float>(mean[row]);
    for (int column = 0; column <= row; ++column) {
      const bool whitens = row == column && row < P;
      result.factor[i++] = static_cast<float>(whitens ? 1 / l(row, row) : l(row, column));
    }
  }
  return result;
}

}  // namespace

template <int P>
bool Component<P>::is_sound() const {
  const auto is_finite = [](float x) { return std::isfinite(x); };
  bool sound = weight > 0 && std::isfinite(weight) &&
               std::all_of(mean.begin(), mean.end(), is_finite) &&
               std::all_of(factor.begin(), factor.end(), is_finite);
  for (int row = 0; row < kSize; ++row) sound = sound && factor[triangle(row + 1) - 1] > 0;
  return sound;
}

template <int P>
auto Component<P>::cholesky() const -> statistics::Matrix<kSize> {
  statistics::Matrix<kSize> l = statistics::Matrix<kSize>::Zero();
  for (int row = 0, i = 0; row < kSize; ++row) {
    for (int column = 0; column <= row; ++column, ++i) {
      l(row, column) = row == column && row < P ? 1.0 / factor[i] : double{factor[i]};
    }
  }
  return l;
}

template <int P>
Component<P> make_component(double weight, const statistics::Gaussian<P + 3>& gaussian) {
  const Eigen::LLT<statistics::Matrix<P + 3>> factor(gaussian.covariance);
  if (factor.info() != Eigen::Success) return {};
  return from_factor<P>(weight, gaussian.mean, factor.matrixL());
}

Component<6> reversed(const Component<6>& component) {
  // M is L with the order of its rows by vertex reversed. The factor of M M^T is R^T, where
  // M^T = Q R. This is exact up to rounding; a covariance would lose half of the digits.
  const statistics::Matrix<9> l = component.cholesky();
  statistics::Matrix<9> m;
  statistics::Vector<9> mean;
  for (int vertex = 0; vertex < 3; ++vertex) {
    m.middleRows<3>(3 * vertex) = l.middleRows<3>(6 - 3 * vertex);
    for (int axis = 0; axis < 3; ++axis) {
      mean[3 * vertex + axis] = component.mean[6 - 3 * vertex + axis];
    }
  }
  statistics::Matrix<9> r =
      Eigen::HouseholderQR<statistics::Matrix<9>>(m.transpose()).matrixQR().transpose();
  for (int column = 0; column < 9; ++column) {
    if (r(column, column) < 0) r.col(column) *= -1;
  }
  return from_factor<6>(component.weight, mean, r);
}

template struct Component<3>;
template struct Component<6>;
template Component<3> make_component<3>(double, const statistics::Gaussian<6>&);
template Component<6> make_component<6>(double, const statistics::Gaussian<9>&);

}  // namespace pharos::vertex_triplets
