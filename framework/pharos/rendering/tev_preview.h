#pragma once

#include <functional>
#include <memory>
#include <string>

#include <pharos/core/host_port.h>
#include <pharos/rendering/preview_pace.h>
#include <pharos/rendering/render_job.h>

namespace pharos {

/// Shows a running render in the image viewer tev:
///
///   1. Construct a TevPreview. Its thread tries to connect to the viewer, with pauses.
///   2. Call show() in RenderControl::on_pass.
///   3. Call show_last() with the finished image, then finish().
///
/// Only the thread waits for the viewer, and it sends only the newest image. A viewer that is slow,
/// stuck or absent therefore costs the render no time. All failures are only warnings.
class TevPreview {
 public:
  /// Receives descriptions of failures, in the thread that calls show() or finish(): at most one
  /// message from each per render.
  using Warn = std::function<void(const std::string&)>;

  /// Names the image `name` in the viewer. Returns at once, even if there is no viewer.
  TevPreview(const HostPort& viewer, const std::string& name, Warn warn);
  /// Discards images that are not sent yet.
  ~TevPreview();

  /// Makes and posts the image of a render between two passes, if a viewer is connected and
  /// PreviewPace says that an image is due.
  void show(const RenderSnapshot& snapshot);
  /// Posts the final image.
  void show_last(const Image& image);
  /// Waits until the last image has been sent to the viewer, at most kLastSeconds. Call it once, at
  /// the end.
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
