#pragma once

#include <future>
#include <netinet/in.h>
#include <span>
#include <stop_token>
#include <vector>

#include <pharos/core/host_port.h>

namespace pharos {

/// A connection over which data is sent to a TCP server. No call waits longer than it is told, and
/// all end within some hundredths of a second once a stop is requested. Calls throw RunError, with
/// the reason alone ("Connection refused"), and raise no signal. Not thread-safe.
class TcpClient {
 public:
  explicit TcpClient(HostPort server) : server_(std::move(server)) {}
  ~TcpClient() { close(); }
  TcpClient(const TcpClient&) = delete;
  TcpClient& operator=(const TcpClient&) = delete;

  /// Looks the name up and tries its addresses in turn; at most `seconds` for each of these steps.
  void connect(const std::stop_token& stop, double seconds);
  /// Hands all bytes to the system; fails when it takes none for `seconds`.
  void send(std::span<const char> bytes, const std::stop_token& stop, double seconds);
  /// Whether the server has closed the connection, as far as is known. What it sent is thrown away.
  bool closed_by_server();
  void close();

 private:
  struct Address {
    sockaddr_storage storage{};
    socklen_t size = 0;
  };
  static std::vector<Address> look_up(const HostPort& server);
  std::vector<Address> addresses(const std::stop_token& stop, double seconds);
  void connect_to(const Address& address, const std::stop_token& stop, double seconds);

  HostPort server_;
  /// A name's addresses, when they are known. The system offers no way to break a lookup off, so
  /// that it runs in a thread of its own, which is left behind where it takes too long.
  std::future<std::vector<Address>> lookup_;
  int socket_ = -1;
};

}  // namespace pharos
