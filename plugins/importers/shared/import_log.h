#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <pharos/scene/importer.h>

namespace pharos::importing {

/// Collects the notes and objects of an import.
class ImportLog {
 public:
  /// Starts with the notes from reading the file.
  explicit ImportLog(const std::vector<ImportNote>& notes = {});

  /// Adds a note. Notes with the same message are counted instead of repeated.
  void note(const Location& where, const std::string& message);

  /// Adds an object that stands for nothing yet, and returns its number.
  std::size_t add_object(const Location& where, std::string what);
  /// States the Pharos object that represents an object.
  void stands(std::size_t object, std::string what);

  /// The import so far.
  Import& result() { return result_; }

 private:
  Import result_;
  std::map<std::string, std::size_t> note_index_;
};

/// The names of a dictionary in a config (`textures`, `materials`, …).
class EntryNames {
 public:
  /// `word` precedes ids that cannot be names, as in "texture_2".
  explicit EntryNames(std::string word) : word_(std::move(word)) {}
  /// Returns a name that was not returned before: `id` if possible, without characters that YAML
  /// uses for other purposes.
  std::string take(const std::string& id);

 private:
  std::string word_;
  std::set<std::string> taken_;
  std::map<std::string, int> next_number_;  ///< to try, by the name before the number
};

}  // namespace pharos::importing
