#include <atomic>
#include <chrono>
#include <filesystem>
#include <future>
#include <mutex>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>
#include <vector>

#include <pharos/core/error.h>
#include <pharos/core/threads.h>
#include <pharos/core/version.h>
#include <pharos/rendering/render_config.h>
#include <pharos/rendering/render_job.h>

#include "bindings.h"
#include "models.h"

namespace pharos::python {
namespace {

/// Lays a dictionary over the files that its key `extends` names, as read_config() does for files.
ConfigNode extended(ConfigNode node) {
  const ConfigNode files = node.take("extends");
  ConfigNode base = ConfigNode::mapping();
  const std::vector<ConfigNode> one{files};
  for (const ConfigNode& file : files.is_sequence() ? files.items() : one) {
    if (file.is_null()) continue;
    if (!file.is_scalar()) file.fail("expected the name of a file");
    base = merged(std::move(base), read_config(file.text()));
  }
  return merged(std::move(base), std::move(node));
}

/// Loads a config: the path of a file, or a dictionary.
LoadedConfig load(const py::object& config, const std::vector<std::string>& overrides) {
  if (!py::isinstance<py::dict>(config)) {
    if (!is_path(config)) throw InputError("config: expected a path or a dictionary");
    const auto path = config.cast<std::filesystem::path>();
    const Registry& plugins = registry();
    const py::gil_scoped_release release;
    return load_render_config(path, overrides, plugins);
  }
  ConfigNode node = extended(node_of(config));
  const Registry& plugins = registry();
  const py::gil_scoped_release release;
  return build_render_config(std::move(node), overrides, plugins);
}

/// A render on a thread of its own. The thread that started it stays free for Python: it calls back
/// and sees Ctrl-C.
class BackgroundRender {
 public:
  BackgroundRender(const RenderConfig& config, int threads)
      : result_(std::async(std::launch::async, [this, &config, threads] {
          RenderResult result;
          with_threads(threads, [&] { result = RenderJob(config).run(control()); });
          return result;
        })) {}
  /// Ends the render. Python's other threads go on meanwhile.
  ~BackgroundRender() {
    stop();
    const py::gil_scoped_release release;
    if (result_.valid()) result_.wait();
  }
  BackgroundRender(const BackgroundRender&) = delete;
  BackgroundRender& operator=(const BackgroundRender&) = delete;

  /// Waits for a moment. Returns whether the render has ended.
  bool wait() {
    constexpr std::chrono::milliseconds kMoment{50};
    return result_.wait_for(kMoment) == std::future_status::ready;
  }
  void stop() { stop_ = true; }
  std::optional<Progress> progress() {
    const std::scoped_lock lock(mutex_);
    return progress_;
  }
  /// Returns the result when the render has ended, or throws its error.
  RenderResult take() { return result_.get(); }

 private:
  RenderControl control() {
    RenderControl control;
    control.on_progress = [this](const Progress& progress) {
      const std::scoped_lock lock(mutex_);
      progress_ = progress;
    };
    control.stop = &stop_;
    return control;
  }

  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::optional<Progress> progress_;
  std::future<RenderResult> result_;  ///< last: its thread uses the other members
};

/// Calls back from the calling thread. A callback that returns something false but None ends the
/// render.
void report(const py::object& callback, BackgroundRender& render) {
  const std::optional<Progress> progress = render.progress();
  if (callback.is_none() || !progress) return;
  py::dict facts;
  facts["fraction"] = progress->fraction;
  facts["seconds"] = progress->seconds;
  facts["samples_per_pixel"] = progress->samples_per_pixel;
  facts["training"] = progress->training;
  facts["rays"] = progress->rays;
  const py::object goes_on = callback(facts);
  if (!goes_on.is_none() && !py::bool_(goes_on)) render.stop();
}

/// Waits for a render. Returns true if Ctrl-C has ended it. Any other exception of Python ends it,
/// and is thrown.
bool wait_for(BackgroundRender& render, const py::object& callback) {
  const auto waits = [&] {
    const py::gil_scoped_release release;
    return !render.wait();
  };
  bool is_interrupted = false;
  while (waits()) {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!is_interrupted) report(callback, render);
    } catch (const py::error_already_set& error) {
      if (!error.matches(PyExc_KeyboardInterrupt)) throw;
      is_interrupted = true;
      render.stop();
    }
  }
  return is_interrupted;
}

py::object gain_of(const RenderResult& result) {
  if (!result.gain) return py::none();
  py::dict gain;
  gain["nats"] = result.gain->nats;
  gain["noise_ratio"] = result.gain->noise_ratio;
  gain["path_cost"] = result.gain->path_cost;
  gain["is_off"] = result.gain->is_off;
  return gain;
}

py::list notes_of(const LoadedConfig& loaded) {
  py::list notes;
  for (const ImportNote& note : loaded.notes) notes.append(note.to_string());
  return notes;
}

py::dict metadata_of(const RenderResult& result, const LoadedConfig& loaded) {
  py::dict metadata;
  metadata["version"] = version();
  metadata["config"] = object_of(loaded.resolved);
  metadata["seed"] = loaded.config.seed;
  metadata["samples_per_pixel"] = result.samples_per_pixel;
  metadata["seconds"] = result.times.budgeted();
  metadata["paths"] = result.counters.paths;
  metadata["lit_paths"] = result.counters.lit_paths;
  metadata["invalid_paths"] = result.counters.invalid_paths;
  metadata["rays"] = result.counters.rays;
  metadata["gain"] = gain_of(result);
  metadata["stopped"] = result.stopped;
  metadata["notes"] = notes_of(loaded);
  return metadata;
}

py::dict result_of(const RenderResult& result, const LoadedConfig& loaded) {
  py::dict all = layers_of(result.image);
  py::list models;
  if (result.learned != nullptr) {
    for (const LearnedModel& model : result.learned->models) models.append(GuidingModel(model));
  }
  all["models"] = models;
  all["metadata"] = metadata_of(result, loaded);
  return all;
}

py::dict render(const py::object& config, const std::vector<std::string>& overrides,
                const py::object& progress, int threads) {
  const LoadedConfig loaded = load(config, overrides);
  std::optional<RenderResult> result;
  bool is_interrupted = false;
  {
    BackgroundRender render(loaded.config, threads);
    is_interrupted = wait_for(render, progress);
    result = render.take();
  }
  py::dict all = result_of(*result, loaded);
  if (!is_interrupted) return all;
  const py::object type = py::module_::import("pharos.exceptions").attr("Interrupted");
  PyErr_SetObject(type.ptr(), type(all).ptr());
  throw py::error_already_set();
}

py::object validate(const py::object& config, const std::vector<std::string>& overrides) {
  return object_of(load(config, overrides).resolved);
}

py::dict dictionary_of(const ParameterInfo& parameter) {
  py::dict facts;
  facts["key"] = parameter.key;
  facts["type"] = parameter.type;
  facts["unit"] = parameter.unit;
  facts["default"] = parameter.default_value;
  facts["range"] = parameter.range;
  facts["help"] = parameter.help;
  facts["required"] = parameter.required;
  return facts;
}

py::dict dictionary_of(const PluginInfo& plugin) {
  py::list parameters;
  for (const ParameterInfo& parameter : plugin.parameters) {
    parameters.append(dictionary_of(parameter));
  }
  py::dict facts;
  facts["summary"] = plugin.summary;
  facts["module"] = plugin.module;
  facts["parameters"] = parameters;
  facts["examples"] = plugin.examples;
  return facts;
}

py::dict plugins() {
  py::dict contracts;
  for (const std::string& contract : registry().contracts()) {
    py::dict of_contract;
    for (const std::string& name : registry().names(contract)) {
      of_contract[py::str(name)] = dictionary_of(*registry().find(contract, name));
    }
    contracts[py::str(contract)] = of_contract;
  }
  return contracts;
}

constexpr const char* kRenderHelp =
    R"(Renders a config: the path of a file, or a dictionary with the same keys.

`overrides` is a list of assignments such as "budget.spp=16". `threads` is the number of threads;
0: all cores.

Returns a dictionary. No file is written. The keys are

- 'image': radiance, an array of height x width x 3, and the layers 'albedo', 'normal' and
  'variance' of the same shape, and 'depth', 'samples', 'splitting' and 'cost';
- 'models': a list of what was learned;
- 'metadata': the 'version' of Pharos, the 'config' with every value in force, the 'seed',
  'samples_per_pixel', 'seconds' as a time budget counts them, the numbers of 'paths', of
  'lit_paths' that carry light, of 'invalid_paths' (NaN or infinite; they count as black) and of
  'rays', the 'gain' of the guides or None, whether the render was 'stopped' early, and 'notes' on
  what was approximated or left out in reading the scene.

`progress` is called some 20 times a second with a dictionary: the 'fraction' of the budget in [0, 1],
'seconds', 'samples_per_pixel', whether it is 'training', and 'rays'. If it returns False, the render
ends with the samples so far. Ctrl-C raises Interrupted, whose `result` has them. Raises InputError
and RunError.)";

constexpr const char* kValidateHelp =
    R"(Checks a config and returns it with every value in force, as a dictionary. Raises InputError.)";

constexpr const char* kPluginsHelp =
    R"(Returns all plugins: dictionaries by contract and by name, with the keys 'summary', 'module',
'parameters' and 'examples'.)";

}  // namespace

void add_renders(py::module_& module) {
  module.def("render", render, py::arg("config"), py::arg("overrides") = std::vector<std::string>(),
             py::kw_only(), py::arg("progress") = py::none(), py::arg("threads") = 0, kRenderHelp);
  module.def("validate", validate, py::arg("config"),
             py::arg("overrides") = std::vector<std::string>(), kValidateHelp);
  module.def("plugins", plugins, kPluginsHelp);
}

}  // namespace pharos::python
