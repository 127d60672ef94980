#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/config/node.h>
#include <pharos/config/values.h>
#include <pharos/core/error.h>

namespace pharos {

/// One declared parameter, as shown by `pharos plugins` and in the documentation's tables.
struct ParameterInfo {
  std::string key;
  std::string type;
  std::string unit;           ///< empty if there is none
  std::string default_value;  ///< YAML text; empty for "none"
  std::string range;          ///< such as ">= 0" or "one | all"; empty for "any"
  std::string help;           ///< one line
  bool required = false;
  std::vector<std::string> choices;  ///< all values of a choice or boolean; empty for others
};

/// The parameters of a settings struct. Each parameter is declared once:
///
///     struct Settings {
///       float radius = 1;
///       static void describe(Schema<Settings>& s) {
///         s.field("radius", &Settings::radius, "Radius").unit("scene units").above(0);
///       }
///     };
///
/// Parsing, range checks, listings, documentation and the resolved config all follow from this
/// declaration. Defaults are the values of the member initializers. A default without a YAML text,
/// such as infinity or a null component, is shown as "none" and applies if the key is left out.
template <class Settings>
class Schema {
 public:
  /// Refines the field that was just declared.
  template <class T>
  class FieldOptions {
   public:
    FieldOptions(ParameterInfo& info, std::vector<std::pair<std::string, Check<T>>>& checks)
        : info_(info), checks_(checks) {}

    FieldOptions& unit(std::string text) {
      info_.unit = std::move(text);
      return *this;
    }
    /// Makes the key mandatory.
    FieldOptions& required() {
      info_.required = true;
      info_.default_value.clear();
      return *this;
    }
    /// Sets the default as YAML text, for fields whose C++ initializer cannot express it.
    FieldOptions& otherwise(std::string yaml) {
      info_.default_value = std::move(yaml);
      return *this;
    }
    FieldOptions& at_least(double low) {
      return check(">= " + number_text(low), [low](const T& v) { return all_at_least(v, low); });
    }
    FieldOptions& above(double low) {
      return check("> " + number_text(low), [low](const T& v) { return all_above(v, low); });
    }
    FieldOptions& at_most(double high) {
      return check("<= " + number_text(high), [high](const T& v) { return all_at_most(v, high); });
    }
    FieldOptions& below(double high) {
      return check("< " + number_text(high), [high](const T& v) { return all_below(v, high); });
    }
    /// Adds any other condition. `expected` describes the values for which it holds.
    FieldOptions& check(std::string expected, Check<T> holds) {
      info_.range += (info_.range.empty() ? "" : " and ") + expected;
      checks_.emplace_back(std::move(expected), std::move(holds));
      return *this;
    }

   private:
    ParameterInfo& info_;
    std::vector<std::pair<std::string, Check<T>>>& checks_;
  };

  /// Declares the parameter `key`, stored in `member`.
  template <class T>
  FieldOptions<T> field(std::string key, T Settings::*member, std::string help) {
    auto info = std::make_shared<ParameterInfo>();
    auto checks = std::make_shared<std::vector<std::pair<std::string, Check<T>>>>();
    info->key = std::move(key);
    info->type = Value<T>::type_name();
    info->default_value = Value<T>::default_text(Settings{}.*member);
    info->range = Value<T>::range();
    info->choices = Value<T>::choices();
    info->help = std::move(help);
    const auto text = [member](const Settings& s) { return Value<T>::default_text(s.*member); };
    const auto read = [info, checks, member](Settings& settings, const ConfigNode& node,
                                             BuildContext& context, ConfigNode& resolved) {
      T value = Value<T>::read(node, context, resolved);
      for (const auto& [expected, holds] : *checks) {
        if (!holds(value)) fail_range(node, info->key, expected);
      }
      settings.*member = std::move(value);
    };
    fields_.push_back({info, text, read});
    return FieldOptions<T>(*info, *checks);
  }

  /// The same for a member of a base of the settings.
  template <class T, class Base>
  FieldOptions<T> field(std::string key, T Base::*member, std::string help) {
    return field(std::move(key), static_cast<T Settings::*>(member), std::move(help));
  }

  /// Gives settings worth trying, as a YAML mapping on one line without `type`. The conformance
  /// suites test a plugin with its defaults and with every example; the documentation shows them. A
  /// plugin that cannot be built from its defaults needs one. Examples may name the files
  /// `example.exr` (an image of all directions), `example.png`, `example.ply` and `example.txt`.
  void example(std::string yaml) { examples_.push_back(std::move(yaml)); }
  const std::vector<std::string>& examples() const { return examples_; }

  std::vector<ParameterInfo> parameters() const {
    std::vector<ParameterInfo> all;
    for (const Field& f : fields_) all.push_back(*f.info);
    return all;
  }

  /// Returns the parameters in which `settings` differs from Settings{}, as a YAML mapping on one
  /// line. This text is the default of a field that holds the struct.
  std::string changed_text(const Settings& settings) const {
    std::string text;
    for (const Field& f : fields_) {
      const std::string value = f.text(settings);
      if (value == f.text(Settings{})) continue;
      text += (text.empty() ? " " : ", ") + f.info->key + ": " + value;
    }
    return text.empty() ? "{}" : "{" + text + " }";
  }

  /// Reads the mapping `node`. Its key `skipped_key` belongs to the caller and is skipped. Throws
  /// InputError for unknown keys, or for missing required keys, wrong types and values out of
  /// range, and InputErrors if there are several. A parameter that is not required and has no
  /// default keeps its C++ initializer if it is left out or given as null. `resolved` receives the
  /// values of all other parameters.
  Settings read(const ConfigNode& node, BuildContext& context, ConfigNode& resolved,
                std::string_view skipped_key = {}) const {
    check_keys(node, parameters(), skipped_key);
    Settings settings;
    InputErrorList errors;
    for (const Field& f : fields_) {
      errors.attempt([&] { read_field(f, node, context, settings, resolved); });
    }
    errors.raise();
    return settings;
  }

 private:
  struct Field {
    std::shared_ptr<ParameterInfo> info;
    std::function<std::string(const Settings&)> text;  ///< the member as YAML
    std::function<void(Settings&, const ConfigNode&, BuildContext&, ConfigNode&)> read;
  };

  static void read_field(const Field& field, const ConfigNode& node, BuildContext& context,
                         Settings& settings, ConfigNode& resolved) {
    const ConfigNode* given = node.find(field.info->key);
    if (given == nullptr && field.info->required) fail_missing(node, *field.info);
    const bool may_stay = !field.info->required && field.info->default_value.empty();
    if (may_stay && (given == nullptr || given->is_null())) return;
    ConfigNode value;
    field.read(settings, given ? *given : default_node(*field.info, node), context, value);
    resolved.set(field.info->key, std::move(value));
  }

  std::vector<Field> fields_;
  std::vector<std::string> examples_;
};

}  // namespace pharos
