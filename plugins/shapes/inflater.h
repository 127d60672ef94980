#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

namespace pharos {

/// Unpacks one zlib stream (RFC 1950) from the front, only as far as requested. No memory is
/// therefore needed for data before its bytes are present.
class Inflater {
 public:
  /// Refers to `packed`. Bytes after the end of the stream are ignored.
  explicit Inflater(std::string_view packed);
  ~Inflater();
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Reads the next `size` bytes into `to`. Returns false if the stream ends before. Throws
  /// InputError if it is damaged.
  bool read(char* to, std::size_t size);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace pharos
