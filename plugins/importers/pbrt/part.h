#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include <pharos/config/node.h>
#include <pharos/core/error.h>

#include "../shared/nodes.h"
#include "scene.h"
#include "statements.h"

namespace pharos::pbrt {

using importing::plugin_node, importing::rgb_node, importing::text_node, importing::transform_node,
    importing::triple_node;

/// Returns a number with the digits of a float, as pbrt computes with floats.
ConfigNode number_node(double value, const Location& where);

/// Returns one number for gray colors, and otherwise a list of three.
ConfigNode color_node(const Color& color, const Location& where);

/// A statement during mapping. Returns its parameters and records which were requested, so that
/// finish() can note the unused ones. All functions throw InputError, located at the parameter, if
/// it is present but has another type.
class Part {
 public:
  /// `kind` is the target of `Attribute` ("shape"), whose parameters stand where the statement does
  /// not state them; empty: none.
  Part(Scene& scene, const Statement& statement, const std::string& kind = "");

  Scene& scene() { return scene_; }
  const Statement& statement() const { return statement_; }
  const Location& where() const { return statement_.where; }
  /// Returns the place of a parameter, or of the statement without it.
  const Location& where(std::string_view name) const;
  /// Returns a mapping with this `type`, located at the statement.
  ConfigNode node(const char* type) const { return plugin_node(type, where()); }

  /// Returns the parameter without marking it as read; null if there is none.
  const Parameter* find(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }
  std::optional<double> number(std::string_view name);
  double number(std::string_view name, double otherwise) {
    return number(name).value_or(otherwise);
  }
  /// Returns a number that must be above 0.
  double positive(std::string_view name, double otherwise);
  int integer(std::string_view name, int otherwise);
  bool flag(std::string_view name, bool otherwise);
  std::optional<std::string> text(std::string_view name);
  std::optional<Vec3> point(std::string_view name);
  /// Returns all numbers of a parameter; empty if it is missing. Throws InputError if their count
  /// is not `count`.
  std::vector<double> numbers(std::string_view name, std::size_t count);
  std::optional<Color> color(std::string_view name, ColorRole role);

  /// Returns a color, or the name of a texture of this kind. Its values should be at most `most`; a
  /// color is limited to it with a note.
  ConfigNode texture_or(std::string_view name, double otherwise, double most = 1,
                        TextureKind kind = TextureKind::spectrum);
  /// Returns a number, or the average of a texture with a note.
  double average(std::string_view name, double otherwise);
  /// Returns the node of the file that a parameter names. Throws InputError if it is missing.
  ConfigNode file(std::string_view name = "filename");

  /// Adds a note at the statement; it begins with the word and the type of the statement.
  void note(const std::string& message);
  /// Marks parameters as read that make no difference in Pharos.
  void ignore(std::initializer_list<std::string_view> names);
  /// Marks all parameters as read.
  void ignore_all();
  /// Notes the parameters that were never requested.
  void finish();

 private:
  /// Returns the place of a parameter. Of several of the same name the last one counts.
  std::optional<std::size_t> place_of(std::string_view name) const;
  const Parameter* take(std::string_view name);
  [[noreturn]] static void fail_kind(const Parameter& parameter, const char* expected);

  Scene& scene_;
  const Statement& statement_;
  std::vector<const Parameter*> parameters_;  ///< first the parameters of Attribute
  std::vector<bool> is_read_;
};

/// Returns the entry of `table` for the type of the statement. Throws InputError with the nearest
/// type if there is none.
template <class Mapper>
const Mapper& mapper_of(const std::map<std::string_view, Mapper>& table,
                        const Statement& statement) {
  const auto found = table.find(statement.type());
  if (found != table.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [type, mapper] : table) known.emplace_back(type);
  throw InputError(
      statement.where,
      fmt::format("unknown {} '{}'{}; known: {}", statement.word, one_line(statement.type(), 60),
                  suggestion(statement.type(), known), quoted_list(known)));
}

}  // namespace pharos::pbrt
