#include <algorithm>

#include <fmt/format.h>

#include <pharos/conformance/report.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::conformance {
namespace {

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\u{:04x}", static_cast<int>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

const char* name_of(Verdict verdict) {
  return verdict == Verdict::passed   ? "passed"
         : verdict == Verdict::failed ? "failed"
                                      : "not applicable";
}

}  // namespace

bool Report::passed() const {
  return std::none_of(findings.begin(), findings.end(),
                      [](const Finding& f) { return f.verdict == Verdict::failed; });
}

void finish(Report& report, double family_level) {
  std::vector<Finding*> tests;
  std::vector<double> p_values;
  for (Finding& f : report.findings) {
    if (!f.p_value) continue;
    tests.push_back(&f);
    p_values.push_back(*f.p_value);
  }
  const std::vector<double> adjusted = statistics::holm_adjusted(p_values);
  for (std::size_t i = 0; i < tests.size(); ++i) {
    tests[i]->adjusted_p = adjusted[i];
    if (adjusted[i] <= family_level) tests[i]->verdict = Verdict::failed;
  }
}

std::set<std::string> failed_checks(const Report& report) {
  std::set<std::string> names;
  for (const Finding& f : report.findings) {
    if (f.verdict == Verdict::failed) names.insert(f.check);
  }
  return names;
}

std::string to_json(const Report& report) {
  std::string text = "[";
  for (const Finding& f : report.findings) {
    text += text.size() > 1 ? ",\n " : "\n ";
    text +=
        fmt::format(R"({{"contract": {}, "plugin": {}, "module": {}, "settings": {}, "check": {}, )"
                    R"("verdict": {}, "p_value": {}, "adjusted_p": {}, "detail": {}}})",
                    json_text(f.contract), json_text(f.plugin), json_text(f.module),
                    json_text(f.settings), json_text(f.check), json_text(name_of(f.verdict)),
                    f.p_value ? fmt::format("{:.6g}", *f.p_value) : "null",
                    f.p_value ? fmt::format("{:.6g}", f.adjusted_p) : "null", json_text(f.detail));
  }
  return text + "\n]\n";
}

}  // namespace pharos::conformance
