#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

#include <pharos/rendering/tev_packets.h>

namespace pharos {
namespace {

enum class PacketType : std::uint8_t { create_image = 4, update_image = 6 };

constexpr std::array<std::string_view, 3> kChannels{"R", "G", "B"};
constexpr auto kChannelCount = static_cast<std::int32_t>(kChannels.size());

/// Appends values to a packet.
class PacketWriter {
 public:
  explicit PacketWriter(PacketType type) : bytes_(sizeof(std::uint32_t)) {
    put(static_cast<std::uint8_t>(type));
  }

  /// Appends the bytes of an integer, the lowest first.
  template <class Integer>
  void put(Integer value) {
    const auto bits = static_cast<std::make_unsigned_t<Integer>>(value);
    for (std::size_t i = 0; i < sizeof(bits); ++i) {
      bytes_.push_back(static_cast<char>(bits >> (8 * i) & 0xff));
    }
  }
  void put(bool flag) { put(static_cast<std::uint8_t>(flag)); }
  void put(float value) { put(std::bit_cast<std::uint32_t>(value)); }
  void put(std::string_view text) {
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back('\0');
  }
  void reserve(std::size_t more) { bytes_.reserve(bytes_.size() + more); }

  /// Returns the packet with its length in front.
  std::vector<char> finish() && {
    const auto length = static_cast<std::uint32_t>(bytes_.size());
    for (std::size_t i = 0; i < sizeof(length); ++i) {
      bytes_[i] = static_cast<char>(length >> (8 * i) & 0xff);
    }
    return std::move(bytes_);
  }

 private:
  std::vector<char> bytes_;
};

}  // namespace

std::vector<char> tev_create_image(std::string_view name, int width, int height) {
  PacketWriter packet(PacketType::create_image);
  packet.put(true);
  packet.put(name);
  for (const std::int32_t number : {width, height, kChannelCount}) packet.put(number);
  for (const std::string_view channel : kChannels) packet.put(channel);
  return std::move(packet).finish();
}

std::vector<char> tev_update_image(std::string_view name, const Image& image, int first, int rows) {
  PacketWriter packet(PacketType::update_image);
  packet.put(false);
  packet.put(name);
  packet.put(kChannelCount);
  for (const std::string_view channel : kChannels) packet.put(channel);
  for (const std::int32_t number : {0, first, image.width(), rows}) packet.put(number);
  for (std::int64_t offset = 0; offset < kChannelCount; ++offset) packet.put(offset);
  for (std::int64_t i = 0; i < kChannelCount; ++i) packet.put(std::int64_t{kChannelCount});
  packet.reserve(static_cast<std::size_t>(rows) * image.width() * kChannelCount * sizeof(float));
  for (int y = first; y < first + rows; ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (int channel = 0; channel < kChannelCount; ++channel) {
        packet.put(image.pixel(x, y)[channel]);
      }
    }
  }
  return std::move(packet).finish();
}

}  // namespace pharos
