#pragma once

#include <cmath>

namespace pharos::statistics {

/// The constants of Adam, with the values that its paper proposes but for the learning rate, which
/// belongs to the problem.
struct AdamRates {
  double learning_rate = 0.01;  ///< > 0: about the length of a step [units of the parameter]
  double mean_decay = 0.9;      ///< beta_1 in [0, 1): how long the mean gradient remembers
  double square_decay = 0.999;  ///< beta_2 in [0, 1): how long the mean square remembers
  double epsilon = 1e-8;        ///< > 0: gradients far below it move nothing
};

/// Stochastic gradient descent of one parameter whose steps are scaled by the gradients' own size
/// (Kingma and Ba 2015, "Adam: A Method for Stochastic Optimization", algorithm 1). A value: copies
/// go on from the same point.
class Adam {
 public:
  /// The running sums behind the steps, for saving.
  struct Moments {
    double mean = 0;         ///< decaying sum of gradients
    double square = 0;       ///< decaying sum of squared gradients
    double mean_left = 1;    ///< mean_decay^steps: what the zero at the start still weighs
    double square_left = 1;  ///< square_decay^steps
  };

  Adam() = default;
  explicit Adam(const Moments& moments) : moments_(moments) {}

  /// What to add to the parameter, given the objective's gradient there, to make the objective
  /// smaller. The first step is learning_rate long for any gradient well above epsilon; all are
  /// zero as long as all gradients were.
  double step(double gradient, const AdamRates& rates) {
    Moments& m = moments_;
    m.mean += (1 - rates.mean_decay) * (gradient - m.mean);
    m.square += (1 - rates.square_decay) * (gradient * gradient - m.square);
    m.mean_left *= rates.mean_decay;
    m.square_left *= rates.square_decay;
    const double mean = m.mean / (1 - m.mean_left);
    const double root = std::sqrt(m.square / (1 - m.square_left));
    return -rates.learning_rate * mean / (root + rates.epsilon);
  }

  const Moments& moments() const { return moments_; }

 private:
  Moments moments_;
};

}  // namespace pharos::statistics
