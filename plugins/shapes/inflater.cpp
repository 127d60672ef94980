#include "inflater.h"

#include <algorithm>
#include <limits>
#include <new>
#include <zlib.h>

#include <pharos/core/error.h>

namespace pharos {
namespace {

/// Limits a size to unsigned int, the type of zlib's counts. Files may be larger.
uInt piece(std::size_t size) {
  return static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max()));
}

}  // namespace

struct Inflater::Stream {
  std::string_view packed;  ///< input that zlib has not received yet
  z_stream state{};
};

Inflater::Inflater(std::string_view packed)
    : stream_(std::make_unique<Stream>(Stream{.packed = packed})) {
  // Only a lack of memory can make this call fail.
  if (inflateInit(&stream_->state) != Z_OK) throw std::bad_alloc();
}

Inflater::~Inflater() {
  inflateEnd(&stream_->state);
}

bool Inflater::read(char* to, std::size_t size) {
  z_stream& state = stream_->state;
  std::string_view& packed = stream_->packed;
  while (size > 0) {
    if (state.avail_in == 0) {
      state.avail_in = piece(packed.size());
      // The zlib interface has no const, but zlib does not write to its input.
      state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
      packed.remove_prefix(state.avail_in);
    }
    const uInt wanted = piece(size);
    state.next_out = reinterpret_cast<Bytef*>(to);
    state.avail_out = wanted;
    const int result = inflate(&state, Z_NO_FLUSH);
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result == Z_DATA_ERROR || result == Z_NEED_DICT) {
      throw InputError("its compressed data are damaged");
    }
    const uInt made = wanted - state.avail_out;
    to += made;
    size -= made;
    if (size > 0 && (result == Z_STREAM_END || result == Z_BUF_ERROR)) return false;
  }
  return true;
}

}  // namespace pharos
