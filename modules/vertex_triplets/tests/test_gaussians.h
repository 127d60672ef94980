#pragma once

#include <pharos/core/random.h>
#include <pharos/guiding/contract/spatial_mixture.h>
#include <pharos/statistics/gaussian.h>

namespace pharos::vertex_triplets::testing {

using statistics::Gaussian;
using statistics::Matrix;
using statistics::Vector;

// Eigen's decompositions take long to compile, so test_gaussians.cpp instantiates these functions
// once, for 3, 6 and 9 dimensions.

/// Returns independent standard normal numbers.
template <int D>
Vector<D> normal_vector(RandomStream& random);

/// Returns a Gaussian with random axes and deviations between `least` and 1 times `size`.
template <int D>
Gaussian<D> any_gaussian(RandomStream& random, double size = 1, double least = 0.1);

/// Returns a random point of the Gaussian.
template <int D>
Vector<D> point_of(const Gaussian<D>& g, RandomStream& random);

/// Returns the density of the Gaussian at a point.
template <int D>
double density(const Gaussian<D>& g, const Vector<D>& x);

SpatialGaussian spatial(const Gaussian<3>& g, float weight = 1);

/// Returns whether all eigenvalues of the matrix are positive.
bool is_positive_definite(const Matrix<9>& matrix);

}  // namespace pharos::vertex_triplets::testing
