#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/core/error.h>

namespace pharos {

/// One node of a configuration with its location: null, a scalar, a sequence or a mapping that
/// keeps the order of its entries. A value type that is independent of the YAML library.
class ConfigNode {
 public:
  enum class Kind { null, scalar, sequence, mapping };
  struct Entry;

  ConfigNode();
  ~ConfigNode();
  ConfigNode(const ConfigNode&);
  ConfigNode(ConfigNode&&) noexcept;
  ConfigNode& operator=(const ConfigNode&);
  ConfigNode& operator=(ConfigNode&&) noexcept;

  static ConfigNode null(Location where = {});
  static ConfigNode scalar(std::string text, Location where = {});
  static ConfigNode sequence(Location where = {});
  static ConfigNode mapping(Location where = {});

  Kind kind() const { return kind_; }
  bool is_null() const { return kind_ == Kind::null; }
  bool is_scalar() const { return kind_ == Kind::scalar; }
  bool is_sequence() const { return kind_ == Kind::sequence; }
  bool is_mapping() const { return kind_ == Kind::mapping; }
  /// Returns a description of the node for error messages, on one line and shortened: "nothing",
  /// "the scalar 'x'", "the list [1, 2]", "the mapping { type: sobol, … }".
  std::string describe() const;

  const Location& where() const { return where_; }
  const std::string& text() const { return text_; }
  const std::vector<ConfigNode>& items() const { return items_; }
  std::vector<ConfigNode>& items() { return items_; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// The entries, for changing values in place. Keys are unique, see set().
  std::vector<Entry>& entries() { return entries_; }

  /// Returns the value under `key`, or a null pointer if this node is not a mapping or has no such
  /// key.
  const ConfigNode* find(std::string_view key) const;
  ConfigNode* find(std::string_view key);
  /// Returns the location of `key` itself, or the location of this node if there is no such key.
  const Location& where_key(std::string_view key) const;
  /// Adds an entry at the end. If there is an entry with this key, replaces that entry in place.
  void set(std::string key, ConfigNode value, Location key_where = {});
  /// Removes an entry and returns its value, or returns a null node if there is no such entry.
  ConfigNode take(std::string_view key);

  /// Throws InputError at the location of this node. The error is unlocated if the location is
  /// unknown.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  Kind kind_ = Kind::null;
  Location where_;
  std::string text_;
  std::vector<ConfigNode> items_;
  std::vector<Entry> entries_;
};

struct ConfigNode::Entry {
  std::string key;
  Location key_where;
  ConfigNode value;
};

/// Reads one YAML document. Throws InputError (file:line:column, with the file as it was given) for
/// a file that is missing, a folder, not UTF-8 text, empty or over 32 MiB. Also throws it for bad
/// syntax, several documents, tags, duplicate keys, keys that are not scalars, nesting deeper than
/// 64 levels and documents of more than a million nodes after aliases are expanded.
ConfigNode read_yaml(const std::filesystem::path& path);
/// Reads a YAML document from a text. `name` takes the place of the file. Throws InputError like
/// read_yaml().
ConfigNode parse_yaml(std::string_view text, const std::string& name);
/// Reads a YAML document from a text. Every node and every error has the location `where`, whatever
/// its place in the text.
ConfigNode parse_yaml_at(std::string_view text, const Location& where);

/// Reads a config and follows its `extends: other.yaml`. The value of `extends` is a path or a list
/// of paths, relative to the file that contains it. Later files of the list override earlier ones,
/// and the file itself overrides all of them. Mappings are merged key by key, except that a mapping
/// with another `type` replaces the inherited mapping. Everything else replaces the inherited
/// value, so `key: null` removes it. Throws InputError like read_yaml(), and also for cycles, for
/// more than 256 files and for a document that is not a mapping. Appends the files that were read
/// to `files`, if it is not null.
ConfigNode read_config(const std::filesystem::path& path,
                       std::vector<std::filesystem::path>* files = nullptr);

/// Merges `over` into `base`, like a file into the config that it extends.
ConfigNode merged(ConfigNode base, ConfigNode over);

/// Applies one override `a.b.c=value`. The value is YAML and replaces the previous value. A number
/// in the path is an index into a sequence. Missing mappings are created. Throws InputError located
/// at "--set a.b.c=value".
void apply_override(ConfigNode& root, const std::string& assignment);

/// Returns block-style YAML that parses to an equal node. Sequences of scalars are written on one
/// line.
std::string to_yaml(const ConfigNode& node);
/// Returns flow-style YAML on one line without a line break.
std::string to_flow_yaml(const ConfigNode& node);

}  // namespace pharos
