#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/tcp_client.h>
#include <pharos/rendering/tev_packets.h>
#include <pharos/rendering/tev_preview.h>

namespace pharos {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// The time limits for connecting to the viewer and for sending more data when its buffers are
/// full.
constexpr double kConnectSeconds = 5, kStallSeconds = 5;
/// The pause after a failure. It doubles with each failure, up to the longest, until an image
/// arrives.
constexpr Seconds kFirstPause{0.25}, kLongestPause{8};
/// The bytes of values in one packet. Older versions of tev accept no packet above 1 MiB.
constexpr std::size_t kPacketValueBytes = 1u << 19;

/// Returns the number of whole rows in a packet, at least one even if the row is too wide.
int rows_per_packet(const Image& image) {
  const std::size_t row = static_cast<std::size_t>(image.width()) * 3 * sizeof(float);
  return static_cast<int>(std::max<std::size_t>(kPacketValueBytes / row, 1));
}

}  // namespace

/// The thread that sends images to the viewer, and the mailbox that feeds it.
class TevPreview::Sender {
 public:
  Sender(const HostPort& viewer, std::string name)
      : name_(std::move(name)),
        client_(viewer),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  bool connected() const {
    const std::lock_guard lock(mutex_);
    return connected_;
  }

  /// The last failure; "" if there was none.
  std::string problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
  }

  void post(Image image) {
    const std::lock_guard lock(mutex_);
    newest_ = std::move(image);
    changed_.notify_all();
  }

  /// Waits until the thread has sent all posted images and ends it. Returns false if some were not
  /// sent.
  bool finish(Seconds most) {
    {
      std::unique_lock lock(mutex_);
      closing_ = true;
      changed_.notify_all();
      changed_.wait_for(lock, most, [this] { return ended_; });
    }
    thread_.request_stop();
    thread_.join();
    return delivered_;
  }

 private:
  void run(const std::stop_token& stop) {
    bool delivered = false, last_attempt = false;
    while (!delivered && !last_attempt && !stop.stop_requested()) {
      last_attempt = closing();
      delivered = serve_connection(stop);
      if (!delivered && !last_attempt) pause(stop);
    }
    client_.close();
    const std::lock_guard lock(mutex_);
    delivered_ = delivered;
    ended_ = true;
    changed_.notify_all();
  }

  bool closing() const {
    const std::lock_guard lock(mutex_);
    return closing_;
  }

  /// Connects and sends images. Returns true if no more images will come, false on a failure.
  bool serve_connection(const std::stop_token& stop) {
    try {
      client_.connect(stop, kConnectSeconds);
      set_connected();
      bool created = false;
      while (take_newest(stop)) {
        send(*sending_, created, stop);
        created = true;
        sending_.reset();
        pause_ = kFirstPause;
      }
      return !stop.stop_requested();
    } catch (const std::exception& error) {
      client_.close();
      note_failure(error.what());
      return false;
    }
  }

  void send(const Image& image, bool created, const std::stop_token& stop) {
    if (client_.closed_by_server()) throw RunError("it closed the connection");
    if (!created) {
      client_.send(tev_create_image(name_, image.width(), image.height()), stop, kStallSeconds);
    }
    const int step = rows_per_packet(image);
    for (int y = 0; y < image.height(); y += step) {
      const int rows = std::min(step, image.height() - y);
      client_.send(tev_update_image(name_, image, y, rows), stop, kStallSeconds);
    }
  }

  void set_connected() {
    const std::lock_guard lock(mutex_);
    connected_ = true;
  }

  /// Waits for an image. Returns false if no more images will come.
  bool take_newest(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, stop, [this] { return newest_ || closing_; });
    sending_ = std::exchange(newest_, std::nullopt);
    return sending_.has_value();
  }

  /// Records a failure. The image that was not sent is sent again, unless there is a newer one.
  void note_failure(const std::string& why) {
    const std::lock_guard lock(mutex_);
    connected_ = false;
    problem_ = why;
    if (!newest_) newest_ = std::move(sending_);
    sending_.reset();
  }

  void pause(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, stop, pause_, [this] { return closing_; });
    pause_ = std::min(2 * pause_, kLongestPause);
  }

  const std::string name_;

  // Used by the thread only.
  TcpClient client_;
  std::optional<Image> sending_;
  Seconds pause_ = kFirstPause;

  mutable std::mutex mutex_;  ///< guards the members below
  std::condition_variable_any changed_;
  std::optional<Image> newest_;
  std::string problem_;
  bool connected_ = false;
  bool closing_ = false;    ///< no more images will be posted
  bool ended_ = false;      ///< the thread is about to end
  bool delivered_ = false;  ///< all posted images have been sent

  std::jthread thread_;  ///< must be last: the thread uses the members above
};

TevPreview::TevPreview(const HostPort& viewer, const std::string& name, Warn warn)
    : viewer_(viewer.to_string()),
      warn_(std::move(warn)),
      sender_(std::make_unique<Sender>(viewer, name)) {}

TevPreview::~TevPreview() = default;

void TevPreview::show(const RenderSnapshot& snapshot) {
  const std::string problem = sender_->problem();
  if (!problem.empty() && !std::exchange(warned_, true)) {
    warn_(fmt::format("no preview for now: image viewer at {}: {}", viewer_, problem));
  }
  const double seconds = snapshot.progress.seconds;
  // show_last() shows the image after the last pass.
  if (snapshot.progress.fraction >= 1 || !sender_->connected() || !pace_.due(seconds)) return;
  const auto start = Clock::now();
  sender_->post(select_layers(snapshot.image(), {}));
  pace_.made(seconds, Seconds(Clock::now() - start).count());
}

void TevPreview::show_last(const Image& image) {
  sender_->post(select_layers(image, {}));
}

void TevPreview::finish() {
  if (sender_->finish(Seconds(kLastSeconds))) return;
  warn_(fmt::format("no preview of the last image: image viewer at {}: {}", viewer_,
                    sender_->problem()));
}

}  // namespace pharos
