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

/// A value in the JSON of a glTF file, with its place in the file, such as "accessors[3].count".
/// All functions except the first throw an InputError that names the place if the value is missing
/// or has another type than requested. The document must outlive the value.
class GltfValue {
 public:
  GltfValue(const nlohmann::json& json, std::string place)
      : json_(&json), place_(std::move(place)) {}

  bool has(const char* key) const;
  GltfValue member(const char* key) const;
  /// The size and an item of an array.
  std::size_t size() const;
  GltfValue item(std::size_t index) const;

  double number() const;
  std::uint64_t whole() const;
  bool truth() const;
  const std::string& text() const;

  /// These functions read a member that may be missing.
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
  /// Throws InputError if `text` is not JSON. The error is located if `file` is not empty.
  GltfDocument(std::string_view text, const std::string& file);

  GltfValue root() const { return {*json_, ""}; }
  /// Returns the item that `reference` names by its index in the root's array `key`.
  GltfValue referenced(const GltfValue& reference, const char* key) const;

 private:
  std::shared_ptr<const nlohmann::json> json_;
};

}  // namespace pharos
