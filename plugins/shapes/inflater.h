#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

namespace pharos {

/// Unpacks one zlib stream (RFC 1950) from the front, as far as it is asked for, so that nothing
/// needs memory before its bytes are there.
class Inflater {
 public:
  /// Refers to `packed`; what follows the stream in it is passed over.
  explicit Inflater(std::string_view packed);
  ~Inflater();
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// The next `size` bytes, to `to`. False when the stream ends before; throws InputError when it
  /// is damaged.
  bool read(char* to, std::size_t size);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace pharos
