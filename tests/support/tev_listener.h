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

/// How a TevListener treats its clients.
enum class Manner {
  reads,             ///< everything
  never_reads,       ///< accepts connections and lets them be
  hangs_up_at_first  ///< closes the first connection within the first image, then reads
};

/// A stand-in for the image viewer tev on 127.0.0.1: takes one connection after the other and keeps
/// what it is sent.
class TevListener {
 public:
  /// Port 0: any that is free.
  explicit TevListener(Manner manner, std::uint16_t port = 0);
  ~TevListener();
  TevListener(const TevListener&) = delete;
  TevListener& operator=(const TevListener&) = delete;

  std::uint16_t port() const { return port_; }
  /// Connections taken so far.
  int connections() const;
  /// Bytes received so far, over all connections.
  std::size_t byte_count() const;
  /// All bytes of a connection, counted from 0, once the client has closed it; "" when that does
  /// not happen within `seconds`.
  std::string received(std::size_t connection, double seconds = 10);

 private:
  void run(const std::stop_token& stop);
  void serve(int client, const std::stop_token& stop);

  Manner manner_;
  std::uint16_t port_ = 0;
  int socket_ = -1;
  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  std::vector<std::string> received_;
  std::size_t ended_ = 0;  ///< connections
  std::jthread thread_;
};

/// What a viewer shows after a stream of packets, read by code that shares nothing with the sender.
struct ShownImage {
  std::string name;
  bool focus = false;
  std::vector<std::string> channels;
  int width = 0, height = 0;
  std::vector<float> values;  ///< row by row, channels interleaved
  int updates = 0;            ///< packets
  std::size_t largest_packet = 0;
};

/// Plays the packets of one connection. Throws std::runtime_error when they are not whole and
/// sound: unknown types, updates of what was not created or beside it, values left over.
ShownImage show_packets(const std::string& bytes);

/// A port that was free a moment ago, where nobody listens.
std::uint16_t silent_port();

}  // namespace pharos::testing
