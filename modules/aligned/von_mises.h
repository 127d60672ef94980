#pragma once

#include <vector>

#include "direction_histogram.h"

/// Von Mises distributions of directions, fitted to histograms with the reverse Kullback-Leibler
/// divergence (section 5.2 of the paper). This divergence is mode-seeking: the fit covers one mode
/// and ignores the others.
namespace pharos::aligned {

/// A distribution over directions. Up to a constant factor, its density is exp(kappa cos 2 (x -
/// mean)): the density of eq. 16 with doubled angles, because directions are axial.
struct VonMises {
  double mean = 0;  ///< [degrees], in [0, 180)
  double kappa =
      50;  ///< concentration [1]; the standard deviation is about 29 / sqrt(kappa) degrees
};

/// The distribution p to which von Mises distributions are fitted: the distribution of an
/// integrand's directions, in whole degrees. Directions near the axes carry no information, because
/// all point sets are aligned with the axes. Divergences therefore compare distributions over the
/// other directions only, and they do not penalize means near the axes.
class DirectionDistribution {
 public:
  /// Directions less than `axis_width` + 1 degrees from an axis are left out. The share of a bin is
  /// at least `floor` times the mean of all shares, so empty bins have a logarithm.
  DirectionDistribution(const DirectionHistogram& histogram, int axis_width, double floor);

  /// Returns whether all mass of the histogram lies near the axes.
  bool empty() const { return total_ == 0; }
  /// Returns the share of a direction [1]; zero near the axes.
  double share(int direction) const { return shares_[static_cast<std::size_t>(direction)]; }
  /// Returns the share of the whole histogram [1] that the directions within `width` degrees hold,
  /// except directions near the axes. The whole histogram includes the axes, so a small rest beside
  /// strong axes is not a mode.
  double mass(int direction, int width) const;

  /// Returns D(q || p) [nats] (eq. 17).
  double divergence(const VonMises& q) const;

  /// The derivatives of divergence().
  struct Gradient {
    double mean = 0;   ///< [nats / degree]
    double kappa = 0;  ///< [nats]
  };
  Gradient gradient(const VonMises& q) const;

 private:
  /// A direction that does not lie near an axis.
  struct Bin {
    double degrees;
    double log_share;
  };
  /// The probabilities of q in all bins, and the differences between the logarithms of q and p.
  struct Terms;
  Terms terms(const VonMises& q) const;

  DirectionHistogram shares_{};
  double total_ = 0;     ///< sum of the histogram without the axes
  double of_whole_ = 0;  ///< this sum divided by the sum of the whole histogram [1]
  std::vector<Bin> bins_;
};

/// Returns the mean, a whole number of degrees at most `window` degrees from `start`, of the von
/// Mises distribution with concentration `kappa` that has the least divergence. The mean may lie
/// near an axis. In this case, the search has found the flank of the axis's own mode.
int best_mean(const DirectionDistribution& p, double kappa, int start, int window);

/// The parameters of descend().
struct DescentSettings {
  int steps = 400;
  double mean_step = 0.25;   ///< length of the first step of the mean [degrees]
  double kappa_step = 0.05;  ///< length of the first step of the logarithm of kappa [1]
};

/// Returns the local minimum of the divergence, with respect to mean and concentration, that
/// gradient descent reaches from `start` (eq. 18).
VonMises descend(const DirectionDistribution& p, VonMises start,
                 const DescentSettings& settings = {});

}  // namespace pharos::aligned
