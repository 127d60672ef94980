#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <pharos/core/image.h>

namespace pharos::testing {

/// The behavior of a TevListener towards its clients.
enum class Manner {
  reads,             ///< reads everything
  never_reads,       ///< accepts connections but reads nothing
  hangs_up_at_first  ///< closes the first connection during the first image, then reads
};

/// A stand-in for the image viewer tev on 127.0.0.1. It accepts one connection after the other and
/// stores the bytes that it receives.
class TevListener {
 public:
  /// Listens on `port`; 0 chooses any free port.
  explicit TevListener(Manner manner, std::uint16_t port = 0);
  ~TevListener();
  TevListener(const TevListener&) = delete;
  TevListener& operator=(const TevListener&) = delete;

  std::uint16_t port() const { return port_; }
  /// Returns the number of connections accepted so far.
  int connections() const;
  /// Returns the number of bytes received so far, over all connections.
  std::size_t byte_count() const;
  /// Returns all bytes of a connection, counted from 0, after the client has closed it. Returns ""
  /// if this does not happen within `seconds`.
  std::string received(std::size_t connection, double seconds = 10);

 private:
  void run(const std::stop_token& stop);
  void serve(int client, const std::stop_token& stop);

  Manner manner_;
  std::uint16_t port_ = 0;
  int socket_ = -1;
  mutable std::mutex mutex_;  ///< guards the following members
  std::condition_variable changed_;
  std::vector<std::string> received_;
  std::size_t ended_ = 0;  ///< closed connections
  std::jthread thread_;
};

/// The image that a viewer shows after a stream of packets. The code that reads the packets shares
/// nothing with the sender.
struct ShownImage {
  std::string name;
  bool focus = false;
  std::vector<std::string> channels;
  int width = 0, height = 0;
  std::vector<float> values;  ///< row by row, channels interleaved
  int updates = 0;            ///< packets
  std::size_t largest_packet = 0;
};

/// Executes the packets of one connection. Throws std::runtime_error if they are incomplete or
/// invalid: unknown types, updates of images that were not created or of pixels outside of them, or
/// remaining bytes.
ShownImage show_packets(const std::string& bytes);

/// Returns a port that was free a moment ago and on which no program listens.
std::uint16_t silent_port();

}  // namespace pharos::testing
