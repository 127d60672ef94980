#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <pharos/config/schema.h>
#include <pharos/config/values.h>

namespace pharos {
namespace {

/// Parses all of `text` in `base`. `failed` distinguishes malformed text (invalid_argument) from
/// overflow.
template <class Number>
Number parse_whole(std::string_view text, int base, std::errc& failed) {
  Number value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  failed = end == text.data() + text.size() ? error : std::errc::invalid_argument;
  return value;
}

/// Returns 16 for texts that begin with 0x, 8 for texts that begin with 0o, else 10.
int base_of(std::string_view text) {
  const std::string_view prefix = text.substr(0, 2);
  return prefix == "0x" ? 16 : prefix == "0o" ? 8 : 10;
}

std::string_view without_plus(std::string_view text) {
  const bool signed_number = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return signed_number ? text.substr(1) : text;
}

std::int64_t parse_integer(std::string_view text, std::errc& failed) {
  const int base = base_of(text);
  const std::string_view digits = base == 10 ? without_plus(text) : text.substr(2);
  const bool doubly_signed = base != 10 && !digits.empty() && digits[0] == '-';
  const auto value = parse_whole<std::int64_t>(digits, base, failed);
  if (doubly_signed) failed = std::errc::invalid_argument;
  return value;
}

/// Parses a number in the notation of YAML 1.2's core schema.
double parse_number(std::string_view text, std::errc& failed) {
  if (base_of(text) != 10) return static_cast<double>(parse_integer(text, failed));
  const std::string_view number = without_plus(text);
  const std::string_view magnitude = number.substr(number.substr(0, 1) == "-" ? 1 : 0);
  const std::size_t first = magnitude.substr(0, 1) == "." ? 1 : 0;
  const bool is_digit =
      first < magnitude.size() && magnitude[first] >= '0' && magnitude[first] <= '9';
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  const bool whole = is_digit && end == number.data() + number.size();
  failed = whole ? error : std::errc::invalid_argument;
  return value;
}

bool is_infinity_or_nan(std::string_view text) {
  std::string word;
  for (const char c : text) {
    if (c != '+' && c != '-' && c != '.') word += static_cast<char>(c | 0x20);
  }
  return word == "inf" || word == "infinity" || word == "nan";
}

std::vector<std::string> keys_of(const std::vector<ParameterInfo>& parameters) {
  std::vector<std::string> keys;
  for (const ParameterInfo& p : parameters) keys.push_back(p.key);
  return keys;
}

template <class Number>
std::string finite_text(Number value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string{};
}

ConfigNode color_node(Rgb v) {
  if (v.r == v.g && v.g == v.b) return ConfigNode::scalar(number_text(v.r));
  return float_list({v.r, v.g, v.b});
}

}  // namespace

std::string number_text(double value) {
  return finite_text(value);
}

std::string number_text(float value) {
  return finite_text(value);
}

void fail_range(const ConfigNode& node, const std::string& key, const std::string& expected) {
  const std::string got = node.is_scalar() ? node.text() : to_flow_yaml(node);
  node.fail(fmt::format("{} must be {}, got {}", key, expected, one_line(got, 60)));
}

void fail_missing(const ConfigNode& mapping, const ParameterInfo& parameter) {
  mapping.fail(fmt::format("the required key '{}' is missing ({}: {})", parameter.key,
                           parameter.type, parameter.help));
}

void fail_type(const ConfigNode& node, const std::string& expected) {
  node.fail(fmt::format("expected {}, found {}", expected, node.describe()));
}

void check_keys(const ConfigNode& node, const std::vector<ParameterInfo>& parameters,
                std::string_view skipped_key) {
  const std::vector<std::string> keys = keys_of(parameters);
  if (!node.is_mapping()) fail_type(node, "a mapping with keys from " + quoted_list(keys));
  InputErrorList errors;
  for (const ConfigNode::Entry& entry : node.entries()) {
    const bool known =
        entry.key == skipped_key || std::find(keys.begin(), keys.end(), entry.key) != keys.end();
    if (known) continue;
    errors.add(
        {entry.key_where, fmt::format("unknown key '{}'{}; known keys: {}", one_line(entry.key, 60),
                                      suggestion(entry.key, keys), quoted_list(keys))});
  }
  errors.raise();
}

ConfigNode default_node(const ParameterInfo& parameter, const ConfigNode& mapping) {
  return parse_yaml_at(parameter.default_value, mapping.where());
}

bool is_number(std::string_view text) {
  std::errc failed{};
  parse_number(text, failed);
  return failed != std::errc::invalid_argument;
}

double read_number(const ConfigNode& node, double largest) {
  std::errc failed{};
  const double value = parse_number(node.text(), failed);
  if (is_infinity_or_nan(node.text())) fail_type(node, "a finite number");
  if (failed == std::errc::invalid_argument) fail_type(node, "a number");
  if (failed == std::errc::result_out_of_range || std::abs(value) > largest) {
    fail_type(node, fmt::format("a number of magnitude up to {:.4g}", largest));
  }
  return value;
}

std::int64_t read_integer(const ConfigNode& node, std::int64_t low, std::int64_t high) {
  std::errc failed{};
  const std::int64_t value = parse_integer(node.text(), failed);
  if (failed == std::errc::invalid_argument) fail_type(node, "an integer");
  if (failed == std::errc::result_out_of_range || value < low || value > high) {
    fail_type(node, fmt::format("an integer from {} to {}", low, high));
  }
  return value;
}

std::vector<float> read_floats(const ConfigNode& node, std::size_t count,
                               const std::string& expected) {
  if (!node.is_sequence() || node.items().size() != count) fail_type(node, expected);
  std::vector<float> values;
  for (const ConfigNode& item : node.items()) {
    values.push_back(static_cast<float>(read_number(item, std::numeric_limits<float>::max())));
  }
  return values;
}

ConfigNode float_list(const std::vector<float>& values) {
  ConfigNode list = ConfigNode::sequence();
  for (const float v : values) list.items().push_back(ConfigNode::scalar(number_text(v)));
  return list;
}

std::size_t read_choice(const ConfigNode& node, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), node.text());
  if (node.is_scalar() && found != names.end()) {
    return static_cast<std::size_t>(found - names.begin());
  }
  const std::string near = node.is_scalar() ? suggestion(node.text(), names) : "";
  node.fail(
      fmt::format("expected one of {}, found {}{}", quoted_list(names), node.describe(), near));
}

bool Value<bool>::read(const ConfigNode& node, BuildContext&, ConfigNode& resolved) {
  const bool known = node.is_scalar() && (node.text() == "true" || node.text() == "false");
  if (!known) fail_type(node, "true or false");
  resolved = ConfigNode::scalar(node.text());
  return node.text() == "true";
}

std::string Value<std::string>::read(const ConfigNode& node, BuildContext&, ConfigNode& resolved) {
  if (!node.is_scalar()) fail_type(node, "a string");
  resolved = ConfigNode::scalar(node.text());
  return node.text();
}

std::filesystem::path Value<std::filesystem::path>::read(const ConfigNode& node,
                                                         BuildContext& context,
                                                         ConfigNode& resolved) {
  if (!node.is_scalar() || node.text().empty()) fail_type(node, "a path");
  std::filesystem::path folder;
  const bool stands_in_file = node.where().line > 0;
  if (stands_in_file) folder = std::filesystem::path(node.where().file).parent_path();
  const auto path = std::filesystem::absolute(folder / node.text()).lexically_normal();
  resolved = ConfigNode::scalar(path.string());
  context.files.push_back(path);
  return path;
}

ConfigNode Value<ConfigNode>::read(const ConfigNode& node, BuildContext&, ConfigNode& resolved) {
  if (!node.is_mapping()) fail_type(node, "a mapping");
  return resolved = node;
}

std::string Value<Vec2>::default_text(Vec2 v) {
  return to_flow_yaml(float_list({v.x, v.y}));
}

Vec2 Value<Vec2>::read(const ConfigNode& node, BuildContext&, ConfigNode& resolved) {
  const std::vector<float> v = read_floats(node, 2, "a list of 2 numbers [x, y]");
  resolved = float_list(v);
  return {v[0], v[1]};
}

std::string Value<Vec3>::default_text(Vec3 v) {
  return to_flow_yaml(float_list({v.x, v.y, v.z}));
}

Vec3 Value<Vec3>::read(const ConfigNode& node, BuildContext&, ConfigNode& resolved) {
  const std::vector<float> v = read_floats(node, 3, "a list of 3 numbers [x, y, z]");
  resolved = float_list(v);
  return {v[0], v[1], v[2]};
}

std::string Value<Rgb>::default_text(Rgb v) {
  return to_flow_yaml(color_node(v));
}

Rgb Value<Rgb>::read(const ConfigNode& node, BuildContext&, ConfigNode& resolved) {
  const std::string expected = "a color: a number or a list of 3 numbers [r, g, b]";
  Rgb color;
  if (node.is_scalar() && (is_number(node.text()) || is_infinity_or_nan(node.text()))) {
    color = Rgb(static_cast<float>(read_number(node, std::numeric_limits<float>::max())));
  } else {
    const std::vector<float> v = read_floats(node, 3, expected);
    color = Rgb(v[0], v[1], v[2]);
  }
  resolved = color_node(color);
  return color;
}

/// The steps of which a transform consists.
namespace {

struct Rotation {
  Vec3 axis;
  float degrees = 0;

  static void describe(Schema<Rotation>& s) {
    s.field("axis", &Rotation::axis, "Axis through the origin, of any length").required();
    s.field("degrees", &Rotation::degrees, "Angle, counter-clockwise").unit("degrees").required();
  }
};

struct View {
  Vec3 origin, target, up{0, 1, 0};

  static void describe(Schema<View>& s) {
    s.field("origin", &View::origin, "Position of the local origin").required();
    s.field("target", &View::target, "Point at which local +z points").required();
    s.field("up", &View::up, "Direction near to local +y");
  }
};

Transform read_matrix(const ConfigNode& node) {
  const bool four_rows = node.items().size() == 16;
  const std::vector<float> v =
      read_floats(node, four_rows ? 16 : 12, "a list of 12 or 16 numbers, row by row");
  if (four_rows && !(v[12] == 0 && v[13] == 0 && v[14] == 0 && v[15] == 1)) {
    node.fail("the last row of a 4x4 matrix must be 0, 0, 0, 1");
  }
  Transform::Matrix matrix;
  for (std::size_t i = 0; i < 12; ++i) matrix[i / 4][i % 4] = v[i];
  return Transform(matrix);
}

Transform read_step(const ConfigNode& step, BuildContext& context) {
  if (!step.is_mapping() || step.entries().size() != 1) {
    fail_type(step, "one step such as { translate: [x, y, z] } or a list of such steps");
  }
  const auto& [key, key_where, value] = step.entries().front();
  const std::vector<std::string> names{"translate", "scale", "rotate", "look_at", "matrix"};
  const std::size_t kind = read_choice(ConfigNode::scalar(key, key_where), names);
  ConfigNode resolved;
  switch (kind) {
    case 0:
      return Transform::translate(Value<Vec3>::read(value, context, resolved));
    case 1: {
      if (value.is_sequence()) return Transform::scale(Value<Vec3>::read(value, context, resolved));
      const float s = Value<float>::read(value, context, resolved);
      return Transform::scale({s, s, s});
    }
    case 2: {
      const Rotation r = Value<Rotation>::read(value, context, resolved);
      return Transform::rotate(r.axis, r.degrees);
    }
    case 3: {
      const View v = Value<View>::read(value, context, resolved);
      return Transform::look_at(v.origin, v.target, v.up);
    }
    default:
      return read_matrix(value);
  }
}

ConfigNode matrix_node(const Transform& transform) {
  std::vector<float> elements;
  for (const auto& row : transform.matrix())
    elements.insert(elements.end(), row.begin(), row.end());
  ConfigNode node = ConfigNode::mapping();
  node.set("matrix", float_list(elements));
  return node;
}

}  // namespace

std::string Value<Transform>::default_text(const Transform& v) {
  return v.matrix() == Transform().matrix() ? "[]" : to_flow_yaml(matrix_node(v));
}

Transform Value<Transform>::read(const ConfigNode& node, BuildContext& context,
                                 ConfigNode& resolved) {
  const std::vector<ConfigNode> one{node};
  Transform total;
  for (const ConfigNode& step : node.is_sequence() ? node.items() : one) {
    try {
      total = read_step(step, context) * total;
    } catch (const InputError& e) {
      if (e.located()) throw;
      step.fail(e.what());
    }
  }
  resolved = matrix_node(total);
  return total;
}

}  // namespace pharos
