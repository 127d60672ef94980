#include "variables.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <pharos/core/error.h>

namespace pharos::mitsuba {
namespace {

/// Limits for texts: defaults may use earlier defaults several times, so texts could double with
/// each line.
constexpr std::size_t kMostBytesInText = std::size_t{1} << 20;
constexpr std::size_t kMostBytesReplaced = std::size_t{64} << 20;

/// The cost of looking up a name, so that empty values count too.
constexpr std::size_t kBytesPerReplacement = 64;
constexpr std::size_t kLongestName = 100;
constexpr std::string_view kNameLetters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";

}  // namespace

Variables::Variables(std::map<std::string, std::string> given) : values_(std::move(given)) {
  for (const auto& [name, value] : values_) {
    unused_.insert(name);
    longest_name_ = std::max(longest_name_, name.size());
  }
}

void Variables::give_default(const std::string& name, const std::string& value) {
  if (name.empty() || name.size() > kLongestName) {
    throw InputError(fmt::format("expected a name of 1 to {} letters", kLongestName));
  }
  unused_.erase(name);
  if (values_.emplace(name, value).second) longest_name_ = std::max(longest_name_, name.size());
}

std::size_t Variables::known_name(std::string_view text) const {
  for (std::size_t length = std::min(text.size(), longest_name_); length > 0; --length) {
    if (values_.contains(std::string(text.substr(0, length)))) return length;
  }
  return 0;
}

std::string Variables::replace_in(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i + 1);
    if (text[i] == '\\' && rest.starts_with('$')) {
      result += '$';
      ++i;
    } else if (text[i] != '$' || rest.starts_with('[')) {
      result += text[i];
    } else if (const std::size_t length = known_name(rest); length > 0) {
      const std::string name(rest.substr(0, length));
      unused_.erase(name);
      append(result, values_.at(name));
      i += length;
    } else {
      fail_unknown(rest);
    }
  }
  return result;
}

void Variables::append(std::string& to, const std::string& value) {
  to += value;
  replaced_bytes_ += value.size() + kBytesPerReplacement;
  if (to.size() > kMostBytesInText || replaced_bytes_ > kMostBytesReplaced) {
    throw InputError(
        "expected at most 1 MiB of text in an attribute and 64 MiB in all that "
        "come from variables");
  }
}

void Variables::fail_unknown(std::string_view rest) const {
  const std::string_view name = rest.substr(0, rest.find_first_not_of(kNameLetters));
  if (name.empty()) throw InputError("expected the name of a variable after '$', or '\\$'");
  throw InputError(
      fmt::format("unknown variable '${}'{}", one_line(name, 60), suggestion(name, names())));
}

void Variables::check_use() const {
  if (unused_.empty()) return;
  std::vector<std::string> used;
  for (const std::string& name : names()) {
    if (!unused_.contains(name)) used.push_back(name);
  }
  const std::string& name = *unused_.begin();
  throw InputError(fmt::format("the scene has no variable '{}'{}", name, suggestion(name, used)));
}

std::vector<std::string> Variables::names() const {
  std::vector<std::string> all;
  for (const auto& [name, value] : values_) all.push_back(name);
  return all;
}

}  // namespace pharos::mitsuba
