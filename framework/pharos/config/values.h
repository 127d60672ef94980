#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <pharos/config/component.h>
#include <pharos/config/node.h>
#include <pharos/core/error.h>
#include <pharos/core/rgb.h>
#include <pharos/core/transform.h>
#include <pharos/core/vec.h>

/// Defines how each C++ type of a settings field is written in a config. Value<T> names the type,
/// reads a node (throwing InputError at its location) and writes the resolved value.
namespace pharos {

class Registry;
struct BuildContext;
struct ParameterInfo;
template <class Settings>
class Schema;

template <class T>
using Check = std::function<bool(const T&)>;

/// A value of an enum with its name in configs.
template <class E>
using EnumName = std::pair<std::string_view, E>;

/// The names of the values of an enum. Each enum that is a setting needs a specialization:
///
///     template <>
///     struct EnumNames<Color> {
///       static constexpr auto names =
///           std::to_array<EnumName<Color>>({{"red", Color::red}, {"blue", Color::blue}});
///     };
template <class E>
struct EnumNames;

template <class T>
struct Value;

/// A settings struct, which describes its own parameters.
template <class T>
concept DescribedStruct = requires(Schema<T>& schema) {
  T::describe(schema);
};

/// Returns the shortest decimal text that reads back as the same value. Returns "" if the value is
/// not finite, because a config cannot express it.
std::string number_text(double value);
std::string number_text(float value);

/// Throws InputError at `node`: "KEY must be EXPECTED, got VALUE".
[[noreturn]] void fail_range(const ConfigNode& node, const std::string& key,
                             const std::string& expected);
/// Throws InputError at `mapping` because the key of `parameter` is missing.
[[noreturn]] void fail_missing(const ConfigNode& mapping, const ParameterInfo& parameter);
/// Throws InputError at `node`: "expected EXPECTED, found WHAT IT IS".
[[noreturn]] void fail_type(const ConfigNode& node, const std::string& expected);
/// Throws InputError unless `node` is a mapping whose keys are all parameters (or `skipped_key`).
void check_keys(const ConfigNode& node, const std::vector<ParameterInfo>& parameters,
                std::string_view skipped_key = {});
/// Returns the text of the default as a node. Its location is the mapping that lacks the key.
ConfigNode default_node(const ParameterInfo& parameter, const ConfigNode& mapping);

/// Returns true if the text is a number of YAML 1.2's core schema, except for infinity and NaN.
bool is_number(std::string_view text);
/// Reads a finite number of at most `largest` in magnitude. Throws InputError otherwise.
double read_number(const ConfigNode& node, double largest = std::numeric_limits<double>::max());
/// Reads an integer in decimal, 0x or 0o notation in [low, high]. Throws InputError otherwise.
std::int64_t read_integer(const ConfigNode& node, std::int64_t low, std::int64_t high);
/// Reads a list of `count` numbers. Throws InputError, "expected EXPECTED, …", otherwise.
std::vector<float> read_floats(const ConfigNode& node, std::size_t count,
                               const std::string& expected);
ConfigNode float_list(const std::vector<float>& values);
/// Returns the index of the name that `node` gives. Throws InputError with the nearest name if
/// there is no such name.
std::size_t read_choice(const ConfigNode& node, const std::vector<std::string>& names);

/// Returns true if `holds` is true of every number in `v`: of a number itself, of the components of
/// a vector or color, of the value of an optional (if there is one) and of the items of a list.
template <class T, class Holds>
bool all_numbers(const T& v, const Holds& holds) {
  if constexpr (std::is_arithmetic_v<T>) {
    return holds(v);
  } else if constexpr (std::is_same_v<T, Rgb>) {
    return holds(v.r) && holds(v.g) && holds(v.b);
  } else if constexpr (std::is_same_v<T, Vec2>) {
    return holds(v.x) && holds(v.y);
  } else if constexpr (std::is_same_v<T, Vec3>) {
    return holds(v.x) && holds(v.y) && holds(v.z);
  } else if constexpr (requires { v.has_value(); }) {
    return !v || all_numbers(*v, holds);
  } else {
    return std::all_of(v.begin(), v.end(),
                       [&](const auto& item) { return all_numbers(item, holds); });
  }
}
/// Converts a bound to the type of the number that it limits: 0.1 as a bound of floats is the float
/// 0.1.
template <class Number>
auto bound_for(Number, double bound) {
  if constexpr (std::is_floating_point_v<Number>) {
    return static_cast<Number>(bound);
  } else {
    return bound;
  }
}
template <class T>
bool all_at_least(const T& v, double low) {
  return all_numbers(v, [low](auto x) { return x >= bound_for(x, low); });
}
template <class T>
bool all_above(const T& v, double low) {
  return all_numbers(v, [low](auto x) { return x > bound_for(x, low); });
}
template <class T>
bool all_at_most(const T& v, double high) {
  return all_numbers(v, [high](auto x) { return x <= bound_for(x, high); });
}
template <class T>
bool all_below(const T& v, double high) {
  return all_numbers(v, [high](auto x) { return x < bound_for(x, high); });
}

/// The base of types without a range of their own and with too many values to list. `default_text`
/// returns YAML text that reads as the given value. It returns "" if there is none; the field then
/// keeps its C++ initializer.
struct PlainValue {
  static std::string range() { return {}; }
  static std::vector<std::string> choices() { return {}; }
};

template <std::floating_point T>
struct Value<T> : PlainValue {
  static std::string type_name() { return "number"; }
  static std::string default_text(T v) { return number_text(v); }
  static T read(const ConfigNode& node, BuildContext&, ConfigNode& resolved) {
    const T v = static_cast<T>(read_number(node, std::numeric_limits<T>::max()));
    resolved = ConfigNode::scalar(number_text(v));
    return v;
  }
};

template <std::integral T>
struct Value<T> : PlainValue {
  static std::string type_name() { return "integer"; }
  static std::string default_text(T v) { return std::to_string(v); }
  static T read(const ConfigNode& node, BuildContext&, ConfigNode& resolved) {
    constexpr auto top = std::numeric_limits<std::int64_t>::max();
    constexpr std::int64_t high = sizeof(T) < 8 ? std::numeric_limits<T>::max() : top;
    constexpr std::int64_t low = static_cast<std::int64_t>(std::numeric_limits<T>::min());
    const T v = static_cast<T>(read_integer(node, low, high));
    resolved = ConfigNode::scalar(std::to_string(v));
    return v;
  }
};

template <>
struct Value<bool> : PlainValue {
  static std::string type_name() { return "boolean"; }
  static std::vector<std::string> choices() { return {"false", "true"}; }
  static std::string default_text(bool v) { return v ? "true" : "false"; }
  static bool read(const ConfigNode& node, BuildContext&, ConfigNode& resolved);
};

template <>
struct Value<std::string> : PlainValue {
  static std::string type_name() { return "string"; }
  static std::string default_text(const std::string& v) {
    return to_flow_yaml(ConfigNode::scalar(v));
  }
  static std::string read(const ConfigNode& node, BuildContext&, ConfigNode& resolved);
};

/// Paths are relative to the file that contains them (on the command line, to the working
/// directory). They are read as absolute paths.
template <>
struct Value<std::filesystem::path> : PlainValue {
  static std::string type_name() { return "path"; }
  static std::string default_text(const std::filesystem::path& v) {
    return v.empty() ? std::string{} : to_flow_yaml(ConfigNode::scalar(v.string()));
  }
  static std::filesystem::path read(const ConfigNode& node, BuildContext&, ConfigNode& resolved);
};

template <>
struct Value<Vec2> : PlainValue {
  static std::string type_name() { return "[x, y]"; }
  static std::string default_text(Vec2 v);
  static Vec2 read(const ConfigNode& node, BuildContext&, ConfigNode& resolved);
};

template <>
struct Value<Vec3> : PlainValue {
  static std::string type_name() { return "[x, y, z]"; }
  static std::string default_text(Vec3 v);
  static Vec3 read(const ConfigNode& node, BuildContext&, ConfigNode& resolved);
};

/// A mapping that is kept as it was written and is read later.
template <>
struct Value<ConfigNode> : PlainValue {
  static std::string type_name() { return "mapping"; }
  static std::string default_text(const ConfigNode& v) { return to_flow_yaml(v); }
  static ConfigNode read(const ConfigNode& node, BuildContext&, ConfigNode& resolved);
};

/// One number for gray, or a list of three numbers.
template <>
struct Value<Rgb> : PlainValue {
  static std::string type_name() { return "color"; }
  static std::string default_text(Rgb v);
  static Rgb read(const ConfigNode& node, BuildContext&, ConfigNode& resolved);
};

/// One step or a list of steps, applied in the order of the list: `translate: [x, y, z]`,
/// `scale: s | [x, y, z]`, `rotate: { axis: [x, y, z], degrees: a }`,
/// `look_at: { origin: …, target: …, up: … }`, `matrix: [12 or 16 numbers, row-major]`. The
/// resolved value is written as `matrix`, which reads back as the same transform in every bit.
template <>
struct Value<Transform> : PlainValue {
  static std::string type_name() { return "transform"; }
  static std::string default_text(const Transform& v);
  static Transform read(const ConfigNode& node, BuildContext&, ConfigNode& resolved);
};

template <class E>
requires std::is_enum_v<E>
struct Value<E> {
  static std::vector<std::string> choices() {
    std::vector<std::string> all;
    for (const auto& [name, value] : EnumNames<E>::names) all.emplace_back(name);
    return all;
  }
  static std::string type_name() { return "choice"; }
  static std::string range() {
    std::string text;
    for (const std::string& n : choices()) text += (text.empty() ? "" : " | ") + n;
    return text;
  }
  static std::string default_text(E v) {
    for (const auto& [name, value] : EnumNames<E>::names) {
      if (value == v) return std::string(name);
    }
    return {};
  }
  static E read(const ConfigNode& node, BuildContext&, ConfigNode& resolved) {
    const E v = EnumNames<E>::names[read_choice(node, choices())].second;
    resolved = ConfigNode::scalar(default_text(v));
    return v;
  }
};

template <class T>
struct Value<std::optional<T>> {
  static std::string type_name() { return Value<T>::type_name(); }
  static std::string range() { return Value<T>::range(); }
  static std::vector<std::string> choices() { return Value<T>::choices(); }
  static std::string default_text(const std::optional<T>& v) {
    return v ? Value<T>::default_text(*v) : std::string{};
  }
  static std::optional<T> read(const ConfigNode& node, BuildContext& context,
                               ConfigNode& resolved) {
    if (node.is_null()) return std::nullopt;
    return Value<T>::read(node, context, resolved);
  }
};

template <class T>
struct Value<std::vector<T>> : PlainValue {
  static std::string type_name() { return "list of " + Value<T>::type_name(); }
  static std::string default_text(const std::vector<T>& v) {
    std::string text;
    for (const T& item : v) text += (text.empty() ? "" : ", ") + Value<T>::default_text(item);
    return "[" + text + "]";
  }
  static std::vector<T> read(const ConfigNode& node, BuildContext& context, ConfigNode& resolved) {
    if (!node.is_sequence()) fail_type(node, "a " + type_name());
    std::vector<T> all;
    resolved = ConfigNode::sequence();
    for (const ConfigNode& item : node.items()) {
      ConfigNode item_resolved;
      all.push_back(Value<T>::read(item, context, item_resolved));
      resolved.items().push_back(std::move(item_resolved));
    }
    return all;
  }
};

template <DescribedStruct T>
struct Value<T> : PlainValue {
  static std::string type_name() { return "mapping"; }
  static std::string default_text(const T& v) { return schema().changed_text(v); }
  static T read(const ConfigNode& node, BuildContext& context, ConfigNode& resolved) {
    resolved = ConfigNode::mapping();
    return schema().read(node, context, resolved);
  }

 private:
  static const Schema<T>& schema() {
    static const Schema<T> described = [] {
      Schema<T> s;
      T::describe(s);
      return s;
    }();
    return described;
  }
};

/// A nested component. It may stay null if it is not required and has no default (`otherwise`).
template <class C>
struct Value<std::shared_ptr<const C>> : PlainValue {
  static std::string type_name() { return std::string(C::contract_name); }
  static std::string default_text(const std::shared_ptr<const C>&) { return {}; }
  static std::shared_ptr<const C> read(const ConfigNode& node, BuildContext& context,
                                       ConfigNode& resolved);
};

/// The context in which a component is built from its node.
struct BuildContext {
  const Registry& registry;
  /// A named component of a scene with its contract and name (`materials:`, `media:`, `textures:`).
  struct Named {
    std::string contract, name;
    std::shared_ptr<const Component> component;  ///< null if it could not be built
    std::optional<InputError> error;             ///< why; thrown wherever the name is used
  };
  /// A flaw of the input that is passed over.
  struct Note {
    Location where;
    std::string message;
  };
  std::vector<Named> named = {};
  /// All paths that were read, absolute and in order: the input besides the config itself.
  std::vector<std::filesystem::path> files = {};
  /// The config files that were read, in order: scenes and what they extend.
  std::vector<std::filesystem::path> sources = {};
  std::vector<Note> notes = {};
  /// The papers of all plugins that were built, in order, each once.
  std::vector<std::string> papers = {};
};

}  // namespace pharos
