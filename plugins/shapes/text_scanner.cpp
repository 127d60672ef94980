#include "text_scanner.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "decimal.h"

namespace pharos {
namespace {

/// Other control characters, such as NUL, belong to words, where no statement accepts them.
bool is_blank_or_break(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Returns the first character after a line break at `at`, across which a backslash before `at`
/// would continue the line. Returns null if there is no line break.
const char* after_break(const char* at, const char* end) {
  if (at != end && *at == '\r') ++at;
  return at != end && *at == '\n' ? at + 1 : nullptr;
}

}  // namespace

TextScanner::TextScanner(std::string_view text, std::string file)
    : file_(std::move(file)),
      at_(text.data()),
      end_(text.data() + text.size()),
      line_begin_(at_),
      word_(at_) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) at_ += byte_order_mark.size();
}

bool TextScanner::next_line() {
  while (has_word()) word();  // continued lines included
  at_ = std::find(at_, end_, '\n');
  if (at_ == end_) return false;
  line_begin_ = word_ = ++at_;
  ++line_;
  return true;
}

void TextScanner::skip_blanks() {
  while (at_ != end_ && *at_ != '\n') {
    if (is_blank_or_break(*at_)) {
      ++at_;
      continue;
    }
    const char* const next = *at_ == '\\' ? after_break(at_ + 1, end_) : nullptr;
    if (next == nullptr) return;
    at_ = line_begin_ = next;
    ++line_;
  }
}

bool TextScanner::has_word() {
  skip_blanks();
  return at_ != end_ && *at_ != '\n' && *at_ != '#';
}

std::string_view TextScanner::word() {
  const bool exists = has_word();
  word_ = at_;
  if (!exists) return {};
  at_ = std::find_if(at_, end_, is_blank_or_break);
  if (at_[-1] == '\\' && after_break(at_, end_) != nullptr) --at_;  // the next call continues there
  return {word_, static_cast<std::size_t>(at_ - word_)};
}

std::string_view TextScanner::rest() {
  skip_blanks();
  word_ = at_;
  at_ = std::find(at_, end_, '\n');
  const char* last = at_;
  while (last != word_ && is_blank_or_break(last[-1])) --last;
  return {word_, static_cast<std::size_t>(last - word_)};
}

float TextScanner::number() {
  std::string_view text = word();
  if (text.empty()) fail("a number is missing");
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [rest, error] = read_decimal(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && rest == text.data() + text.size();
  if (!is_number) fail(fmt::format("'{}' is not a number", one_line(text, 40)));
  const auto number = static_cast<float>(value);
  if (!std::isfinite(number)) fail(fmt::format("'{}' is not finite", one_line(text, 40)));
  return number;
}

Vec3 TextScanner::vec3() {
  const float x = number(), y = number();
  return {x, y, number()};
}

void TextScanner::fail(const std::string& what) const {
  throw InputError({file_, line_, static_cast<int>(word_ - line_begin_) + 1}, what);
}

}  // namespace pharos
