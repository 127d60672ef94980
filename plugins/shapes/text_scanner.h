#pragma once

#include <string>
#include <string_view>

#include <pharos/core/vec.h>

namespace pharos {

/// Scans a text file line by line and word by word. A word that begins with '#' begins a comment,
/// which extends to the end of the line. A backslash at the end of a line continues the line.
class TextScanner {
 public:
  /// `file` is the name used in messages.
  TextScanner(std::string_view text, std::string file);

  /// Skips the rest of the line and of its continuation lines. Returns false at the end of the
  /// text.
  bool next_line();
  /// Returns whether the line has another word.
  bool has_word();
  /// Returns the next word of the line, or an empty one at the end of the line.
  std::string_view word();
  /// Returns the rest of the line, without blanks around it.
  std::string_view rest();
  /// Returns the next word as a number, which must be finite as a float. A number too small for a
  /// float becomes 0.
  float number();
  /// Returns the next three numbers.
  Vec3 vec3();

  /// Throws InputError, located at the last word, or at the end of the line if a word was missing.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void skip_blanks();

  std::string file_;
  const char* at_;
  const char* end_;
  const char* line_begin_;
  const char* word_;  ///< begin of the last word
  int line_ = 1;
};

}  // namespace pharos
