#include <cmath>

#include <boost/math/special_functions/cos_pi.hpp>
#include <boost/math/special_functions/sin_pi.hpp>

#include <pharos/core/error.h>
#include <pharos/core/transform.h>

namespace pharos {
namespace {

using Matrix = Transform::Matrix;

constexpr Matrix kIdentity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

/// The smallest ratio of the volume to the product of the edge lengths. Below it, the rows of a
/// float matrix are linearly dependent up to the rounding of their elements.
constexpr double kSingularVolume = 1e-7;

/// Returns the signed minor of the linear part without row r and column c.
double cofactor(const Matrix& m, int r, int c) {
  const auto& row1 = m[(r + 1) % 3];
  const auto& row2 = m[(r + 2) % 3];
  const int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
  return static_cast<double>(row1[c1]) * row2[c2] - static_cast<double>(row1[c2]) * row2[c1];
}

double determinant(const Matrix& m) {
  return m[0][0] * cofactor(m, 0, 0) + m[0][1] * cofactor(m, 0, 1) + m[0][2] * cofactor(m, 0, 2);
}

double row_length(const Matrix& m, int r) {
  return std::hypot(static_cast<double>(m[r][0]), static_cast<double>(m[r][1]),
                    static_cast<double>(m[r][2]));
}

bool is_finite(const Matrix& m) {
  for (const auto& row : m) {
    for (const float v : row) {
      if (!std::isfinite(v)) return false;
    }
  }
  return true;
}

/// Computes the inverse by cofactors in double precision. The result depends on the elements of `m`
/// alone, so a transform that is read back from its matrix is identical in every bit.
Matrix inverse(const Matrix& m) {
  const double volume = determinant(m);
  const double edges = row_length(m, 0) * row_length(m, 1) * row_length(m, 2);
  if (!is_finite(m) || !(std::abs(volume) > kSingularVolume * edges)) {
    throw InputError("the transform cannot be inverted");
  }
  Matrix result;
  for (int r = 0; r < 3; ++r) {
    double offset = 0;
    for (int c = 0; c < 3; ++c) {
      const double element = cofactor(m, c, r) / volume;
      result[r][c] = static_cast<float>(element);
      offset -= element * m[c][3];
    }
    result[r][3] = static_cast<float>(offset);
  }
  if (!is_finite(result)) throw InputError("the transform cannot be inverted");
  return result;
}

Matrix from_columns(Vec3 x, Vec3 y, Vec3 z, Vec3 origin) {
  return {{{x.x, y.x, z.x, origin.x}, {x.y, y.y, z.y, origin.y}, {x.z, y.z, z.z, origin.z}}};
}

}  // namespace

Transform::Transform() : forward_(kIdentity), inverse_(kIdentity) {}

Transform::Transform(const Matrix& matrix) : forward_(matrix), inverse_(inverse(matrix)) {}

Transform Transform::translate(Vec3 offset) {
  return Transform(from_columns({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, offset));
}

Transform Transform::scale(Vec3 factors) {
  return Transform(from_columns({factors.x, 0, 0}, {0, factors.y, 0}, {0, 0, factors.z}, {}));
}

Transform Transform::rotate(Vec3 axis, float degrees) {
  const double norm = std::hypot(static_cast<double>(axis.x), static_cast<double>(axis.y),
                                 static_cast<double>(axis.z));
  if (!(norm > 0) || !std::isfinite(norm)) throw InputError("the rotation axis has no direction");
  const double a[3] = {axis.x / norm, axis.y / norm, axis.z / norm};
  // Is exact for multiples of 90 degrees, so that axis-aligned scenes stay axis-aligned.
  const double turns = std::fmod(static_cast<double>(degrees), 360.0) / 180.0;
  const double s = boost::math::sin_pi(turns), c = boost::math::cos_pi(turns);
  Matrix m = kIdentity;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    m[i][i] = static_cast<float>(a[i] * a[i] * (1 - c) + c);
    m[i][j] = static_cast<float>(a[i] * a[j] * (1 - c) - a[k] * s);
    m[i][k] = static_cast<float>(a[i] * a[k] * (1 - c) + a[j] * s);
  }
  return Transform(m);
}

Transform Transform::look_at(Point3 origin, Point3 target, Vec3 up) {
  const Vec3 forward = target - origin;
  const Vec3 left = cross(up, forward);
  const float left_length = length(left);
  if (!(length(forward) > 0)) throw InputError("look_at: origin and target are the same point");
  if (!(length(up) > 0)) throw InputError("look_at: up has no direction");
  if (!(left_length > 1e-6f * length(up) * length(forward))) {
    throw InputError("look_at: up is parallel to the direction from origin to target");
  }
  const Vec3 z = normalize(forward);
  const Vec3 x = left / left_length;
  return Transform(from_columns(x, cross(z, x), z, origin));
}

Vec3 Transform::normal(Vec3 n) const {
  const auto transposed_row = [&](int c) { return dot(column(inverse_, c), n); };
  return {transposed_row(0), transposed_row(1), transposed_row(2)};
}

bool Transform::flips_handedness() const {
  return determinant(forward_) < 0;
}

Transform operator*(const Transform& a, const Transform& b) {
  Matrix product;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) {
      double sum = c == 3 ? a.forward_[r][3] : 0.0;
      for (int k = 0; k < 3; ++k) {
        sum += static_cast<double>(a.forward_[r][k]) * b.forward_[k][c];
      }
      product[r][c] = static_cast<float>(sum);
    }
  }
  return Transform(product);
}

}  // namespace pharos
