#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace pharos::mitsuba {

/// The variables of a scene: `$name` in the value of an attribute stands for the text that the
/// caller or, before it, a tag `default` gave that name.
class Variables {
 public:
  /// `given` by the caller: they come before the scene's defaults.
  explicit Variables(std::map<std::string, std::string> given);

  /// What the scene gives a name that has no value yet. Throws InputError (not located) for names
  /// that are empty or longer than 100 letters.
  void give_default(const std::string& name, const std::string& value);

  /// The text with variables replaced, once: `$` in their values is not looked at again. The
  /// longest name that fits is taken, as Mitsuba does. `\$` is a dollar; so is one before `[`,
  /// which Mitsuba 0.x leaves to the labels of films. Throws InputError (not located) for names
  /// without a value, and when texts grow without bound.
  std::string replace_in(std::string_view text);

  /// Throws InputError (not located) for a name that was given but that the scene has no use for.
  void check_use() const;

 private:
  /// Length of the longest known name that `text` begins with; 0 when there is none.
  std::size_t known_name(std::string_view text) const;
  void append(std::string& to, const std::string& value);
  [[noreturn]] void fail_unknown(std::string_view rest) const;
  std::vector<std::string> names() const;

  std::map<std::string, std::string> values_;
  std::set<std::string> unused_;  ///< names given by the caller that the scene did not mention yet
  std::size_t longest_name_ = 0;
  std::size_t replaced_bytes_ = 0;
};

}  // namespace pharos::mitsuba
