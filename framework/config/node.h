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

  static ConfigNode scalar(std::string text, Location where = {});
  static ConfigNode sequence(Location where = {});
  static ConfigNode mapping(Location where = {});

  Kind kind() const { return kind_; }
  bool is_null() const { return kind_ == Kind::null; }
  bool is_scalar() const { return kind_ == Kind::scalar; }
  bool is_sequence() const { return kind_ == Kind::sequence; }
  bool is_mapping() const { return kind_ == Kind::mapping; }
  /// "a mapping", "the scalar 'x'", … for error messages.
  std::string describe() const;

  const Location& where() const { return where_; }
  const std::string& text() const { return text_; }
  const std::vector<ConfigNode>& items() const { return items_; }
  std::vector<ConfigNode>& items() { return items_; }
  const std::vector<Entry>& entries() const { return entries_; }

  /// The value under `key`; null when this is no mapping or has no such key.
  const ConfigNode* find(std::string_view key) const;
  /// Where `key` itself was written; this node's own place when there is no such key.
  const Location& where_key(std::string_view key) const;
  /// Adds or replaces an entry.
  void set(std::string key, ConfigNode value, Location key_where = {});
  /// Takes an entry out and returns its value, or a null node.
  ConfigNode take(std::string_view key);

  /// Throws InputError at this node's location.
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

/// Reads one YAML document. Throws InputError (file:line:column) for bad syntax, duplicate keys,
/// keys that are not scalars, or nesting deeper than 64.
ConfigNode read_yaml(const std::filesystem::path& path);
ConfigNode parse_yaml(std::string_view text, const std::string& name);

/// Reads a config and follows `extends: other.yaml` (relative to the file that says so; a path or
/// a list of paths, later ones win). Mappings merge key by key, but for a mapping with another
/// `type`, which replaces; everything else replaces. Cycles are an InputError.
ConfigNode read_config(const std::filesystem::path& path);

/// Applies one `a.b.c=value` override; the value is YAML. An index steps into a sequence.
void apply_override(ConfigNode& root, const std::string& assignment);

/// Writes YAML that parses to an equal node. Sequences of scalars stand on one line.
std::string to_yaml(const ConfigNode& node);

}  // namespace pharos
