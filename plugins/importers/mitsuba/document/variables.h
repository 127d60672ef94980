#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace pharos::mitsuba {

/// The variables of a scene. `$name` in the value of an attribute stands for the text that the
/// caller or an earlier tag `default` assigned to the name. The caller's values take precedence.
class Variables {
 public:
  /// `given` are the caller's values, which take precedence over the scene's defaults.
  explicit Variables(std::map<std::string, std::string> given);

  /// Assigns the scene's default to a name without a value. Throws InputError (not located) for
  /// names that are empty or longer than 100 letters.
  void give_default(const std::string& name, const std::string& value);

  /// Returns the text with its variables replaced, once: `$` in their values is not replaced again.
  /// The longest matching name is used, as in Mitsuba. `\$` is a dollar sign, and so is `$` before
  /// `[`, which Mitsuba 0.x reserves for the labels of films. Throws InputError (not located) for
  /// names without a value, and if texts grow beyond the limits.
  std::string replace_in(std::string_view text);

  /// Throws InputError (not located) if the caller gave a name that the scene does not use.
  void check_use() const;

 private:
  /// Returns the length of the longest known name at the front of `text`; 0 if there is none.
  std::size_t known_name(std::string_view text) const;
  void append(std::string& to, const std::string& value);
  [[noreturn]] void fail_unknown(std::string_view rest) const;
  std::vector<std::string> names() const;

  std::map<std::string, std::string> values_;
  std::set<std::string> unused_;  ///< names given by the caller that the scene has not mentioned
                                  ///< yet
  std::size_t longest_name_ = 0;
  std::size_t replaced_bytes_ = 0;
};

}  // namespace pharos::mitsuba
