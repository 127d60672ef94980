#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pharos/config/node.h>

/// Names that config files give to the things they compare.
namespace pharos {

/// The characters of a name, in words for messages.
inline constexpr const char* kEntryNameRule =
    "letters, digits, '.', '_', '+' and '-', not '.' first";

/// Returns whether a name is valid. It has at most 100 characters, so that it can also be the name
/// of a file or folder.
bool is_entry_name(const std::string& name);

/// Returns the names of the entries under `key` of a config, in order. Throws InputError if there
/// is no entry or a name occurs twice.
template <class Entry>
std::vector<std::string> names_of(const std::vector<Entry>& entries, const ConfigNode& root,
                                  const char* key) {
  std::vector<std::string> names;
  const ConfigNode* list = root.find(key);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (std::find(names.begin(), names.end(), entries[i].name) != names.end()) {
      list->items()[i].fail(
          fmt::format("the name '{}' stands twice in '{}'", entries[i].name, key));
    }
    names.push_back(entries[i].name);
  }
  if (names.empty()) root.fail(fmt::format("expected at least one entry in '{}'", key));
  return names;
}

/// Throws InputError at the key `baseline` of `root` unless `baseline` is one of `names`.
void check_baseline(const std::string& baseline, const std::vector<std::string>& names,
                    const char* what, const ConfigNode& root);

}  // namespace pharos
