#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "gltf_value.h"
#include "mesh_source.h"

namespace pharos {

/// The two halves of a glTF file: JSON, and the binary chunk of a GLB file.
struct GltfChunks {
  std::string_view json, binary;
  bool is_glb = false, has_binary = false;
};

/// Takes a file apart; one that does not begin as GLB does is all JSON. Throws InputError when a
/// GLB file is cut off or of another version.
GltfChunks gltf_chunks(std::string_view bytes);

/// The bytes that a file's buffers stand for: the binary chunk, base64 within the JSON, or further
/// files, which are read when they are first asked for.
class GltfBuffers {
 public:
  /// `chunks` and all values asked for live as long as this object; names of files are relative to
  /// `folder`.
  GltfBuffers(const GltfChunks& chunks, std::filesystem::path folder)
      : chunks_(chunks), folder_(std::move(folder)) {}

  /// Of an item of the root's list `buffers`. Throws InputError when they are not to be had, or
  /// fewer than the item says.
  std::string_view bytes(const GltfValue& buffer);

 private:
  std::string_view all_bytes(const GltfValue& buffer);
  std::string_view find(const GltfValue& buffer);
  std::string load(const GltfValue& uri) const;

  GltfChunks chunks_;
  std::filesystem::path folder_;
  std::map<std::string, std::string_view> known_;   ///< by place of the buffer
  std::map<std::string_view, std::string> loaded_;  ///< by URI, which several buffers may share
};

}  // namespace pharos
