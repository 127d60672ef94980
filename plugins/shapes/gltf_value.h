#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json_fwd.hpp>

#include "double3.h"

namespace pharos {

/// A value in the JSON of a glTF file, with the place where it stands, such as
/// "accessors[3].count". All functions but the first throw InputError that names the place when the
/// value is missing or not of the kind asked for. Lives as long as the document.
class GltfValue {
 public:
  GltfValue(const nlohmann::json& json, std::string place)
      : json_(&json), place_(std::move(place)) {}

  bool has(const char* key) const;
  GltfValue member(const char* key) const;
  /// Of an array.
  std::size_t size() const;
  GltfValue item(std::size_t index) const;

  double number() const;
  std::uint64_t whole() const;
  bool truth() const;
  const std::string& text() const;

  /// A member that may be missing.
  std::uint64_t whole(const char* key, std::uint64_t otherwise) const;
  bool truth(const char* key, bool otherwise) const;
  std::string text(const char* key, const std::string& otherwise) const;

  const std::string& place() const { return place_; }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  const nlohmann::json* json_;
  std::string place_;
};

/// A parsed file.
class GltfDocument {
 public:
  /// Throws InputError when `text` is not JSON: located if `file` is not empty.
  GltfDocument(std::string_view text, const std::string& file);

  GltfValue root() const { return {*json_, ""}; }
  /// The item that `reference` names by its index in the root's array `key`.
  GltfValue referenced(const GltfValue& reference, const char* key) const;

 private:
  std::shared_ptr<const nlohmann::json> json_;
};

}  // namespace pharos
