#pragma once

#include <vector>

#include "direction_histogram.h"

/// Von Mises distributions of directions, fitted to histograms by the reverse Kullback-Leibler
/// divergence (section 5.2 of the paper), which seeks one mode and leaves the others alone.
namespace pharos::aligned {

/// A distribution over directions with the density, up to a factor, exp(kappa cos 2 (x - mean)):
/// that of eq. 16 with doubled angles, as directions are axial.
struct VonMises {
  double mean = 0;  ///< [degrees], in [0, 180)
  double kappa =
      50;  ///< concentration [1]; the standard deviation is about 29 / sqrt(kappa) degrees
};

/// What is fitted to: the distribution p of an integrand's directions, in whole degrees. Directions
/// near the axes tell nothing, as all point sets are aligned with these: divergences are between
/// distributions of the other directions alone, and do not shun the neighborhood of the axes.
class DirectionDistribution {
 public:
  /// Directions less than `axis_width` + 1 degrees from an axis are left out. Bins of less than
  /// `floor` times the mean of all count as that, so that empty ones have a logarithm.
  DirectionDistribution(const DirectionHistogram& histogram, int axis_width, double floor);

  /// Whether there is nothing but near the axes.
  bool empty() const { return total_ == 0; }
  /// The share [1] of a direction; zero near the axes.
  double share(int direction) const { return shares_[static_cast<std::size_t>(direction)]; }
  /// The share [1] that the directions within `width` degrees, those near the axes left out, have
  /// of the whole histogram, axes included: what is left over beside strong axes is no mode.
  double mass(int direction, int width) const;

  /// D(q || p) [nats] (eq. 17).
  double divergence(const VonMises& q) const;

  /// The derivatives of divergence().
  struct Gradient {
    double mean = 0;   ///< [nats / degree]
    double kappa = 0;  ///< [nats]
  };
  Gradient gradient(const VonMises& q) const;

 private:
  /// A direction that is not near the axes.
  struct Bin {
    double degrees;
    double log_share;
  };
  /// Of q, over the bins: its probabilities, and their logarithms less those of p.
  struct Terms;
  Terms terms(const VonMises& q) const;

  DirectionHistogram shares_{};
  double total_ = 0;     ///< of the histogram, but for the axes
  double of_whole_ = 0;  ///< share of that in all of it [1]
  std::vector<Bin> bins_;
};

/// The whole degree at most `window` degrees from `start` that is the mean of the von Mises
/// distribution of concentration `kappa` with the least divergence. It may lie near an axis: then
/// what was found is the foot of the axis' own mode.
int best_mean(const DirectionDistribution& p, double kappa, int start, int window);

/// How descend() goes.
struct DescentSettings {
  int steps = 400;
  double mean_step = 0.25;   ///< length of the first steps of the mean [degrees]
  double kappa_step = 0.05;  ///< the same of the logarithm of kappa [1]
};

/// The local minimum of the divergence in mean and concentration that gradient descent reaches from
/// `start` (eq. 18).
VonMises descend(const DirectionDistribution& p, VonMises start,
                 const DescentSettings& settings = {});

}  // namespace pharos::aligned
