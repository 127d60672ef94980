#pragma once

#include <string>

#include <pharos/rendering/render_job.h>

namespace pharos {

/// A line on the terminal that shows the progress of a render (iteration, bar, samples, rays per
/// second and time left) or of other work. Silent if standard error is not a terminal.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  /// Shows the progress of other work: the bar and the time left, with texts before and after the
  /// bar. A `fraction` in [0, 1] of the work is done after `seconds`.
  void show(double fraction, double seconds, const std::string& before = {},
            const std::string& after = {});
  /// Removes the line to make room for other messages, until the next show() of this render or
  /// another.
  void clear();

 private:
  bool on_terminal_;
  bool drawn_ = false;
  double last_drawn_ = -1;  ///< seconds since the render's start
};

}  // namespace pharos
