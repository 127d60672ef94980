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

/// Splits a file into its chunks. A file that does not begin like a GLB file is all JSON. Throws
/// InputError if a GLB file is truncated or has another version.
GltfChunks gltf_chunks(std::string_view bytes);

/// Provides the bytes of a file's buffers: the binary chunk, base64 within the JSON, or other
/// files, which are read when they are first requested.
class GltfBuffers {
 public:
  /// `chunks` and all requested values must outlive this object. File names are relative to
  /// `folder`.
  GltfBuffers(const GltfChunks& chunks, std::filesystem::path folder)
      : chunks_(chunks), folder_(std::move(folder)) {}

  /// Returns the bytes of an item of the root's list `buffers`. Throws InputError if they are not
  /// available, or are fewer than the item states.
  std::string_view bytes(const GltfValue& buffer);

 private:
  std::string_view all_bytes(const GltfValue& buffer);
  std::string_view find(const GltfValue& buffer);
  std::string load(const GltfValue& uri) const;

  GltfChunks chunks_;
  std::filesystem::path folder_;
  std::map<std::string, std::string_view> known_;   ///< by the place of the buffer
  std::map<std::string_view, std::string> loaded_;  ///< by URI, which several buffers may share
};

}  // namespace pharos
