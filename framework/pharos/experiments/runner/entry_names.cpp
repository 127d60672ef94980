#include <cctype>

#include <pharos/experiments/runner/entry_names.h>

namespace pharos {

bool is_entry_name(const std::string& name) {
  return !name.empty() && name.size() <= 100 && name[0] != '.' &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return c < 128 && (std::isalnum(c) != 0 || c == '.' || c == '_' || c == '+' || c == '-');
         });
}

void check_baseline(const std::string& baseline, const std::vector<std::string>& names,
                    const char* what, const ConfigNode& root) {
  if (std::find(names.begin(), names.end(), baseline) != names.end()) return;
  root.find("baseline")
      ->fail(fmt::format("expected a {}, one of {}, found '{}'{}", what, quoted_list(names),
                         baseline, suggestion(baseline, names)));
}

}  // namespace pharos
