// The cases in which a plugin is tested, and the content of a report.

#include <filesystem>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include <pharos/conformance/check.h>
#include <pharos/conformance/conformance.h>
#include <pharos/core/error.h>
#include <pharos/scene/texture.h>

namespace pharos {
namespace {

using conformance::check_plugins;
using conformance::Finding;
using conformance::Report;
using conformance::Verdict;

using Names = std::set<std::string>;

enum class Mode { plain, odd };

}  // namespace

template <>
struct EnumNames<Mode> {
  static constexpr auto names =
      std::to_array<EnumName<Mode>>({{"plain", Mode::plain}, {"odd", Mode::odd}});
};

namespace {

/// A texture with a required file, a choice and a boolean.
class FileTexture final : public Texture {
 public:
  struct Settings {
    std::filesystem::path file;
    Mode mode = Mode::plain;
    bool dark = false;
    static void describe(Schema<Settings>& s) {
      s.field("file", &Settings::file, "Any file").required();
      s.field("mode", &Settings::mode, "Fails if odd");
      s.field("dark", &Settings::dark, "Black");
      if (stated) s.example("{ file: example.png }");
    }
    static inline bool stated = true;
  };
  explicit FileTexture(const Settings& settings) : settings_(settings) {
    if (!std::filesystem::exists(settings.file)) throw InputError("there is no such file");
  }
  Rgb value_at(const SurfacePoint&) const override {
    return Rgb(settings_.mode == Mode::odd ? 2.0f : settings_.dark ? 0.0f : 1.0f);
  }
  Rgb maximum() const override { return Rgb(1); }
  Rgb average() const override { return Rgb(settings_.dark ? 0.0f : 1.0f); }

 private:
  Settings settings_;
};

Report file_texture_report(bool stated) {
  FileTexture::Settings::stated = stated;
  Registry registry;
  registry.add<FileTexture>("file", "Needs a file");
  return check_plugins(registry, {.names = {"texture"}});
}

TEST_CASE("conformance: examples, choices and switches are cases") {
  const Report report = file_texture_report(true);
  Names cases;
  for (const Finding& f : report.findings) {
    cases.insert(f.settings);
    const bool odd = f.settings.find("odd") != std::string::npos;
    const bool fails = odd && (f.check == "range" || f.check == "average");
    CHECK_MESSAGE((f.verdict == Verdict::failed) == fails, f.settings << ": " << f.check);
  }
  CHECK(cases == Names{"", "{ file: example.png }", "{ file: example.png, mode: odd }",
                       "{ file: example.png, dark: true }"});
}

TEST_CASE("conformance: a plugin without a case that can be built must state an example") {
  const Report report = file_texture_report(false);
  REQUIRE(report.findings.size() == 1);
  CHECK(report.findings[0].check == "buildable");
  CHECK(report.findings[0].verdict == Verdict::failed);
  CHECK(report.findings[0].detail.find("s.example(") != std::string::npos);
}

TEST_CASE("conformance: unknown names are input errors with the nearest one") {
  Registry registry;
  registry.add<FileTexture>("faulty", "A texture");
  CHECK_THROWS_WITH_AS(check_plugins(registry, {.names = {"fualty"}}),
                       doctest::Contains("did you mean 'faulty'?"), InputError);
  CHECK_THROWS_AS(check_plugins(registry, {.module = "none"}), InputError);
}

TEST_CASE("conformance: a selection that holds no plugin is an input error") {
  Registry registry;
  registry.add<FileTexture>("file", "A texture");
  CHECK_THROWS_WITH_AS(check_plugins(registry, {.names = {"bsdf"}}),
                       doctest::Contains("there is no"), InputError);
  CHECK_THROWS_AS(check_plugins({}), InputError);
}

TEST_CASE("conformance: a check that asked nothing fails unless there is a reason") {
  conformance::Check silent("silent");
  CHECK(silent.finding().verdict == Verdict::failed);
  silent.not_applicable("there is nothing to see");
  CHECK(silent.finding().verdict == Verdict::not_applicable);
  silent.expect(true, [] { return ""; });
  CHECK(silent.finding().verdict == Verdict::passed);
}

}  // namespace
}  // namespace pharos
