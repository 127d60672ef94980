#pragma once

#include <future>
#include <netinet/in.h>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include <pharos/core/host_port.h>

namespace pharos {

/// A connection that sends data to a TCP server. No call waits longer than its time limit. All
/// calls end within some hundredths of a second after a stop is requested. Calls throw RunError,
/// with the reason alone ("Connection refused"), and raise no signal. Not thread-safe.
class TcpClient {
 public:
  explicit TcpClient(HostPort server) : server_(std::move(server)) {}
  ~TcpClient() { close(); }
  TcpClient(const TcpClient&) = delete;
  TcpClient& operator=(const TcpClient&) = delete;

  /// Looks up the name of the server and tries its addresses in turn. Each of these steps takes at
  /// most `seconds`.
  void connect(const std::stop_token& stop, double seconds);
  /// Hands all bytes to the operating system. Fails if the system accepts no bytes for `seconds`.
  void send(std::span<const char> bytes, const std::stop_token& stop, double seconds);
  /// Returns whether the server is known to have closed the connection. Discards data that the
  /// server has sent.
  bool closed_by_server();
  void close();

 private:
  struct Address {
    sockaddr_storage storage{};
    socklen_t size = 0;
  };
  /// The result of a lookup. It holds an error message instead of an exception, because the thread
  /// sanitizer does not see the counter that keeps an exception alive in several threads.
  struct Lookup {
    std::vector<Address> addresses;
    std::string problem;  ///< empty if there is none
  };
  static Lookup look_up(const HostPort& server);
  std::vector<Address> addresses(const std::stop_token& stop, double seconds);
  void connect_to(const Address& address, const std::stop_token& stop, double seconds);

  HostPort server_;
  /// The addresses of the server once they are known. The system offers no way to cancel a lookup.
  /// The lookup therefore runs in a thread of its own, which is left behind if it takes too long.
  std::future<Lookup> lookup_;
  int socket_ = -1;
};

}  // namespace pharos
