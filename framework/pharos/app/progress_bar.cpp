#include "progress_bar.h"

#include <cstdio>
#include <string>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace pharos {
namespace {

constexpr int kBarWidth = 30;
constexpr double kRedrawSeconds = 0.1;

std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  if (whole >= 3600) {
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

ProgressBar::ProgressBar() : on_terminal_(isatty(fileno(stderr)) != 0) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::clear() {
  if (std::exchange(drawn_, false)) fmt::print(stderr, "\r\x1b[K");
  last_drawn_ = -1;
}

void ProgressBar::show(const Progress& p) {
  const std::string iteration =
      p.iteration_count > 1 ? fmt::format("{} {}/{}  ", p.training ? "training" : "rendering",
                                          p.iteration + 1, p.iteration_count)
                            : "";
  show(p.fraction, p.seconds, iteration,
       fmt::format("  {:.1f} spp  {:.2f} Mrays/s", p.samples_per_pixel,
                   static_cast<double>(p.rays) / p.seconds * 1e-6));
}

void ProgressBar::show(double fraction, double seconds, const std::string& before,
                       const std::string& after) {
  if (!on_terminal_ || seconds - last_drawn_ < kRedrawSeconds) return;
  last_drawn_ = seconds;
  drawn_ = true;
  const int filled = static_cast<int>(fraction * kBarWidth);
  const double left = fraction > 0 ? seconds * (1 / fraction - 1) : 0;
  fmt::print(stderr, "\r\x1b[K{}[{:=<{}}{: <{}}] {:3.0f}%{}  {} left", before, "", filled, "",
             kBarWidth - filled, 100 * fraction, after, clock_text(left));
  std::fflush(stderr);
}

}  // namespace pharos
