#include <filesystem>
#include <map>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/core/log.h>
#include <pharos/rendering/render_config.h>
#include <pharos/rendering/scene_import.h>

#include "commands.h"
#include "config_options.h"
#include "import_notes.h"

namespace pharos {
namespace {

namespace fs = std::filesystem;

struct ImportOptions {
  std::string scene, output;
  bool report = false, strict = false, quiet = false;
  ConfineOption confine;
};

/// The files that a scene names. Each gets a unique name within the output folder.
class CopiedFiles {
 public:
  CopiedFiles(const std::vector<fs::path>& files, const fs::path& source) {
    std::set<fs::path> taken;
    for (const fs::path& file : files) {
      if (names_.contains(file.string())) continue;
      fs::path name = file.lexically_relative(source);
      // Files outside the source folder go to a separate folder.
      if (name.empty() || *name.begin() == "..") name = fs::path("files") / file.filename();
      for (int i = 2; !taken.insert(name).second; ++i) {
        name.replace_filename(
            fmt::format("{}-{}{}", file.stem().string(), i, file.extension().string()));
      }
      names_[file.string()] = name;
    }
  }

  /// Replaces every path of a file by its name in the folder.
  void rename(ConfigNode& node) const {
    if (node.is_scalar() && !node.text().empty()) {
      const fs::path folder = fs::path(node.where().file).parent_path();
      const auto entry =
          names_.find(fs::absolute(folder / node.text()).lexically_normal().string());
      if (entry != names_.end()) node = ConfigNode::scalar(entry->second.generic_string());
    }
    for (ConfigNode& item : node.items()) rename(item);
    for (ConfigNode::Entry& entry : node.entries()) rename(entry.value);
  }

  void copy_to(const fs::path& folder) const {
    for (const auto& [file, name] : names_) {
      fs::create_directories((folder / name).parent_path());
      fs::copy_file(file, folder / name);
    }
  }

 private:
  std::map<std::string, fs::path> names_;
};

/// A folder that is filled under a temporary name and renamed when it is complete.
class NewFolder {
 public:
  explicit NewFolder(const fs::path& path) : path_(path), temporary_(path.string() + ".partial") {
    std::error_code failed;
    if (fs::exists(path, failed) &&
        !(fs::is_directory(path, failed) && fs::is_empty(path, failed))) {
      throw InputError(fmt::format("{}: error: expected a folder that is empty or not there yet",
                                   path.string()));
    }
    fs::remove_all(temporary_, failed);
    if (!fs::create_directories(temporary_, failed)) {
      throw InputError(fmt::format("{}: error: the folder cannot be made", path.string()));
    }
  }
  ~NewFolder() {
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  const fs::path& path() const { return temporary_; }
  void finish() const {
    fs::remove(path_);
    fs::rename(temporary_, path_);
  }

 private:
  fs::path path_, temporary_;
};

/// Prints how every object of the file was mapped.
void print_report(const Import& import) {
  for (const ImportedObject& object : import.objects) {
    fmt::print("{}: {} -> {}\n", object.where.to_string(), object.what, object.stands);
  }
}

/// Writes `scene.yaml`, the files that it names, and `render.yaml`.
void write_scene(ConfigNode config, const LoadedConfig& loaded, const ImportOptions& options) {
  // A trailing slash means the same folder.
  const fs::path output = (fs::path(options.output) / "").parent_path();
  const NewFolder folder(output);
  const CopiedFiles files(loaded.files,
                          fs::absolute(options.scene).lexically_normal().parent_path());
  files.copy_to(folder.path());
  files.rename(config);
  const std::string head =
      fmt::format("# Imported from {}\n", fs::path(options.scene).filename().string());
  write_text_atomically(folder.path() / "scene.yaml", head + to_yaml(config.take("scene")));
  ConfigNode render = ConfigNode::mapping();
  render.set("scene", ConfigNode::scalar("scene.yaml"));
  write_text_atomically(folder.path() / "render.yaml",
                        head + to_yaml(merged(std::move(render), std::move(config))));
  folder.finish();
  log_info(
      fmt::format("{}: scene.yaml, render.yaml and the files that they name", output.string()));
}

int import(const ImportOptions& options) {
  set_log_quiet(options.quiet);
  const Registry registry = load_default_modules();
  options.confine.apply(registry);
  Import imported = import_scene(options.scene, registry);
  const LoadedConfig loaded = build_render_config(imported.config, registry);
  if (options.report) print_report(imported);
  tell_notes(imported.notes, options.strict);
  if (!options.output.empty()) write_scene(std::move(imported.config), loaded, options);
  return kDone;
}

}  // namespace

void add_import_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("import", "Read a scene of another program");
  const auto options = std::make_shared<ImportOptions>();
  command->add_option("scene", options->scene, "Scene, such as Mitsuba's .xml")->required();
  command->add_option("-o,--output", options->output,
                      "Folder for the scene as YAML, with its meshes and images");
  options->confine.add_to(*command);
  command->add_flag("--report", options->report, "List every object and what stands for it");
  command->add_flag("--strict", options->strict, "Take approximations for errors");
  command->add_flag("-q,--quiet", options->quiet, "Only warnings and errors");
  command->callback([options, &exit_code] { exit_code = import(*options); });
}

}  // namespace pharos
