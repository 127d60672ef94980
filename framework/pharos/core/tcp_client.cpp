#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include <pharos/core/error.h>
#include <pharos/core/tcp_client.h>

namespace pharos {
namespace {

using Clock = std::chrono::steady_clock;

/// The interval at which a waiting call checks whether it must stop.
constexpr std::chrono::milliseconds kSlice{20};

[[noreturn]] void fail(int error) {
  throw RunError(std::system_category().message(error));
}

/// Calls `ready(slice)` until it returns true. Throws RunError after `seconds` or if a stop is
/// requested.
template <class Ready>
void wait(const std::stop_token& stop, double seconds, Ready&& ready) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (!ready(kSlice)) {
    if (stop.stop_requested() || Clock::now() >= end) throw RunError("no answer in time");
  }
}

void wait_writable(int socket, const std::stop_token& stop, double seconds) {
  pollfd state{.fd = socket, .events = POLLOUT, .revents = 0};
  wait(stop, seconds, [&](std::chrono::milliseconds slice) {
    const int count = poll(&state, 1, static_cast<int>(slice.count()));
    if (count < 0 && errno != EINTR) fail(errno);
    return count > 0;
  });
}

}  // namespace

TcpClient::Lookup TcpClient::look_up(const HostPort& server) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int error =
      getaddrinfo(server.host.c_str(), std::to_string(server.port).c_str(), &hints, &list);
  if (error == EAI_SYSTEM) {
    return {.addresses = {}, .problem = std::system_category().message(errno)};
  }
  if (error != 0) return {.addresses = {}, .problem = gai_strerror(error)};
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(list, freeaddrinfo);
  Lookup found;
  for (const addrinfo* entry = list; entry != nullptr; entry = entry->ai_next) {
    Address& address = found.addresses.emplace_back();
    std::memcpy(&address.storage, entry->ai_addr, entry->ai_addrlen);
    address.size = entry->ai_addrlen;
  }
  return found;
}

std::vector<TcpClient::Address> TcpClient::addresses(const std::stop_token& stop, double seconds) {
  // A lookup that took too long for an earlier call may have finished by now.
  if (!lookup_.valid()) {
    std::packaged_task<Lookup()> task([server = server_] { return look_up(server); });
    lookup_ = task.get_future();
    std::thread(std::move(task)).detach();
  }
  wait(stop, seconds, [&](std::chrono::milliseconds slice) {
    return lookup_.wait_for(slice) == std::future_status::ready;
  });
  Lookup found = lookup_.get();
  if (!found.problem.empty()) throw RunError(found.problem);
  return std::move(found.addresses);
}

void TcpClient::connect(const std::stop_token& stop, double seconds) {
  close();
  std::string reason = "no address";
  for (const Address& address : addresses(stop, seconds)) {
    try {
      return connect_to(address, stop, seconds);
    } catch (const RunError& error) {
      reason = error.what();
    }
  }
  throw RunError(reason);
}

void TcpClient::connect_to(const Address& address, const std::stop_token& stop, double seconds) {
  close();
  socket_ = socket(address.storage.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) fail(errno);
  const auto* target = reinterpret_cast<const sockaddr*>(&address.storage);
  if (::connect(socket_, target, address.size) == 0) return;
  if (errno != EINPROGRESS && errno != EINTR) fail(errno);
  wait_writable(socket_, stop, seconds);
  int error = 0;
  socklen_t size = sizeof(error);
  if (getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size) != 0) fail(errno);
  if (error != 0) fail(error);
}

void TcpClient::send(std::span<const char> bytes, const std::stop_token& stop, double seconds) {
  while (!bytes.empty()) {
    if (stop.stop_requested()) throw RunError("no answer in time");
    const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      wait_writable(socket_, stop, seconds);
    } else if (errno != EINTR) {
      fail(errno);
    }
  }
}

bool TcpClient::closed_by_server() {
  char unread[4096];
  const ssize_t count = recv(socket_, unread, sizeof(unread), 0);
  return count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
}

void TcpClient::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

}  // namespace pharos
