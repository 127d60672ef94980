#include <cstdlib>
#include <dlfcn.h>
#include <exception>
#include <string>

#include <doctest/doctest.h>

#include <pharos/config/module_loader.h>
#include <pharos/config/registry.h>

#include "fixtures.h"

using namespace pharos;

namespace {

/// A contract, three plugins that meet it, and one plugin that holds another.
struct Paint : Component {
  static constexpr std::string_view contract_name = "paint";
  virtual float value() const = 0;
};

struct Plain : Paint {
  struct Settings {
    float value = 1;
    static void describe(Schema<Settings>& s) {
      s.field("value", &Settings::value, "Value").at_least(0);
    }
  };
  explicit Plain(const Settings& s) : settings(s) {}
  float value() const override { return settings.value; }
  Settings settings;
};

struct Sum : Paint {
  struct Settings {
    std::vector<float> terms;
    static void describe(Schema<Settings>& s) {
      s.field("terms", &Settings::terms, "Terms").required();
    }
  };
  explicit Sum(const Settings& s) : settings(s) {}
  float value() const override {
    float sum = 0;
    for (const float term : settings.terms) sum += term;
    return sum;
  }
  Settings settings;
};

struct Twice : Paint {
  struct Settings {
    Ref<Paint> inside, over, optional;
    static void describe(Schema<Settings>& s) {
      s.field("inside", &Settings::inside, "What is doubled").required();
      s.field("over", &Settings::over, "What is added").otherwise("{ type: plain, value: 3 }");
      s.field("optional", &Settings::optional, "What may be missing");
    }
  };
  explicit Twice(const Settings& s) : settings(s) {
    if (s.inside->value() > 100) throw InputError("twice of that is too much");
  }
  float value() const override {
    const float more = settings.optional ? settings.optional->value() : 0;
    return 2 * settings.inside->value() + settings.over->value() + more;
  }
  Settings settings;
};

struct Bare : Paint {
  using Settings = NoSettings;
  explicit Bare(const Settings&) {}
  float value() const override { return 42; }
};

struct Tool : Component {
  static constexpr std::string_view contract_name = "tool";
};
struct Hammer : Tool {
  using Settings = NoSettings;
  explicit Hammer(const Settings&) {}
};

Registry paints() {
  Registry registry;
  registry.add<Plain>("plain", "One value");
  registry.add<Sum>("sum", "A sum", {"Adder: Sums. 1999"});
  registry.add<Twice>("twice", "Doubles another", {"Doubler: Twice. 2001", "Adder: Sums. 1999"});
  registry.add<Bare>("bare", "Without settings");
  registry.add<Hammer>("hammer", "A tool");
  registry.set_shorthand<Paint>("plain", "value");
  return registry;
}

struct Built {
  Ref<Paint> paint;
  std::string resolved;
  std::vector<std::string> papers;
};

Built build(const std::string& yaml, std::vector<BuildContext::Named> named = {},
            const Registry& registry = paints()) {
  BuildContext context{registry, std::move(named)};
  ConfigNode resolved;
  Built built;
  built.paint = registry.build<Paint>(parse_yaml(yaml, "a.yaml"), context, resolved);
  built.resolved = to_flow_yaml(resolved);
  built.papers = context.papers;
  return built;
}

std::string error(const std::string& yaml, std::vector<BuildContext::Named> named = {}) {
  return test::input_error([&] { build(yaml, std::move(named)); });
}

/// Returns a component that is named in the scene.
BuildContext::Named named(const std::string& name, float value) {
  return {"paint", name, std::make_shared<const Plain>(Plain::Settings{value})};
}

const std::string kNames = "'bare', 'plain', 'sum', 'twice'";

}  // namespace

TEST_CASE("what a registry knows") {
  const Registry registry = paints();
  CHECK(registry.contracts() == std::vector<std::string>{"paint", "tool"});
  CHECK(registry.names("paint") == std::vector<std::string>{"bare", "plain", "sum", "twice"});
  CHECK(registry.names("none").empty());
  CHECK(registry.find("paint", "none") == nullptr);
  const PluginInfo* info = registry.find("paint", "plain");
  REQUIRE(info != nullptr);
  CHECK(info->summary == "One value");
  CHECK(info->module == "program");
  CHECK(info->parameters.size() == 1);
}

TEST_CASE("components from mappings, names, numbers and nested ones") {
  CHECK(build("{type: plain, value: 0.5}").paint->value() == 0.5f);
  CHECK(build("plain").paint->value() == 1);
  CHECK(build("bare").paint->value() == 42);
  CHECK(build("0.25").paint->value() == 0.25f);
  CHECK(build("{type: twice, inside: 2}").paint->value() == 7);
  CHECK(build("{type: twice, inside: 2, over: {type: sum, terms: [1, 2]}, optional: bare}")
            .paint->value() == 49);
  CHECK(build("{type: twice, inside: 2, optional: ~}").paint->value() == 7);
}

TEST_CASE("resolved components name their type first and read back as the same") {
  CHECK(build("{value: 0.5, type: plain}").resolved == "{ type: plain, value: 0.5 }");
  CHECK(build("0.25").resolved == "{ type: plain, value: 0.25 }");
  CHECK(build("bare").resolved == "{ type: bare }");
  const Built built = build("{type: twice, inside: bare}");
  CHECK(built.resolved ==
        "{ type: twice, inside: { type: bare }, over: { type: plain, value: 3 } }");
  CHECK(build(built.resolved).resolved == built.resolved);
}

TEST_CASE("named components are shared, and win over plugins") {
  const Built built = build("{type: twice, inside: red}", {named("red", 5)});
  CHECK(built.paint->value() == 13);
  CHECK(built.resolved == "{ type: twice, inside: red, over: { type: plain, value: 3 } }");
  CHECK(build("bare", {named("bare", 5)}).paint->value() == 5);
  CHECK(build("7", {named("7", 5)}).paint->value() == 5);
}

TEST_CASE("a name of another contract is not meant") {
  const BuildContext::Named tool{"tool", "red", std::make_shared<const Hammer>(NoSettings{})};
  CHECK(build("red", {tool, named("red", 5)}).paint->value() == 5);
  CHECK(error("red", {tool}) == "a.yaml:1:1: error: unknown paint 'red'; known: " + kNames);
}

TEST_CASE("the papers of all plugins that were built are known, each once") {
  using Papers = std::vector<std::string>;
  CHECK(paints().find("paint", "sum")->papers == Papers{"Adder: Sums. 1999"});
  CHECK(build("7").papers.empty());
  CHECK(build("{ type: twice, inside: { type: sum, terms: [1] } }").papers ==
        Papers{"Adder: Sums. 1999", "Doubler: Twice. 2001"});
}

TEST_CASE("the word `default` stands for what a contract chose, if it chose") {
  CHECK(error("default") == "a.yaml:1:1: error: unknown paint 'default'; known: " + kNames);
  Registry registry = paints();
  registry.set_default<Paint>("bare");
  CHECK(build("default", {}, registry).paint->value() == 42);
  CHECK(build("default", {}, registry).resolved == "{ type: bare }");
  CHECK(build("default", {named("default", 5)}, registry).paint->value() == 5);
}

TEST_CASE("components know the name they were built under") {
  CHECK(build("0.5").paint->plugin_name() == "plain");
  CHECK(build("{type: twice, inside: 1}").paint->plugin_name() == "twice");
  CHECK(Plain({}).plugin_name().empty());
}

TEST_CASE("errors: names") {
  CHECK(error("{type: plian}") ==
        "a.yaml:1:8: error: unknown paint 'plian' (did you mean 'plain'?); known: " + kNames);
  CHECK(error("brae") ==
        "a.yaml:1:1: error: unknown paint 'brae' (did you mean 'bare'?); known: " + kNames);
  CHECK(error("rde", {named("red", 1), {"tool", "rd", nullptr}}) ==
        "a.yaml:1:1: error: unknown paint 'rde' (did you mean 'red'?); known: " + kNames +
            "; named in the scene: 'red'");
  CHECK(error("{value: 3}") ==
        "a.yaml:1:1: error: the key 'type' of this paint is missing; known types: " + kNames);
  CHECK(error("{type: [a]}") ==
        "a.yaml:1:8: error: expected the name of a paint, found the list [a]");
  CHECK(error("~") ==
        "a.yaml:1:1: error: expected a paint: its name or a mapping with 'type', one of " + kNames +
            ", found nothing");
}

TEST_CASE("errors: a name that a plugin had before") {
  Registry registry = paints();
  registry.renamed<Paint>("simple", "plain");
  const auto of = [&](const char* yaml) {
    return test::input_error([&] { build(yaml, {}, registry); });
  };
  CHECK(of("simple") == "a.yaml:1:1: error: the paint 'simple' is called 'plain' now");
  CHECK(of("{ type: simple }") == "a.yaml:1:9: error: the paint 'simple' is called 'plain' now");
}

TEST_CASE("errors: settings") {
  CHECK(error("{type: plain, valeu: 3}") ==
        "a.yaml:1:15: error: unknown key 'valeu' (did you mean 'value'?); known keys: 'value'");
  CHECK(error("bare: 1") ==
        "a.yaml:1:1: error: the key 'type' of this paint is missing; known types: " + kNames);
  CHECK(error("-0.5") == "a.yaml:1:1: error: value must be >= 0, got -0.5");
  CHECK(error("sum") ==
        "a.yaml:1:1: error: the required key 'terms' is missing (list of number: Terms)");
  CHECK(error("[1, 2]") == "a.yaml:1:1: error: expected a number, found the list [1, 2]");
  CHECK(error("{type: twice, inside: ~}") ==
        "a.yaml:1:23: error: expected a paint: its name or a mapping with 'type', one of " +
            kNames + ", found nothing");
}

TEST_CASE("errors of constructors get the place of what was built") {
  CHECK(error("{type: twice,\n inside: {type: twice, inside: 101}}") ==
        "a.yaml:2:10: error: twice of that is too much");
}

TEST_CASE("errors: a value where the contract has no shorthand") {
  const Registry registry = paints();
  BuildContext context{registry};
  ConfigNode resolved;
  CHECK(test::input_error(
            [&] { registry.build<Tool>(parse_yaml("3", "a.yaml"), context, resolved); }) ==
        "a.yaml:1:1: error: expected a tool: its name or a mapping with 'type', one of 'hammer', "
        "found the scalar '3'");
}

TEST_CASE("a taken name names both modules") {
  Registry registry;
  registry.set_current_module("first");
  registry.add<Plain>("plain", "");
  registry.set_current_module("second");
  CHECK(test::input_error([&] { registry.add<Bare>("plain", ""); }) ==
        "module 'second' brings the paint 'plain', which module 'first' already has");
  registry.add<Bare>("bare", "");
  CHECK(registry.find("paint", "bare")->module == "second");
}

TEST_CASE("module folders: searched ones are named, required ones must exist") {
  const test::TemporaryFolder folder;
  Registry registry = paints();
  load_modules(registry, folder / "none");
  CHECK(test::input_error([&] { build("x", {}, registry); }) ==
        "a.yaml:1:1: error: unknown paint 'x'; known: " + kNames + "; folders searched: '" +
            (folder / "none").string() + "'");
  CHECK(test::input_error_in(folder, [&] { load_modules(registry, folder / "none", true); }) ==
        "none: error: the module folder does not exist");
  folder.write("file", "");
  CHECK(test::input_error_in(folder, [&] { load_modules(registry, folder / "file"); }) ==
        "file: error: expected a folder of modules, found a file");
}

TEST_CASE("libraries that are no modules are refused by name") {
  const test::TemporaryFolder folder;
  folder.write("notes.txt", "not looked at");
  folder.write("broken.pharos.so", "not a library");
  Registry registry;
  CHECK(test::input_error_in(folder, [&] {
          load_modules(registry, folder.path());
        }).find("broken.pharos.so: error: the module cannot be loaded: ") == 0);
  std::filesystem::remove(folder / "broken.pharos.so");
  Dl_info library;
  REQUIRE(dladdr(reinterpret_cast<void*>(&std::terminate), &library) != 0);
  std::filesystem::create_symlink(library.dli_fname, folder / "other.pharos.so");
  CHECK(test::input_error_in(folder, [&] { load_modules(registry, folder.path()); }) ==
        "other.pharos.so: error: not a Pharos module: it has no 'pharos_module_abi_version'");
}

TEST_CASE("PHAROS_MODULE_PATH adds folders, each once, and they must exist") {
  const test::TemporaryFolder folder;
  const std::string path = folder.path().string();
  setenv("PHAROS_MODULE_PATH", (":" + path + "::" + path + "/.:" + path + "/none").c_str(), 1);
  const auto folders = default_module_folders();
  const std::string error = test::input_error_in(folder, [] { load_default_modules(); });
  unsetenv("PHAROS_MODULE_PATH");
  REQUIRE(folders.size() == 4);
  CHECK(folders[2] == folder.path());
  CHECK(folders[3] == folder / "none");
  CHECK(error == "none: error: the module folder does not exist");
  CHECK(default_module_folders().size() == 2);
}
