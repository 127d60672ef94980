#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <pharos/guiding/pipeline/guide_trial.h>

namespace pharos {
namespace {

/// Expected fall of the noise in an iteration, over the fall in the iteration before [1].
constexpr double kDecline = 0.5;

}  // namespace

GuideTrial::GuideTrial(const TrainingSettings& settings, PixelRect window)
    : settings_(settings), noise_(window) {}

void GuideTrial::absorb(const PathLog& log, bool is_guided) {
  if (is_guided) gain_.absorb(log);
  noise_.absorb(log);
}

bool GuideTrial::end_iteration(const IterationCost& cost, bool is_guided) {
  spent_before_ = std::exchange(spent_, cost.spent);
  std::vector<HeldOutGain::Part> parts(gain_.parts().begin(), gain_.parts().end());
  has_measured_ = is_guided && gain_.end_iteration();
  // Few paths with light say nothing about guides, and iterations without guides do not either.
  noise_.end_iteration(has_measured_);
  const double work = cost.samples * cost.steps;
  if (!is_guided) {
    unguided_work_ += work;
    unguided_seconds_ += cost.seconds;
  } else if (work > 0) {
    guided_seconds_ = cost.seconds / work;
  }
  if (!has_measured_) return false;
  ++measurements_;
  parts_before_ = std::move(parts);
  if (is_on_trial()) return false;
  if (!is_useless()) return settings_.tolerance > 0 && !may_pay();
  return settings_.most_noise > 0 ? !may_pay() : !gain_.may_reach(settings_.least_gain);
}

bool GuideTrial::is_on_trial() const {
  return spent_ + 0.5 * next_share() < settings_.trial;
}

double GuideTrial::path_cost() const {
  constexpr double kUsual = 1.5;  // 1.0 to 2.9 were measured
  const bool is_measured = guided_seconds_ > 0 && unguided_seconds_ > 0;
  return is_measured ? guided_seconds_ * unguided_work_ / unguided_seconds_ : kUsual;
}

std::optional<double> GuideTrial::noise_in_time() const {
  if (!noise_.value()) return std::nullopt;
  const double fall = kDecline * (noise_.fall() ? *noise_.fall() : gain_.rise());
  constexpr double kLeast = 1e-6;  // rounding may leave a ratio of zero
  return std::max(*noise_.value() * std::exp(-std::max(fall, 0.0)), kLeast) * path_cost();
}

bool GuideTrial::lowers_noise() const {
  const std::optional<double> noise = noise_in_time();
  return noise && *noise <= settings_.most_noise;
}

bool GuideTrial::surely_lowers_noise() const {
  // One ratio is not enough, because it may be far too low by chance. The expected ratio is not
  // enough either, because it may have fallen by chance.
  if (!noise_.fall() || !lowers_noise()) return false;
  const double highest = *noise_.value() * (1 + noise_.relative_error());
  return highest * path_cost() <= settings_.most_noise;
}

bool GuideTrial::is_useless() const {
  return settings_.least_gain > 0 && gain_.is_below(settings_.least_gain) && !lowers_noise();
}

bool GuideTrial::may_be_useless() const {
  return settings_.least_gain > 0 && gain_.may_be_below(settings_.least_gain) &&
         !surely_lowers_noise();
}

double GuideTrial::worthwhile_share() const {
  if (!may_be_useless()) return 1;
  const double short_share = std::max(settings_.trial - spent_, 0.5 * settings_.trial);
  if (gain_.is_known()) return short_share;
  const bool is_first = spent_before_ == 0;
  return std::max(short_share, (is_first ? 1 : 2) * (spent_ - spent_before_));
}

double GuideTrial::next_share() const {
  const double last = spent_ - spent_before_, left = std::max(settings_.share - spent_, 0.0);
  if (settings_.schedule == ScheduleKind::uniform) return std::min(last, left);
  // The last iteration takes all that is left if twice as much would not fit after it; see
  // Schedule.
  const double next = 2 * last + 4 * last <= left ? 2 * last : left;
  return std::min(next, worthwhile_share());
}

double GuideTrial::possible_fall() const {
  const bool is_first = measurements_ < 2;
  if (!is_useless()) {
    if (is_first) return std::numeric_limits<double>::infinity();
    return kDecline * std::max(gain_.rise(), noise_.fall().value_or(0));
  }
  constexpr double kFirst = 0.5;  // -0.1 to 2.7 were measured where guides suffice in the end
  if (is_first) return std::max(kFirst, promised_fall());
  const double rise = gain_.may_reach(settings_.least_gain) ? gain_.possible_rise() : 0;
  return std::max({rise, noise_.possible_fall().value_or(0), promised_fall()});
}

double GuideTrial::promised_fall() const {
  constexpr double kMost = 0.999;  // of the light; unguided images may hide all of it
  const double hidden = std::min(noise_.hidden_light(), kMost);
  return -std::log1p(-hidden) * std::pow(kDecline, measurements_ - 1.0);
}

bool GuideTrial::may_pay() const {
  const double fall = possible_fall();
  if (!(fall >= settings_.tolerance)) return false;
  const double now = noise_in_time().value_or(path_cost());
  const bool may_be_off = is_useless();
  const auto worth = [&](double noise) {
    return may_be_off && noise > settings_.most_noise ? 1 : 1 / noise;
  };
  // Samples that training contributes, relative to the final image in the same time [1].
  const double kept = settings_.images == TrainingImages::discard ? 0 : 0.5;
  const double left = 1 - spent_, next = next_share();
  return kept * next / now + (left - next) * worth(now * std::exp(-fall)) >= left * worth(now);
}

std::optional<std::size_t> GuideTrial::dispensable_method() const {
  const bool may_leave_out = settings_.least_part > 0 && !is_on_trial();
  if (!may_leave_out || !has_measured_ || is_useless()) return std::nullopt;
  const std::span<const HeldOutGain::Part> parts = gain_.parts();
  const auto took_part = std::count_if(parts.begin(), parts.end(),
                                       [](const HeldOutGain::Part& part) { return part.is_known; });
  if (took_part < 2) return std::nullopt;
  const auto is_small = [&](const HeldOutGain::Part& part) {
    return part.is_known && part.nats < settings_.least_part;
  };
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < std::min(parts.size(), parts_before_.size()); ++i) {
    if (!is_small(parts[i]) || !is_small(parts_before_[i])) continue;
    if (!least || parts[i].nats < parts[*least].nats) least = i;
  }
  return least;
}

std::optional<GuideGain> GuideTrial::gain() const {
  if (!gain_.is_known()) return std::nullopt;
  return GuideGain{.nats = gain_.value(), .noise_ratio = noise_.value(), .path_cost = path_cost()};
}

}  // namespace pharos
