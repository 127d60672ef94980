#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include <pharos/core/vec.h>

#include "gltf_buffers.h"
#include "gltf_value.h"

namespace pharos {

/// A glTF file that is open for reading.
struct GltfFile {
  GltfDocument document;
  GltfBuffers buffers;
};

/// A typed view of a buffer: vectors of numbers, all of which are known to lie within the buffer.
/// Lives as long as the file.
class GltfAccessor {
 public:
  /// `reference` names the accessor by its index, `type` is what it must be ("VEC3"). Throws
  /// InputError for one that is sparse, compressed, or larger than its buffer.
  GltfAccessor(GltfFile& file, const GltfValue& reference, std::string_view type);

  std::uint64_t size() const { return size_; }
  /// Whether its numbers are unsigned integers, as indices must be.
  bool is_unsigned() const;
  /// Vector `i`, with zeros for what its type lacks; integers that are normalized in [0,1] or
  /// [-1,1].
  Vec3 vector(std::uint64_t i) const;
  /// The only number of vector `i`, of accessors that are unsigned.
  std::uint32_t index(std::uint64_t i) const;

 private:
  /// The numbers that glTF gives to the types of components.
  enum class Type { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };

  static Type type_of(const GltfValue& accessor);
  static std::size_t size_of(Type type);
  const char* at(std::uint64_t i) const { return bytes_.data() + i * stride_; }
  float number(const char* at) const;
  float scaled(float integer, float largest) const;

  Type type_;
  bool normalized_;
  std::size_t components_;
  std::uint64_t size_;
  std::uint64_t stride_ = 0;  ///< [bytes] from one vector to the next
  std::string_view bytes_;    ///< from the first vector on
};

}  // namespace pharos
