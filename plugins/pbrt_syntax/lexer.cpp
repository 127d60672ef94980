#include "lexer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include <fmt/core.h>

namespace pharos::pbrt {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f\v";
constexpr std::string_view kWordEnds = " \t\r\n\f\v\"[]#";

}  // namespace

Lexer::Lexer(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

Token Lexer::next() {
  if (!ahead_) return read();
  const Token token = *ahead_;
  ahead_.reset();
  return token;
}

const Token& Lexer::peek() {
  if (!ahead_) ahead_ = read();
  return *ahead_;
}

bool Lexer::seek(int line, int column) {
  ahead_.reset();
  at_ = line_begin_ = 0;
  line_ = 1;
  while (line_ < line) {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) return false;
    at_ = line_begin_ = end + 1;
    ++line_;
  }
  at_ = line_begin_ + static_cast<std::size_t>(std::max(column, 1) - 1);
  return line >= 1 && column >= 1 && at_ < text_.size();
}

void Lexer::fail(const Token& token, const std::string& message) const {
  throw InputError(where(token), message);
}

std::string Lexer::text(const char* expected) {
  const Token token = next();
  if (token.kind != Token::Kind::text) {
    fail(token, fmt::format("expected {} in quotes, found {}", expected, describe(token)));
  }
  return unescaped(token.raw);
}

double Lexer::number() {
  const Token token = next();
  const std::optional<double> value =
      token.kind == Token::Kind::word ? number_of(token.raw) : std::nullopt;
  if (!value) fail(token, fmt::format("expected a number, found {}", describe(token)));
  return *value;
}

void Lexer::skip_blanks() {
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
      if (at_ == text_.size()) return;
    } else if (kBlanks.find(c) == std::string_view::npos) {
      return;
    }
    if (text_[at_] != '\n') continue;
    ++line_;
    line_begin_ = at_ + 1;
  }
}

Token Lexer::read() {
  skip_blanks();
  Token token{.line = line_, .column = static_cast<int>(at_ - line_begin_) + 1};
  if (at_ >= text_.size()) return token;
  const char c = text_[at_];
  if (c == '"') return quoted();
  if (c == '[' || c == ']') {
    token.kind = c == '[' ? Token::Kind::open : Token::Kind::close;
    token.raw = text_.substr(at_++, 1);
    return token;
  }
  const std::size_t end = std::min(text_.find_first_of(kWordEnds, at_), text_.size());
  token.kind = Token::Kind::word;
  token.raw = text_.substr(at_, end - at_);
  at_ = end;
  return token;
}

Token Lexer::quoted() {
  Token token{
      .kind = Token::Kind::text, .line = line_, .column = static_cast<int>(at_ - line_begin_) + 1};
  const std::size_t begin = ++at_;
  while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n') {
    const bool escapes = text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n';
    at_ += escapes ? 2 : 1;
  }
  if (at_ >= text_.size() || text_[at_] != '"') {
    at_ = std::min(at_, text_.size());
    fail(token, "the text has no closing quote in its line");
  }
  token.raw = text_.substr(begin, at_ - begin);
  ++at_;
  return token;
}

std::string describe(const Token& token) {
  switch (token.kind) {
    case Token::Kind::end:
      return "the end of the file";
    case Token::Kind::text:
      return fmt::format("the text '{}'", one_line(token.raw, 60));
    default:
      return fmt::format("'{}'", one_line(token.raw, 60));
  }
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, value);
  if (rest != end || error == std::errc::invalid_argument) return std::nullopt;
  // The parser does not report whether the number is too large or too small; strtod does.
  if (error != std::errc{}) value = std::strtod(std::string(word).c_str(), nullptr);
  if (!(std::abs(value) <= std::numeric_limits<float>::max())) return std::nullopt;
  return value;
}

std::string unescaped(std::string_view raw) {
  std::string text;
  text.reserve(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] != '\\' || i + 1 == raw.size()) {
      text += raw[i];
      continue;
    }
    switch (const char c = raw[++i]) {
      case 'n':
        text += '\n';
        break;
      case 't':
        text += '\t';
        break;
      case 'r':
        text += '\r';
        break;
      case 'b':
        text += '\b';
        break;
      case 'f':
        text += '\f';
        break;
      default:
        text += c;
    }
  }
  return text;
}

}  // namespace pharos::pbrt
