#pragma once

#include <cmath>

#include <pharos/core/archive.h>

namespace pharos::statistics {

/// The constants of Adam. The defaults are the values that the paper proposes, except for the
/// learning rate, which depends on the problem.
struct AdamRates {
  double learning_rate = 0.01;  ///< > 0: approximate step length [units of the parameter]
  double mean_decay = 0.9;      ///< beta_1 in [0, 1): decay of the mean gradient per step
  double square_decay = 0.999;  ///< beta_2 in [0, 1): decay of the mean square per step
  double epsilon = 1e-8;        ///< > 0: gradients far below it cause no step
};

/// Stochastic gradient descent of one parameter, with steps that are scaled by the size of the
/// gradients (Kingma and Ba 2015, "Adam: A Method for Stochastic Optimization", algorithm 1). A
/// value type: copies continue from the same state.
class Adam {
 public:
  /// What to add to the parameter, given the objective's gradient there, to make the objective
  /// smaller. The first step is learning_rate long for any gradient well above epsilon; all are
  /// zero as long as all gradients were.
  double step(double gradient, const AdamRates& rates) {
    mean_ += (1 - rates.mean_decay) * (gradient - mean_);
    square_ += (1 - rates.square_decay) * (gradient * gradient - square_);
    mean_left_ *= rates.mean_decay;
    square_left_ *= rates.square_decay;
    const double mean = mean_ / (1 - mean_left_);
    const double root = std::sqrt(square_ / (1 - square_left_));
    return -rates.learning_rate * mean / (root + rates.epsilon);
  }

  void archive(Archive& archive) {
    archive(mean_, square_, mean_left_, square_left_);
    const auto is_share = [](double x) { return x >= 0 && x <= 1; };
    archive.expect(square_ >= 0 && is_share(mean_left_) && is_share(square_left_),
                   "the state of Adam");
  }

 private:
  double mean_ = 0;         ///< decaying sum of gradients
  double square_ = 0;       ///< decaying sum of squared gradients
  double mean_left_ = 1;    ///< mean_decay^steps: the weight that the zero at the start still has
  double square_left_ = 1;  ///< square_decay^steps
};

}  // namespace pharos::statistics
