#pragma once

#include <functional>
#include <memory>
#include <string>

#include <pharos/core/host_port.h>
#include <pharos/rendering/preview_pace.h>
#include <pharos/rendering/render_job.h>

namespace pharos {

/// Shows a render in the image viewer tev while it goes on:
///
///   1. construct it: a thread looks for the viewer, now and then until it is found;
///   2. call show() in RenderControl::on_pass;
///   3. call show_last() with the finished image, then finish().
///
/// The thread sends the newest image only, and all of its waiting is its own: a viewer that is
/// slow, stuck, or not there costs the render no time. Whatever goes wrong is a warning.
class TevPreview {
 public:
  /// Told what goes wrong, by show() and finish() in their caller's thread: at most one message
  /// each a render.
  using Warn = std::function<void(const std::string&)>;

  /// Names the image `name` in the viewer. Returns at once, whether the viewer is there or not.
  TevPreview(const HostPort& viewer, const std::string& name, Warn warn);
  /// Drops what is not sent yet.
  ~TevPreview();

  /// Makes and posts the image of a render between two passes, if a viewer is there and an image is
  /// due by PreviewPace.
  void show(const RenderSnapshot& snapshot);
  /// Posts the image that the render ended with.
  void show_last(const Image& image);
  /// Waits until the viewer has been sent the last image, at most kLastSeconds. Call it once, last.
  void finish();

  static constexpr double kLastSeconds = 1;

 private:
  class Sender;

  std::string viewer_;
  Warn warn_;
  bool warned_ = false;
  PreviewPace pace_;
  std::unique_ptr<Sender> sender_;
};

}  // namespace pharos
