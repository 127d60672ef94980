#include "shell_words.h"

#include <algorithm>
#include <utility>

namespace pharos::docs {
namespace {

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::vector<ShellCommand> read() {
    while (at_ < text_.size()) step();
    end_command();
    return std::move(commands_);
  }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '\\') {
      escape();
    } else if (c == '\'' || c == '"') {
      quotation(c);
    } else if (c == '#' && !in_word_) {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (c == '\n' || c == ';' || c == '&' || c == '|') {
      end_command();
      next();
    } else if (c == '>' || c == '<') {
      redirect();
    } else if (c == ' ' || c == '\t' || c == '\r') {
      end_word();
      next();
    } else {
      add(c);
      next();
    }
  }

  /// A backslash joins lines, or takes the next character as it is.
  void escape() {
    next();
    if (at_ >= text_.size()) return;
    if (text_[at_] != '\n') add(text_[at_]);
    next();
  }

  void quotation(char mark) {
    begin_word();
    for (next(); at_ < text_.size() && text_[at_] != mark; next()) word_ += text_[at_];
    next();
  }

  /// The word that follows the sign is a file, not an argument.
  void redirect() {
    end_word();
    next();
    redirected_ = true;
  }

  void next() {
    if (at_ < text_.size() && text_[at_] == '\n') ++line_;
    ++at_;
  }

  void begin_word() {
    if (!in_word_ && command_.words.empty()) command_.line = line_;
    in_word_ = true;
  }

  void add(char c) {
    begin_word();
    word_ += c;
  }

  void end_word() {
    if (!in_word_) return;
    if (!redirected_) command_.words.push_back(word_);
    redirected_ = in_word_ = false;
    word_.clear();
  }

  void end_command() {
    end_word();
    redirected_ = false;
    if (!command_.words.empty()) commands_.push_back(std::move(command_));
    command_ = {};
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 0;
  bool in_word_ = false, redirected_ = false;
  std::string word_;
  ShellCommand command_;
  std::vector<ShellCommand> commands_;
};

}  // namespace

std::vector<ShellCommand> shell_commands(std::string_view text) {
  return Reader(text).read();
}

std::string quoted(const std::string& word) {
  std::string result = "'";
  for (const char c : word) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

}  // namespace pharos::docs
