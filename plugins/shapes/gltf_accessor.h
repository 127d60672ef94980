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

/// A typed view of a buffer: vectors of numbers, checked to lie within the buffer. The file must
/// outlive it.
class GltfAccessor {
 public:
  /// `reference` names the accessor by its index; `type` is the required type ("VEC3"). Throws
  /// InputError if the accessor is sparse, compressed, or larger than its buffer.
  GltfAccessor(GltfFile& file, const GltfValue& reference, std::string_view type);

  std::uint64_t size() const { return size_; }
  /// Returns whether the numbers are unsigned integers, as indices must be.
  bool is_unsigned() const;
  /// Returns vector `i`. Components that its type lacks are zero. Normalized integers are mapped to
  /// [0,1] or [-1,1].
  Vec3 vector(std::uint64_t i) const;
  /// Returns the only number of vector `i` of an unsigned accessor.
  std::uint32_t index(std::uint64_t i) const;

 private:
  /// The numbers of the component types in glTF.
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
