#include "gzip.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <string_view>
#include <zlib.h>

#include <fmt/core.h>

#include <pharos/core/error.h>

namespace pharos::pbrt {
namespace {

/// Unpacks the members of a gzip file, one after another.
class Unpacker {
 public:
  explicit Unpacker(std::string_view packed) : packed_(packed) {
    constexpr int kGzip = 16;  // added to the size of the window: zlib expects gzip's header
    if (inflateInit2(&state_, kGzip + MAX_WBITS) != Z_OK) throw std::bad_alloc();
  }
  ~Unpacker() { inflateEnd(&state_); }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  std::string run(std::size_t most) {
    std::string text;
    std::array<char, 1 << 16> chunk;
    while (true) {
      feed();
      state_.next_out = reinterpret_cast<Bytef*>(chunk.data());
      state_.avail_out = static_cast<uInt>(chunk.size());
      const int result = inflate(&state_, Z_NO_FLUSH);
      if (result == Z_MEM_ERROR) throw std::bad_alloc();
      if (result != Z_OK && result != Z_STREAM_END) {
        throw InputError(result == Z_BUF_ERROR ? "its gzip data are cut off"
                                               : "its gzip data are damaged");
      }
      text.append(chunk.data(), chunk.size() - state_.avail_out);
      if (text.size() > most) {
        throw InputError(fmt::format(
            "its gzip data hold more than {} bytes, the most that is possible here", most));
      }
      if (result != Z_STREAM_END) continue;
      if (state_.avail_in == 0 && packed_.empty()) return text;
      if (inflateReset(&state_) != Z_OK) throw std::bad_alloc();
    }
  }

 private:
  void feed() {
    if (state_.avail_in > 0 || packed_.empty()) return;
    const std::size_t size =
        std::min<std::size_t>(packed_.size(), std::numeric_limits<uInt>::max());
    state_.avail_in = static_cast<uInt>(size);
    // The zlib interface has no const, but zlib does not write to its input.
    state_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed_.data()));
    packed_.remove_prefix(size);
  }

  std::string_view packed_;  ///< input that zlib has not received yet
  z_stream state_{};
};

}  // namespace

std::string unpacked(std::string bytes, std::size_t most) {
  if (!bytes.starts_with("\x1f\x8b")) return bytes;
  return Unpacker(bytes).run(most);
}

}  // namespace pharos::pbrt
