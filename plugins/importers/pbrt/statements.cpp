#include "statements.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <fmt/core.h>

namespace pharos::pbrt {
namespace {

namespace fs = std::filesystem;

/// The number of texts and of numbers after a directive, and whether parameters follow.
struct Form {
  int texts = 0, numbers = 0;
  bool parameters = false;
};

const std::map<std::string_view, Form>& forms() {
  static const std::map<std::string_view, Form> all{{"Accelerator", {1, 0, true}},
                                                    {"ActiveTransform", {}},
                                                    {"AreaLightSource", {1, 0, true}},
                                                    {"Attribute", {1, 0, true}},
                                                    {"AttributeBegin", {}},
                                                    {"AttributeEnd", {}},
                                                    {"Camera", {1, 0, true}},
                                                    {"ColorSpace", {1, 0, false}},
                                                    {"ConcatTransform", {0, 16, false}},
                                                    {"CoordSysTransform", {1, 0, false}},
                                                    {"CoordinateSystem", {1, 0, false}},
                                                    {"Film", {1, 0, true}},
                                                    {"Identity", {}},
                                                    {"Import", {1, 0, false}},
                                                    {"Include", {1, 0, false}},
                                                    {"Integrator", {1, 0, true}},
                                                    {"LightSource", {1, 0, true}},
                                                    {"LookAt", {0, 9, false}},
                                                    {"MakeNamedMaterial", {1, 0, true}},
                                                    {"MakeNamedMedium", {1, 0, true}},
                                                    {"Material", {1, 0, true}},
                                                    {"MediumInterface", {1, 0, false}},
                                                    {"NamedMaterial", {1, 0, false}},
                                                    {"ObjectBegin", {1, 0, false}},
                                                    {"ObjectEnd", {}},
                                                    {"ObjectInstance", {1, 0, false}},
                                                    {"Option", {1, 0, false}},
                                                    {"PixelFilter", {1, 0, true}},
                                                    {"ReverseOrientation", {}},
                                                    {"Rotate", {0, 4, false}},
                                                    {"Sampler", {1, 0, true}},
                                                    {"Scale", {0, 3, false}},
                                                    {"Shape", {1, 0, true}},
                                                    {"Texture", {3, 0, true}},
                                                    {"Transform", {0, 16, false}},
                                                    {"TransformBegin", {}},
                                                    {"TransformEnd", {}},
                                                    {"TransformTimes", {0, 2, false}},
                                                    {"Translate", {0, 3, false}},
                                                    {"WorldBegin", {}}};
  return all;
}

[[noreturn]] void fail_word(const Lexer& lexer, const Token& token) {
  std::vector<std::string> known;
  if (token.kind == Token::Kind::word) {
    for (const auto& [word, form] : forms()) known.emplace_back(word);
  }
  lexer.fail(token, fmt::format("expected a directive, found {}{}", describe(token),
                                suggestion(token.raw, known)));
}

/// Reads numbers, which may stand between brackets.
std::vector<double> read_numbers(Lexer& lexer, int count) {
  const bool in_brackets = count > 0 && lexer.peek().kind == Token::Kind::open;
  if (in_brackets) lexer.next();
  std::vector<double> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(lexer.number());
  if (!in_brackets) return numbers;
  const Token close = lexer.next();
  if (close.kind != Token::Kind::close) {
    lexer.fail(close, fmt::format("expected ] after {} numbers, found {}", count, describe(close)));
  }
  return numbers;
}

/// Returns which transforms an ActiveTransform selects.
std::string read_times(Lexer& lexer) {
  const Token token = lexer.next();
  for (const char* known : {"All", "StartTime", "EndTime"}) {
    if (token.kind == Token::Kind::word && token.raw == known) return known;
  }
  lexer.fail(token, fmt::format("expected All, StartTime or EndTime, found {}", describe(token)));
}

/// Returns the value of an Option, whose name has no type.
std::string read_option(Lexer& lexer) {
  const Token token = lexer.next();
  if (token.kind != Token::Kind::word && token.kind != Token::Kind::text) {
    lexer.fail(token, fmt::format("expected the value of the option, found {}", describe(token)));
  }
  return std::string(token.raw);
}

}  // namespace

struct StatementReader::File {
  fs::path path;
  std::string text;
  Lexer lexer;
  bool is_import;
  bool begins = true;  ///< whether nothing was read from it so far

  File(fs::path where, std::string content, bool import)
      : path(std::move(where)),
        text(std::move(content)),
        lexer(text, path.string()),
        is_import(import) {}
};

StatementReader::StatementReader(const fs::path& file, importing::ReadingBudget& budget)
    : folder_(file.parent_path()), budget_(budget) {
  open(file, false);
}

StatementReader::~StatementReader() = default;

void StatementReader::open(const fs::path& path, bool is_import) {
  files_.push_back(std::make_unique<File>(path, importing::read_file(path, budget_), is_import));
}

fs::path file_in(const fs::path& folder, const std::string& name) {
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  return folder / slashes;
}

void StatementReader::include(const Statement& statement) {
  const fs::path path = file_in(folder_, statement.type());
  if (const std::string problem = file_problem(path); !problem.empty()) {
    throw InputError(statement.where,
                     fmt::format("'{}': {}", one_line(statement.type(), 200), problem));
  }
  for (const auto& file : files_) {
    std::error_code failed;
    if (fs::equivalent(file->path, path, failed)) {
      throw InputError(statement.where,
                       fmt::format("'{}' includes itself", one_line(statement.type(), 200)));
    }
  }
  open(path, statement.word == "Import");
}

Statement StatementReader::read_statement(const Token& word) {
  Lexer& lexer = files_.back()->lexer;
  const auto form = forms().find(word.raw);
  if (word.kind != Token::Kind::word || form == forms().end()) fail_word(lexer, word);
  if (budget_.elements-- == 0) lexer.fail(word, "a scene may have at most a million directives");
  Statement statement{std::string(word.raw), lexer.where(word), {}, {}, {}};
  for (int i = 0; i < form->second.texts; ++i) {
    statement.texts.push_back(lexer.text("a name or type"));
  }
  if (statement.word == "MediumInterface" && lexer.peek().kind == Token::Kind::text) {
    statement.texts.push_back(lexer.text("a medium"));
  }
  if (statement.word == "Option") statement.texts.push_back(read_option(lexer));
  if (statement.word == "ActiveTransform") statement.texts.push_back(read_times(lexer));
  statement.numbers = read_numbers(lexer, form->second.numbers);
  if (form->second.parameters) statement.parameters = read_parameters(lexer);
  return statement;
}

std::optional<Statement> StatementReader::next() {
  while (!files_.empty()) {
    File& file = *files_.back();
    if (std::exchange(file.begins, false) && file.is_import) {
      return Statement{"AttributeBegin", {file.path.string(), 1, 1}, {}, {}, {}};
    }
    const Token word = file.lexer.next();
    if (word.kind == Token::Kind::end) {
      end_ = file.lexer.where(word);
      const bool was_import = file.is_import;
      files_.pop_back();
      if (was_import) return Statement{"AttributeEnd", end_, {}, {}, {}};
      continue;
    }
    Statement statement = read_statement(word);
    if (statement.word != "Include" && statement.word != "Import") return statement;
    include(statement);
  }
  return std::nullopt;
}

}  // namespace pharos::pbrt
