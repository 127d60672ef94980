#include "markdown.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <utility>

#include <fmt/format.h>

namespace pharos::docs {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

bool is_blank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

/// The opening marks of a fenced block.
struct Marks {
  std::size_t indentation = 0, length = 0;  ///< a length of 0: the line opens no block
  char sign = '`';
  std::string language;
};

Marks opening_marks(const std::string& line) {
  static const std::regex pattern(R"(( *)(`{3,}|~{3,})[ {.]*([\w+-]*)[^`]*)");
  std::smatch parts;
  if (!std::regex_match(line, parts, pattern)) return {};
  return {.indentation = static_cast<std::size_t>(parts[1].length()),
          .length = static_cast<std::size_t>(parts[2].length()),
          .sign = *parts[2].first,
          .language = parts[3]};
}

bool closes(const std::string& line, const Marks& marks) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t end = std::min(line.find_first_not_of(marks.sign, begin), line.size());
  return end - begin >= marks.length && is_blank(line.substr(end));
}

std::string without_indentation(const std::string& line, std::size_t indentation) {
  const std::size_t spaces = std::min(line.find_first_not_of(' '), line.size());
  return line.substr(std::min(spaces, indentation));
}

/// A page as its fenced blocks, and its lines without them.
struct Split {
  std::vector<Fence> fences;
  std::vector<std::string> prose;  ///< one line per line of the page
  std::size_t open_fence = 0;
};

/// Returns the last paragraph of the lines, on one line.
std::string last_paragraph(const std::vector<std::string>& lines) {
  std::size_t end = lines.size();
  while (end > 0 && is_blank(lines[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && !is_blank(lines[begin - 1])) --begin;
  std::string paragraph;
  for (std::size_t i = begin; i < end; ++i) paragraph += lines[i] + " ";
  return paragraph;
}

Split split(const std::vector<std::string>& lines) {
  Split result;
  Marks marks;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (marks.length == 0) {
      marks = opening_marks(lines[i]);
      if (marks.length > 0) {
        result.fences.push_back({.language = marks.language,
                                 .text = {},
                                 .line = i + 1,
                                 .before = last_paragraph(result.prose)});
      }
      result.prose.push_back(marks.length > 0 ? "" : lines[i]);
      continue;
    }
    result.prose.emplace_back();
    if (closes(lines[i], marks)) {
      marks = {};
    } else {
      result.fences.back().text += without_indentation(lines[i], marks.indentation) + "\n";
    }
  }
  if (marks.length > 0) result.open_fence = result.fences.back().line;
  return result;
}

/// Returns the lines as one text in which inline code is replaced by spaces.
std::string without_code(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  for (std::size_t begin = 0; (begin = text.find('`', begin)) != std::string::npos;) {
    const std::size_t inner = std::min(text.find_first_not_of('`', begin), text.size());
    const std::string marks = text.substr(begin, inner - begin);
    std::size_t close = text.find(marks, inner);
    // Code ends with its paragraph. A mark without a partner is a character like any other.
    if (close > text.find("\n\n", inner)) close = std::string::npos;
    const std::size_t end = close == std::string::npos ? inner : close + marks.size();
    for (std::size_t i = begin; i < end; ++i) {
      if (text[i] != '\n') text[i] = ' ';
    }
    begin = end;
  }
  return text;
}

std::size_t line_at(const std::string& text, std::size_t place) {
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(place), '\n'));
}

std::vector<Link> links_of(const std::string& text) {
  static const std::regex inline_link(R"(\]\(\s*<?([^)\s>]*))");
  static const std::regex definition(R"((?:^|\n) {0,3}\[[^\]^][^\]]*\]:\s*<?([^\s>]+))");
  static const std::regex attribute(R"re(<[a-z][^>]*\s(?:src|href)="([^"]*)")re");
  std::vector<Link> links;
  for (const std::regex* pattern : {&inline_link, &definition, &attribute}) {
    for (std::sregex_iterator i(text.begin(), text.end(), *pattern), end; i != end; ++i) {
      links.push_back({(*i)[1], line_at(text, static_cast<std::size_t>(i->position(1)))});
    }
  }
  return links;
}

/// Returns the text that a reader sees in place of links and HTML tags.
std::string visible_text(const std::string& heading) {
  static const std::regex link(R"(!?\[([^\]]*)\]\([^)]*\))"), tag("<[^>]*>");
  return std::regex_replace(std::regex_replace(heading, link, "$1"), tag, "");
}

std::vector<std::string> anchors_of(const std::vector<std::string>& lines) {
  static const std::regex heading(R"(#{1,6}\s+(.*?)[\s#]*)");
  std::vector<std::string> anchors;
  for (const std::string& line : lines) {
    std::smatch parts;
    if (!std::regex_match(line, parts, heading)) continue;
    const std::string first = slug(visible_text(parts[1]));
    std::string anchor = first;
    for (int n = 1; std::count(anchors.begin(), anchors.end(), anchor) > 0; ++n) {
      anchor = fmt::format("{}_{}", first, n);
    }
    anchors.push_back(anchor);
  }
  return anchors;
}

}  // namespace

Page parse_page(std::string_view text) {
  Split parts = split(lines_of(text));
  return {.fences = std::move(parts.fences),
          .links = links_of(without_code(parts.prose)),
          .anchors = anchors_of(parts.prose),
          .open_fence = parts.open_fence};
}

std::string slug(std::string_view heading) {
  static const std::regex outer_space(R"(^\s+|\s+$)"), gap(R"([\s-]+)");
  std::string kept;
  for (const char c : heading) {
    const auto code = static_cast<unsigned char>(c);
    const bool of_word = std::isalnum(code) != 0 || c == '_' || c == '-' || c == ' ';
    if (code < 128 && of_word) kept += static_cast<char>(std::tolower(code));
  }
  return std::regex_replace(std::regex_replace(kept, outer_space, ""), gap, "-");
}

}  // namespace pharos::docs
