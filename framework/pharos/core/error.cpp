#include <algorithm>
#include <unistd.h>
#include <utility>
#include <vector>

#include <pharos/core/confinement.h>
#include <pharos/core/error.h>

namespace pharos {
namespace {

/// Returns the number of insertions, deletions, replacements and swaps of neighbors that turn `a`
/// into `b`. No letter is edited twice (the "optimal string alignment" form of the
/// Damerau-Levenshtein distance).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = last;
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

}  // namespace

Error::Error(const std::string& message)
    : std::runtime_error(one_line(message, std::string::npos)) {}

InputErrors::InputErrors(std::vector<InputError> all)
    : InputError(all.front()),
      all_(std::make_shared<const std::vector<InputError>>(std::move(all))) {}

void InputErrorList::raise() const {
  if (errors_.size() == 1) throw InputError(errors_.front());
  if (!errors_.empty()) throw InputErrors(errors_);
}

void InputErrorList::add(const InputError& error) {
  constexpr std::size_t kMost = 100;  // bounds the time and memory that a file of errors takes
  const std::string_view message = error.what();
  const bool is_known =
      std::any_of(errors_.begin(), errors_.end(),
                  [message](const InputError& kept) { return message == kept.what(); });
  if (!is_known) errors_.push_back(error);
  if (errors_.size() == kMost) raise();
}

std::string Location::to_string() const {
  std::string text = file;
  if (line > 0) text += (text.empty() ? "line " : ":") + std::to_string(line);
  if (line > 0 && column > 0) text += ":" + std::to_string(column);
  return text;
}

std::string suggestion(std::string_view wrong, std::span<const std::string> known) {
  const std::size_t limit = std::max<std::size_t>(1, wrong.size() / 3);
  const std::string* nearest = nullptr;
  std::size_t nearest_distance = limit + 1;
  for (const std::string& name : known) {
    const std::size_t longer = std::max(name.size(), wrong.size());
    if (longer - std::min(name.size(), wrong.size()) >= nearest_distance) continue;
    const std::size_t distance = edit_distance(wrong, name);
    const bool shares_a_letter = distance < longer;
    if (distance < nearest_distance && shares_a_letter) {
      nearest = &name;
      nearest_distance = distance;
    }
  }
  return nearest == nullptr ? "" : " (did you mean '" + *nearest + "'?)";
}

std::string file_suggestion(const std::filesystem::path& missing) {
  const auto folder = missing.has_parent_path() ? missing.parent_path() : ".";
  std::vector<std::string> names;
  std::error_code failed;
  for (std::filesystem::directory_iterator i(folder, failed), end; !failed && i != end;
       i.increment(failed)) {
    names.push_back(i->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return suggestion(missing.filename().string(), names);
}

std::string access_problem(const std::filesystem::path& path) {
  using std::filesystem::file_type;
  if (path.empty()) return "expected the name of a file, found an empty one";
  std::error_code failed;
  switch (std::filesystem::status(path, failed).type()) {
    case file_type::regular:
      return access(path.c_str(), R_OK) == 0 ? "" : "the file may not be read";
    case file_type::not_found:
      return "no such file" + file_suggestion(path);
    case file_type::directory:
      return "expected a file, found a folder";
    case file_type::none:
      return "the file cannot be reached: " + failed.message();
    default:
      return "expected a file, found a pipe or device";
  }
}

std::string file_problem(const std::filesystem::path& path) {
  const std::string problem = access_problem(path);
  return problem.empty() ? confinement_problem(path) : problem;
}

std::string one_line(std::string_view text, std::size_t max_length) {
  std::string line;
  for (const char c : text) {
    const bool is_break = c == '\n' || c == '\r' || c == '\t';
    const bool is_control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    line += is_break ? ' ' : is_control ? '?' : c;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  if (line.size() <= max_length) return line;
  std::size_t end = max_length;
  while (end > 0 && continues_character(line[end])) --end;
  return line.substr(0, end) + "…";
}

std::string quoted_list(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text.empty() ? "none" : text;
}

}  // namespace pharos
