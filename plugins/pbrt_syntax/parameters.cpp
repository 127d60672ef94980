#include "parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/core.h>

namespace pharos::pbrt {
namespace {

struct Type {
  std::string_view written, name;
  std::size_t size;  ///< numbers a value; 0 for texts
};
constexpr std::array<Type, 16> kTypes{{{"integer", "integer", 1},
                                       {"float", "float", 1},
                                       {"point2", "point2", 2},
                                       {"vector2", "vector2", 2},
                                       {"point3", "point3", 3},
                                       {"point", "point3", 3},
                                       {"vector3", "vector3", 3},
                                       {"vector", "vector3", 3},
                                       {"normal", "normal", 3},
                                       {"normal3", "normal", 3},
                                       {"bool", "bool", 1},
                                       {"string", "string", 0},
                                       {"texture", "texture", 0},
                                       {"spectrum", "spectrum", 1},
                                       {"rgb", "rgb", 3},
                                       {"blackbody", "blackbody", 1}}};

/// Types of version 3, and what they are in version 4.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kFormerTypes{
    {{"color", "rgb"}, {"xyz", "rgb"}}};

const Type& type_of(const Lexer& lexer, const Token& declaration, std::string_view word) {
  std::vector<std::string> known;
  for (const Type& type : kTypes) {
    if (type.written == word) return type;
    known.emplace_back(type.written);
  }
  for (const auto& [former, today] : kFormerTypes) {
    if (former != word) continue;
    lexer.fail(declaration, fmt::format("'{}' is a type of pbrt-v3; pbrt-v4 has '{}' (pbrt itself "
                                        "converts files with --upgrade)",
                                        former, today));
  }
  lexer.fail(declaration,
             fmt::format("unknown type of parameter '{}'{}; known: {}", one_line(word, 60),
                         suggestion(word, known), quoted_list(known)));
}

/// Reads the declaration `"type name"`.
std::pair<const Type*, std::string> read_declaration(const Lexer& lexer, const Token& token) {
  const std::string text = unescaped(token.raw);
  const std::size_t begin = text.find_first_not_of(" \t");
  const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
  const std::size_t name = begin == std::string::npos ? begin : text.find_first_not_of(" \t", end);
  if (name == std::string::npos) {
    lexer.fail(token, fmt::format("expected a parameter such as \"float fov\", found {}",
                                  describe(token)));
  }
  const std::size_t last = text.find_last_not_of(" \t");
  return {&type_of(lexer, token, std::string_view(text).substr(begin, end - begin)),
          text.substr(name, last - name + 1)};
}

[[noreturn]] void fail_value(const Lexer& lexer, const Parameter& parameter, const Token& token) {
  lexer.fail(token, fmt::format("'{}' is of type {}, found {}", one_line(parameter.name, 60),
                                parameter.type, describe(token)));
}

/// Appends a value to the parameter. Booleans may have quotes, as in version 3.
void add_value(const Lexer& lexer, Parameter& parameter, const Type& type, const Token& token) {
  const bool is_text = token.kind == Token::Kind::text;
  if (type.name == "bool") {
    if (token.raw != "true" && token.raw != "false") fail_value(lexer, parameter, token);
    parameter.numbers.push_back(token.raw == "true" ? 1 : 0);
    return;
  }
  if (is_text && (type.size == 0 || type.name == "spectrum")) {
    parameter.texts.push_back(unescaped(token.raw));
    return;
  }
  const std::optional<double> value = is_text ? std::nullopt : number_of(token.raw);
  if (!value || type.size == 0) fail_value(lexer, parameter, token);
  if (type.name == "integer" && *value != std::floor(*value)) fail_value(lexer, parameter, token);
  parameter.numbers.push_back(*value);
}

void read_values(Lexer& lexer, Parameter& parameter, const Type& type) {
  const Token first = lexer.next();
  if (first.kind == Token::Kind::end || first.kind == Token::Kind::close) {
    fail_value(lexer, parameter, first);
  }
  if (first.kind != Token::Kind::open) return add_value(lexer, parameter, type, first);
  for (Token token = lexer.next(); token.kind != Token::Kind::close; token = lexer.next()) {
    if (token.kind == Token::Kind::end || token.kind == Token::Kind::open) {
      lexer.fail(token, fmt::format("expected ] after the values of '{}', found {}",
                                    one_line(parameter.name, 60), describe(token)));
    }
    add_value(lexer, parameter, type, token);
  }
}

void check_count(const Parameter& parameter, const Type& type) {
  const std::size_t count = parameter.numbers.size();
  if (count == 0 && parameter.texts.empty()) {
    throw InputError(parameter.where,
                     fmt::format("'{}' has no values", one_line(parameter.name, 60)));
  }
  if (type.size > 1 && count % type.size != 0) {
    throw InputError(parameter.where,
                     fmt::format("'{}' is of type {} and has {} numbers, which is not a multiple "
                                 "of {}",
                                 one_line(parameter.name, 60), parameter.type, count, type.size));
  }
}

}  // namespace

Parameters read_parameters(Lexer& lexer) {
  Parameters all;
  while (lexer.peek().kind == Token::Kind::text) {
    const Token token = lexer.next();
    const auto [type, name] = read_declaration(lexer, token);
    Parameter parameter{std::string(type->name), name, lexer.where(token), {}, {}};
    read_values(lexer, parameter, *type);
    check_count(parameter, *type);
    all.push_back(std::move(parameter));
  }
  return all;
}

const Parameter* find(const Parameters& parameters, std::string_view name) {
  for (auto parameter = parameters.rbegin(); parameter != parameters.rend(); ++parameter) {
    if (parameter->name == name) return &*parameter;
  }
  return nullptr;
}

}  // namespace pharos::pbrt
