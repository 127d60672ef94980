#include "tev_listener.h"

#include <arpa/inet.h>
#include <chrono>
#include <cstring>
#include <poll.h>
#include <stdexcept>
#include <sys/socket.h>
#include <unistd.h>

namespace pharos::testing {
namespace {

constexpr int kSliceMs = 10;
constexpr std::size_t kHangUpBytes = 1000;

bool readable(int socket) {
  pollfd state{.fd = socket, .events = POLLIN, .revents = 0};
  return poll(&state, 1, kSliceMs) > 0;
}

/// Reads the contents of a packet one after another.
class PacketReader {
 public:
  explicit PacketReader(std::string bytes) : bytes_(std::move(bytes)) {}

  template <class T>
  T number() {
    if (left() < sizeof(T)) throw std::runtime_error("packet ends within a number");
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));  // the tests run on little-endian machines
    at_ += sizeof(T);
    return value;
  }
  std::string text() {
    const std::size_t end = bytes_.find('\0', at_);
    if (end == std::string::npos) throw std::runtime_error("packet ends within a text");
    std::string value = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return value;
  }
  std::vector<std::string> texts() {
    std::vector<std::string> all(number<std::uint32_t>());
    for (std::string& one : all) one = text();
    return all;
  }
  template <class T>
  std::vector<T> numbers(std::size_t count) {
    std::vector<T> all(count);
    for (T& one : all) one = number<T>();
    return all;
  }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

void require(bool condition, const char* what) {
  if (!condition) throw std::runtime_error(what);
}

ShownImage create(PacketReader& packet) {
  ShownImage shown;
  shown.focus = packet.number<std::uint8_t>() == 1;
  shown.name = packet.text();
  shown.width = packet.number<std::int32_t>();
  shown.height = packet.number<std::int32_t>();
  shown.channels = packet.texts();
  shown.values.resize(static_cast<std::size_t>(shown.width) * shown.height * shown.channels.size());
  return shown;
}

void update(ShownImage& shown, PacketReader& packet) {
  require(packet.number<std::uint8_t>() == 0, "an update takes the focus");
  require(packet.text() == shown.name, "an update of another image");
  require(packet.texts() == shown.channels, "an update of other channels");
  const auto place = packet.numbers<std::int32_t>(4);  // x, y, width, height
  require(place[0] >= 0 && place[0] + place[2] <= shown.width, "an update beside the image");
  require(place[1] >= 0 && place[1] + place[3] <= shown.height, "an update beside the image");
  const std::size_t channels = shown.channels.size();
  const auto offsets = packet.numbers<std::int64_t>(channels);
  const auto strides = packet.numbers<std::int64_t>(channels);
  const auto values = packet.numbers<float>(packet.left() / sizeof(float));
  const auto pixels = static_cast<std::size_t>(place[2]) * place[3];
  require(values.size() == pixels * channels, "too many values or too few");
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t x = place[0] + i % place[2], y = place[1] + i / place[2];
    for (std::size_t c = 0; c < channels; ++c) {
      shown.values[(y * shown.width + x) * channels + c] = values.at(offsets[c] + i * strides[c]);
    }
  }
  ++shown.updates;
}

}  // namespace

TevListener::TevListener(Manner manner, std::uint16_t port)
    : manner_(manner), socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const int yes = 1, small = 4096;
  setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  if (manner == Manner::never_reads) {
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &small, sizeof(small));
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (bind(socket_, generic, size) != 0 || listen(socket_, 5) != 0 ||
      getsockname(socket_, generic, &size) != 0) {
    close(socket_);
    throw std::runtime_error("cannot listen on 127.0.0.1");
  }
  port_ = ntohs(address.sin_port);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

TevListener::~TevListener() {
  thread_.request_stop();
  thread_.join();
  close(socket_);
}

int TevListener::connections() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(received_.size());
}

std::size_t TevListener::byte_count() const {
  const std::lock_guard lock(mutex_);
  std::size_t count = 0;
  for (const std::string& bytes : received_) count += bytes.size();
  return count;
}

std::string TevListener::received(std::size_t connection, double seconds) {
  std::unique_lock lock(mutex_);
  const bool ended = changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                                       [&] { return ended_ > connection; });
  return ended ? received_[connection] : "";
}

void TevListener::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (!readable(socket_)) continue;
    const int client = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (client < 0) continue;
    {
      const std::lock_guard lock(mutex_);
      received_.emplace_back();
    }
    serve(client, stop);
    close(client);
    const std::lock_guard lock(mutex_);
    ++ended_;
    changed_.notify_all();
  }
}

void TevListener::serve(int client, const std::stop_token& stop) {
  std::vector<char> buffer(1 << 16);
  while (!stop.stop_requested()) {
    if (manner_ == Manner::never_reads) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kSliceMs));
      continue;
    }
    if (!readable(client)) continue;
    const ssize_t count = recv(client, buffer.data(), buffer.size(), 0);
    if (count <= 0) return;
    const std::lock_guard lock(mutex_);
    received_.back().append(buffer.data(), static_cast<std::size_t>(count));
    const bool hang_up = manner_ == Manner::hangs_up_at_first && received_.size() == 1;
    if (hang_up && received_.back().size() > kHangUpBytes) return;
  }
}

ShownImage show_packets(const std::string& bytes) {
  ShownImage shown;
  std::size_t at = 0, largest = 0;
  while (at < bytes.size()) {
    require(bytes.size() - at > 5, "a packet is not whole");
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + at, sizeof(length));
    require(length > 5 && length <= bytes.size() - at, "a packet is not whole");
    PacketReader packet(bytes.substr(at + 4, length - 4));
    const auto type = packet.number<std::uint8_t>();
    require(type == 4 || type == 6, "a packet of unknown type");
    if (type == 4) shown = create(packet);
    if (type == 6) update(shown, packet);
    require(packet.left() == 0, "a packet holds more than it should");
    largest = std::max<std::size_t>(largest, length);
    at += length;
  }
  shown.largest_packet = largest;
  return shown;
}

std::uint16_t silent_port() {
  return TevListener(Manner::reads).port();
}

}  // namespace pharos::testing
