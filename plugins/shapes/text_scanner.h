#pragma once

#include <string>
#include <string_view>

#include <pharos/core/vec.h>

namespace pharos {

/// Goes through a text file line by line and word by word. A word that begins with '#' begins a
/// comment, which ends the line; a backslash at the end of a line continues it.
class TextScanner {
 public:
  /// `file`: for messages.
  TextScanner(std::string_view text, std::string file);

  /// Passes over the rest of the line and of those that continue it; false at the end of the text.
  bool next_line();
  /// Whether the line has another word.
  bool has_word();
  /// The next word of the line; empty when there is none.
  std::string_view word();
  /// The rest of the line, without blanks around it.
  std::string_view rest();
  /// The next word, which must be a number that is finite in float; 0 where it is too small for
  /// one.
  float number();
  /// The next three numbers.
  Vec3 vec3();

  /// Throws InputError, located at the last word, or at the line's end where a word was missing.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void skip_blanks();

  std::string file_;
  const char* at_;
  const char* end_;
  const char* line_begin_;
  const char* word_;  ///< where the last word begins
  int line_ = 1;
};

}  // namespace pharos
