#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/core/error.h>

namespace pharos {

/// One located node of a configuration: a scalar, a sequence or a mapping that keeps its order.
/// A value type; knows nothing of YAML's library.
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
  /// What an error message says was found, on one line and shortened: "nothing", "the scalar 'x'",
  /// "the list [1, 2]", "the mapping { type: sobol, … }".
  std::string describe() const;

  const Location& where() const { return where_; }
  const std::string& text() const { return text_; }
  const std::vector<ConfigNode>& items() const { return items_; }
  std::vector<ConfigNode>& items() { return items_; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// For changing values in place; keys are unique, see set().
  std::vector<Entry>& entries() { return entries_; }

  /// The value under `key`; a null pointer when this is no mapping or has no such key.
  const ConfigNode* find(std::string_view key) const;
  ConfigNode* find(std::string_view key);
  /// Where `key` itself was written; this node's own place when there is no such key.
  const Location& where_key(std::string_view key) const;
  /// Adds an entry at the end, or replaces the one with this key where it stands.
  void set(std::string key, ConfigNode value, Location key_where = {});
  /// Takes an entry out and returns its value, or a null node.
  ConfigNode take(std::string_view key);

  /// Throws InputError at this node's location; unlocated when that is unknown.
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

/// Reads one YAML document. Throws InputError (file:line:column, the file as it was given) for a
/// file that is missing, a folder, no UTF-8 text, empty or over 32 MiB; for bad syntax, several
/// documents, tags, duplicate keys, keys that are not scalars, nesting deeper than 64 and documents
/// of more than a million nodes once aliases are copied out.
ConfigNode read_yaml(const std::filesystem::path& path);
/// The same for text that came from elsewhere; `name` stands for the file.
ConfigNode parse_yaml(std::string_view text, const std::string& name);
/// The same; every node, and every error, is located at `where`, not at its place in the text.
ConfigNode parse_yaml_at(std::string_view text, const Location& where);

/// Reads a config and follows `extends: other.yaml` (relative to the file that says so; a path or
/// a list of paths, later ones win, the file itself wins over all). Mappings merge key by key, but
/// for a mapping with another `type`, which replaces; everything else replaces, so that `key: null`
/// takes an inherited value back. Throws InputError also for cycles, for more than 256 files and
/// for a document that is not a mapping.
ConfigNode read_config(const std::filesystem::path& path);

/// `over` laid over `base` as a file over what it extends.
ConfigNode merged(ConfigNode base, ConfigNode over);

/// Applies one `a.b.c=value` override; the value is YAML and replaces what was there. An index
/// steps into a sequence; mappings that are missing are made. Throws InputError located at
/// "--set a.b.c=value".
void apply_override(ConfigNode& root, const std::string& assignment);

/// Writes block-style YAML that parses to an equal node. Sequences of scalars stand on one line.
std::string to_yaml(const ConfigNode& node);
/// The same in flow style, on one line without line break.
std::string to_flow_yaml(const ConfigNode& node);

}  // namespace pharos
