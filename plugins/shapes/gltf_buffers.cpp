#include "gltf_buffers.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include <fmt/core.h>

#include <pharos/core/error.h>
#include <pharos/core/uri.h>

namespace pharos {
namespace {

constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;
constexpr std::string_view kJsonChunk{"JSON", 4}, kBinaryChunk{"BIN\0", 4};

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

/// Reads the chunks of a file that begins with the letters "glTF".
GltfChunks glb_chunks(std::string_view bytes) {
  if (bytes.size() < kHeaderSize) throw InputError("it ends within its header");
  if (word_at(bytes, 4) != 2) {
    throw InputError(fmt::format("it is GLB of version {}; known is 2", word_at(bytes, 4)));
  }
  const std::uint32_t length = word_at(bytes, 8);
  if (length > bytes.size()) {
    throw InputError(fmt::format("it is cut off: {} of {} bytes", bytes.size(), length));
  }
  GltfChunks chunks{.is_glb = true};
  std::string_view left =
      bytes.substr(0, length).substr(std::min<std::size_t>(length, kHeaderSize));
  while (left.size() >= kChunkHeaderSize) {
    const std::uint32_t size = word_at(left, 0);
    const std::string_view type = left.substr(4, 4);
    left.remove_prefix(kChunkHeaderSize);
    if (size > left.size()) {
      throw InputError(fmt::format("a chunk of {} bytes is cut off after {}", size, left.size()));
    }
    if (type == kJsonChunk) chunks.json = left.substr(0, size);
    if (type == kBinaryChunk) {
      chunks.binary = left.substr(0, size);
      chunks.has_binary = true;
    }
    left.remove_prefix(size);
  }
  if (chunks.json.empty()) throw InputError("it has no JSON");
  return chunks;
}

constexpr std::uint8_t kNoDigit = 64;

/// The values of the base64 digits by character.
constexpr std::array<std::uint8_t, 256> kBase64 = [] {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::uint8_t, 256> values{};
  values.fill(kNoDigit);
  for (std::uint8_t i = 0; i < kNoDigit; ++i) values[static_cast<unsigned char>(digits[i])] = i;
  return values;
}();

std::string base64_decoded(std::string_view text, const GltfValue& uri) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    const std::uint8_t digit = kBase64[static_cast<unsigned char>(c)];
    if (digit == kNoDigit) uri.fail("holds what is no base64");
    bits = bits << 6 | digit;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  return bytes;
}

}  // namespace

GltfChunks gltf_chunks(std::string_view bytes) {
  return bytes.starts_with("glTF") ? glb_chunks(bytes) : GltfChunks{.json = bytes};
}

std::string_view GltfBuffers::bytes(const GltfValue& buffer) {
  const std::string_view all = all_bytes(buffer);
  const std::uint64_t size = buffer.member("byteLength").whole();
  if (size > all.size()) {
    buffer.fail(fmt::format("has {} bytes instead of {}", all.size(), size));
  }
  return all.substr(0, size);
}

/// Looks the buffer up by its place, because comparing URIs again is slow: they may be as long as
/// the file.
std::string_view GltfBuffers::all_bytes(const GltfValue& buffer) {
  const auto known = known_.find(buffer.place());
  if (known != known_.end()) return known->second;
  return known_.emplace(buffer.place(), find(buffer)).first->second;
}

std::string_view GltfBuffers::find(const GltfValue& buffer) {
  if (!buffer.has("uri")) {
    const bool is_chunk = chunks_.has_binary && buffer.place() == "buffers[0]";
    if (!is_chunk) buffer.fail("has no 'uri' and is no binary chunk of a GLB file");
    return chunks_.binary;
  }
  const GltfValue uri = buffer.member("uri");
  const auto known = loaded_.find(uri.text());
  if (known != loaded_.end()) return known->second;
  return loaded_.emplace(uri.text(), load(uri)).first->second;
}

std::string GltfBuffers::load(const GltfValue& uri) const {
  const std::string& text = uri.text();
  if (text.starts_with("data:")) {
    constexpr std::string_view mark = ";base64,";
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) uri.fail("is data of another kind than base64");
    return base64_decoded(std::string_view(text).substr(at + mark.size()), uri);
  }
  const std::string name = percent_decoded(text);
  try {
    return read_regular_file(folder_ / name);
  } catch (const InputError& e) {
    uri.fail(fmt::format("is '{}': {}", one_line(name, 100), e.what()));
  }
}

}  // namespace pharos
