#include "gltf_accessor.h"

#include <algorithm>
#include <cstring>

#include <fmt/core.h>

namespace pharos {
namespace {

std::size_t components_of(std::string_view type) {
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : 3;
}

template <class T>
T value_at(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}

/// Returns the rest of `bytes` after `offset`.
std::string_view from_offset(std::string_view bytes, std::uint64_t offset, const GltfValue& view) {
  if (offset > bytes.size()) {
    view.fail(fmt::format("begins at byte {} of {}", offset, bytes.size()));
  }
  return bytes.substr(offset);
}

std::string_view view_bytes(GltfFile& file, const GltfValue& view) {
  const GltfValue buffer = file.document.referenced(view.member("buffer"), "buffers");
  const std::uint64_t size = view.member("byteLength").whole();
  const auto bytes = from_offset(file.buffers.bytes(buffer), view.whole("byteOffset", 0), view);
  if (size > bytes.size()) {
    view.fail(fmt::format("has {} bytes, and its buffer {} left", size, bytes.size()));
  }
  return bytes.substr(0, size);
}

}  // namespace

GltfAccessor::Type GltfAccessor::type_of(const GltfValue& accessor) {
  const GltfValue number = accessor.member("componentType");
  const std::uint64_t type = number.whole();
  const bool known = type >= 5120 && type <= 5126 && type != 5124;
  if (!known) number.fail(fmt::format("is {}, which is no type of components", type));
  return static_cast<Type>(type);
}

std::size_t GltfAccessor::size_of(Type type) {
  switch (type) {
    case Type::int8:
    case Type::uint8:
      return 1;
    case Type::int16:
    case Type::uint16:
      return 2;
    case Type::uint32:
    case Type::float32:
      break;
  }
  return 4;
}

GltfAccessor::GltfAccessor(GltfFile& file, const GltfValue& reference, std::string_view type) {
  const GltfValue accessor = file.document.referenced(reference, "accessors");
  if (accessor.has("sparse")) accessor.fail("is sparse, which is not read");
  const std::string found = accessor.member("type").text();
  if (found != type) {
    reference.fail(fmt::format("needs {}, and {} is {}", type, accessor.place(), found));
  }
  type_ = type_of(accessor);
  normalized_ = accessor.truth("normalized", false);
  components_ = components_of(type);
  size_ = accessor.member("count").whole();
  const GltfValue view = file.document.referenced(accessor.member("bufferView"), "bufferViews");
  bytes_ = from_offset(view_bytes(file, view), accessor.whole("byteOffset", 0), accessor);
  const std::uint64_t element = components_ * size_of(type_);
  stride_ = view.whole("byteStride", element);
  if (stride_ < element) view.fail(fmt::format("has a byteStride of {} for {}", stride_, type));
  const bool fits = size_ == 0 || (bytes_.size() >= element &&
                                   (size_ - 1) <= (bytes_.size() - element) / stride_);
  if (!fits) accessor.fail(fmt::format("has {} items, which exceed {}", size_, view.place()));
}

bool GltfAccessor::is_unsigned() const {
  return type_ == Type::uint8 || type_ == Type::uint16 || type_ == Type::uint32;
}

Vec3 GltfAccessor::vector(std::uint64_t i) const {
  const auto component = [&](std::size_t c) {
    return c < components_ ? number(at(i) + c * size_of(type_)) : 0;
  };
  return {component(0), component(1), component(2)};
}

float GltfAccessor::scaled(float integer, float largest) const {
  return normalized_ ? std::max(integer / largest, -1.0f) : integer;
}

float GltfAccessor::number(const char* at) const {
  if (type_ == Type::float32)
    return value_at<float>(at);  // first, because nearly all accessors
                                 // have this type
  switch (type_) {
    case Type::int8:
      return scaled(value_at<std::int8_t>(at), 127);
    case Type::uint8:
      return scaled(value_at<std::uint8_t>(at), 255);
    case Type::int16:
      return scaled(value_at<std::int16_t>(at), 32767);
    case Type::uint16:
      return scaled(value_at<std::uint16_t>(at), 65535);
    default:
      return scaled(static_cast<float>(value_at<std::uint32_t>(at)), 4294967295.0f);
  }
}

std::uint32_t GltfAccessor::index(std::uint64_t i) const {
  switch (type_) {
    case Type::uint8:
      return value_at<std::uint8_t>(at(i));
    case Type::uint16:
      return value_at<std::uint16_t>(at(i));
    default:
      return value_at<std::uint32_t>(at(i));
  }
}

}  // namespace pharos
