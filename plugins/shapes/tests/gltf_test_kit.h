#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <doctest/doctest.h>

/// The parts of glTF files.
namespace pharos::test {

/// Returns the bytes of numbers, one after the other.
template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  std::string bytes(sizeof(T) * numbers.size(), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

inline std::string data_uri(const std::string& bytes) {
  const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = "data:application/octet-stream;base64,";
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = i; k < i + 3; ++k) {
      group = group << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

inline std::string little_endian(std::size_t v) {
  return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(v)});
}

/// Returns a GLB file.
inline std::string glb(std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string chunks = little_endian(json.size()) + "JSON" + json +
                             little_endian(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + little_endian(2) + little_endian(12 + chunks.size()) + chunks;
}

/// A right triangle with normals and texture coordinates. Its buffer is the binary chunk of a GLB
/// file.
inline const std::string kGltfTriangle = R"({"asset": {"version": "2.0"}, "scene": 0,
  "scenes": [{"nodes": [0]}],
  "nodes": [{"name": "leaf", "mesh": 0}],
  "meshes": [{"name": "blade", "primitives": [{"mode": 4, "indices": 3,
    "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}}]}],
  "accessors": [
    {"bufferView": 0, "type": "VEC3", "componentType": 5126, "count": 3},
    {"bufferView": 1, "type": "VEC3", "componentType": 5126, "count": 3, "byteOffset": 0},
    {"bufferView": 2, "type": "VEC2", "componentType": 5126, "count": 3},
    {"bufferView": 3, "type": "SCALAR", "componentType": 5123, "count": 3}],
  "bufferViews": [
    {"buffer": 0, "byteOffset": 0, "byteLength": 36, "byteStride": 12},
    {"buffer": 0, "byteOffset": 36, "byteLength": 36},
    {"buffer": 0, "byteOffset": 72, "byteLength": 24},
    {"buffer": 0, "byteOffset": 96, "byteLength": 6}],
  "buffers": [{"byteLength": 104}]})";

inline std::string triangle_bytes(float x = 1, std::uint16_t third_index = 2) {
  return bytes_of<float>({0, 0, 0, x, 0, 0, 0, 1, 0}) +
         bytes_of<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}) + bytes_of<float>({0, 1, 1, 1, 0, 0}) +
         bytes_of<std::uint16_t>({0, 1, third_index, 0});
}

/// Returns `text` with the first `what` replaced.
inline std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

}  // namespace pharos::test
