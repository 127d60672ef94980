#include "import_log.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include <pharos/config/values.h>

namespace pharos::importing {
namespace {

bool may_stand_in_names(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || c == '_' || c == '-' || static_cast<unsigned char>(c) >= 0x80;
}

/// Returns whether a config would not read the word as a name, or uses it as its own key.
bool is_taken_word(const std::string& name) {
  static constexpr std::array<std::string_view, 12> words{"",      "null",  "Null",    "NULL",
                                                          "true",  "True",  "TRUE",    "false",
                                                          "False", "FALSE", "default", "-"};
  return std::find(words.begin(), words.end(), name) != words.end() || is_number(name);
}

}  // namespace

ImportLog::ImportLog(const std::vector<ImportNote>& notes) {
  for (const ImportNote& note : notes) {
    note_index_[note.message] = result_.notes.size();
    result_.notes.push_back(note);
  }
}

void ImportLog::note(const Location& where, const std::string& message) {
  const auto [found, is_new] = note_index_.try_emplace(message, result_.notes.size());
  if (is_new) {
    result_.notes.push_back({where, message});
  } else {
    ++result_.notes[found->second].times;
  }
}

std::size_t ImportLog::add_object(const Location& where, std::string what) {
  result_.objects.push_back({where, std::move(what), "nothing"});
  return result_.objects.size() - 1;
}

void ImportLog::stands(std::size_t object, std::string what) {
  result_.objects[object].stands = std::move(what);
}

std::string EntryNames::take(const std::string& id) {
  std::string base = id;
  for (char& c : base) {
    if (!may_stand_in_names(c)) c = '_';
  }
  if (is_taken_word(base)) base = word_ + (base.empty() ? "" : "_") + base;
  std::string name = base;
  int& next = next_number_.try_emplace(base, 2).first->second;
  while (!taken_.insert(name).second) name = fmt::format("{}_{}", base, next++);
  return name;
}

}  // namespace pharos::importing
