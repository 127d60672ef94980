#pragma once

#include <string>

#include <pharos/rendering/render_job.h>

namespace pharos {

/// A line on the terminal that follows a render (iteration, bar, samples, rays a second and time
/// left) or other work. Silent where standard error is no terminal.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  /// The same for other work, of which `fraction` in [0, 1] is done after `seconds`: bar and time
  /// left, with texts before and after the bar.
  void show(double fraction, double seconds, const std::string& before = {},
            const std::string& after = {});
  /// Takes the line away, for other messages, until the next show(), of this render or another.
  void clear();

 private:
  bool on_terminal_;
  bool drawn_ = false;
  double last_drawn_ = -1;  ///< seconds since the render's start
};

}  // namespace pharos
