#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <pharos/core/error.h>

namespace pharos::pbrt {

/// A token of a scene file.
struct Token {
  enum class Kind {
    end,    ///< the end of the file
    word,   ///< a directive, a number, `true` or `false`
    text,   ///< between quotes
    open,   ///< [
    close,  ///< ]
  };
  Kind kind = Kind::end;
  std::string_view raw;      ///< as in the file; a text without its quotes
  int line = 0, column = 0;  ///< from 1
};

/// Splits a scene file of pbrt-v4 into tokens. Comments extend from # to the end of the line.
class Lexer {
 public:
  /// Refers to `text`. `file` is the name used in messages.
  Lexer(std::string_view text, std::string file);

  /// Returns the next token and moves past it. Throws InputError for a text that does not end in
  /// its line.
  Token next();
  /// Returns the next token without moving.
  const Token& peek();
  /// Moves to a place. Returns false if the file has no such place.
  bool seek(int line, int column);

  Location where(const Token& token) const { return {file_, token.line, token.column}; }
  /// Throws InputError at a token.
  [[noreturn]] void fail(const Token& token, const std::string& message) const;
  /// Returns the next token, which must be a text, without escapes. Otherwise throws InputError
  /// that says that `expected` is missing.
  std::string text(const char* expected);
  /// Returns the next token, which must be a finite number.
  double number();

 private:
  Token read();
  void skip_blanks();
  Token quoted();

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0, line_begin_ = 0;
  int line_ = 1;
  std::optional<Token> ahead_;
};

/// Describes a token in messages: "'Shape'", "the text 'a'", "the end of the file".
std::string describe(const Token& token);

/// Returns the number of a word, if it is a number that is finite as a float. Numbers too small for
/// a double are 0.
std::optional<double> number_of(std::string_view word);

/// Returns a text with its escapes (\n, \", …) replaced.
std::string unescaped(std::string_view raw);

}  // namespace pharos::pbrt
