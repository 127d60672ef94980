#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pharos/config/node.h>

/// Names that config files give to what they compare.
namespace pharos {

/// What a name is made of, in words for messages.
inline constexpr const char* kEntryNameRule =
    "letters, digits, '.', '_', '+' and '-', not '.' first";

/// Whether a name is one: at most 100 letters, so that it can also be that of a file or folder.
bool is_entry_name(const std::string& name);

/// The names of the entries under `key` of a config, in order. Throws InputError when there is none
/// or a name stands twice.
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

/// Throws InputError at `root`'s key `baseline` unless it names one of `names`.
void check_baseline(const std::string& baseline, const std::vector<std::string>& names,
                    const char* what, const ConfigNode& root);

}  // namespace pharos
