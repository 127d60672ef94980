#pragma once

namespace pharos {

/// Decides when a watched render makes its next preview image: at most five times a second, and
/// only if making images then takes at most 3 % of the time rendered so far. The first image is
/// made at once, because its cost is not known yet.
class PreviewPace {
 public:
  /// Whether an image is due after `seconds` of rendering.
  bool due(double seconds) const {
    if (!any_) return true;
    return seconds - last_ >= kLeastInterval && spent_ + cost_ <= kMostShare * seconds;
  }
  /// Records that an image was made at `seconds` and took `cost` seconds.
  void made(double seconds, double cost) {
    any_ = true;
    last_ = seconds;
    cost_ = cost;
    spent_ += cost;
  }

 private:
  static constexpr double kLeastInterval = 0.2, kMostShare = 0.03;
  bool any_ = false;
  double last_ = 0, cost_ = 0, spent_ = 0;  ///< all in seconds
};

}  // namespace pharos
