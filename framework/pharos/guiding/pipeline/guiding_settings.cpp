#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <pharos/config/registry.h>
#include <pharos/guiding/pipeline/guiding_settings.h>
#include <pharos/guiding/pipeline/guiding_state.h>
#include <pharos/guiding/pipeline/model_file.h>

namespace pharos {
namespace {

constexpr const char* kModelHelp =
    "File of a learned model, which then guides from the start; nothing is learned";

/// Calls `read`. An error in a model file is reported where `stated` names the file.
template <class Read>
void at_model_key(const ConfigNode& stated, Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    stated.find("model")->fail(error.what());
  }
}

/// Reads the model files of a list of methods. If `common` is not empty, it is the file of the
/// methods that have none of their own.
void read_models(std::vector<GuidingMethod>& methods, const std::filesystem::path& common,
                 const ConfigNode& stated) {
  std::map<std::string, std::size_t> read_from_common;  // by learner
  for (std::size_t i = 0; i < methods.size(); ++i) {
    GuidingMethod& method = methods[i];
    if (method.learner == nullptr) continue;
    const bool has_own = !method.model_file.empty();
    if (!has_own) method.model_file = common;
    if (method.model_file.empty()) continue;
    at_model_key(has_own ? stated.find("methods")->items()[i] : stated, [&] {
      const std::size_t skip = has_own ? 0 : read_from_common[method.learner->plugin_name()]++;
      method.model = read_model_file(method.model_file, *method.learner, skip);
    });
  }
}

/// Returns whether the methods of a model file have the same learners and share models in the same
/// way as `methods`.
bool same_methods(const ModelFileHead& head, const std::vector<GuidingMethod>& methods) {
  if (head.methods.size() != methods.size()) return false;
  std::uint32_t model = 0;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (i > 0 && !methods[i].shares_model()) ++model;
    if (head.methods[i].model != model) return false;
    if (!methods[i].shares_model() &&
        head.models[model].learner != methods[i].learner->plugin_name()) {
      return false;
    }
  }
  return true;
}

/// Returns what the mixing policy of `settings` has learned according to the model file, if one
/// file serves all methods and was written by the same methods and by the policy with the same
/// settings; otherwise an empty text.
std::string find_mixing_state(const GuidingSettings& settings) {
  const std::filesystem::path& file = settings.model_file;
  if (file.empty()) return "";
  const std::vector<GuidingMethod> methods = settings.resolved_methods();
  for (const GuidingMethod& method : methods) {
    if (!method.shares_model() && method.model_file != file) return "";
  }
  const ModelFileHead head = read_model_head(file);
  const bool fits = head.mixing_config == settings.mixing_config && same_methods(head, methods);
  return fits ? read_mixing_state(file) : "";
}

/// Throws InputError if steps are to be resampled but the methods do not allow it.
void check_candidates(const GuidingSettings& settings) {
  if (settings.candidates == 1) return;
  bool knows_radiance = false;
  std::shared_ptr<const GuidingModel> model;
  for (const GuidingMethod& method : settings.resolved_methods()) {
    if (method.guider->traits().steers_distance) {
      throw InputError(fmt::format(
          "'candidates' above 1 needs guiders that leave distances to media, but '{}' steers them",
          method.guider->plugin_name()));
    }
    if (!method.shares_model()) {
      model = method.model != nullptr ? method.model : method.learner->empty_model();
    }
    knows_radiance |= find_radiance_around(*model) != nullptr;
  }
  if (!knows_radiance) {
    throw InputError(
        "'candidates' above 1 needs a model that knows the radiance around a vertex, "
        "but no method has one");
  }
}

Schema<GuidingSettings> described() {
  Schema<GuidingSettings> schema;
  GuidingSettings::describe(schema);
  return schema;
}

}  // namespace

void GuidingMethod::describe(Schema<GuidingMethod>& s) {
  s.field("learner", &GuidingMethod::learner,
          "Turns recorded paths into a model; if absent, the guider samples the model of the "
          "previous method");
  s.field("guider", &GuidingMethod::guider, "Samples the model").required();
  s.field("weight", &GuidingMethod::weight,
          "Share of the samples, relative to the other methods that know something at a vertex")
      .above(0);
  s.field("model", &GuidingMethod::model_file, kModelHelp);
}

void GuidingSettings::describe(Schema<GuidingSettings>& s) {
  s.field("learner", &GuidingSettings::learner, "Turns recorded paths into a model");
  s.field("guider", &GuidingSettings::guider, "Samples the model");
  s.field("model", &GuidingSettings::model_file,
          "File of what was learned: models of all methods, and their mixing. They guide from the "
          "start, and nothing is learned");
  s.field("methods", &GuidingSettings::methods,
          "List of several methods, instead of a single learner and guider");
  s.field("mixing", &GuidingSettings::mixing, "How guided and unguided sampling share the samples")
      .otherwise("fixed");
  s.field(
       "candidates", &GuidingSettings::candidates,
       "Number of candidates for each step of the final image, drawn from the mixture of all "
       "techniques. If it is above 1, one is chosen in proportion to its BSDF times the radiance "
       "that the models expect")
      .at_least(1)
      .at_most(VertexStream::kMostCandidates);
  s.field(
       "last_bounce", &GuidingSettings::last_bounce,
       "Number of the last vertex of a path that is guided (the first after the lens is 1); all "
       "are guided if it is absent. Paths from lights, and paths made from both ends, are always "
       "guided everywhere")
      .at_least(1);
  s.field("training", &GuidingSettings::training,
          "How the budget is divided between training and the final image");
}

std::vector<GuidingMethod> GuidingSettings::resolved_methods() const {
  const bool in_place =
      learner != nullptr || guider != nullptr || (!model_file.empty() && methods.empty());
  if (in_place == !methods.empty()) {
    throw InputError("guiding needs either a learner and a guider, or a list of methods");
  }
  if (!in_place) {
    if (methods.front().shares_model()) throw InputError("the first method has no learner");
    if (methods.size() > kMostMethods) {
      throw InputError("there are more than " + std::to_string(kMostMethods) + " methods");
    }
    for (const GuidingMethod& method : methods) {
      if (method.shares_model() && !method.model_file.empty()) {
        throw InputError("a method with a 'model' needs the 'learner' that can read it");
      }
    }
    return methods;
  }
  if (learner == nullptr) throw InputError("guiding has no learner");
  if (guider == nullptr) throw InputError("guiding has no guider");
  return {{learner, guider, 1.0f, model_file, model}};
}

bool GuidingSettings::learns() const {
  const std::vector<GuidingMethod> all = resolved_methods();
  return std::any_of(all.begin(), all.end(), [](const GuidingMethod& m) { return m.learns(); });
}

std::string Value<GuidingSettings>::default_text(const GuidingSettings& settings) {
  return described().changed_text(settings);
}

GuidingSettings Value<GuidingSettings>::read(const ConfigNode& node, BuildContext& context,
                                             ConfigNode& resolved) {
  resolved = ConfigNode::mapping();
  GuidingSettings settings = described().read(node, context, resolved);
  if (const ConfigNode* mixing = resolved.find("mixing")) {
    settings.mixing_config = to_flow_yaml(*mixing);
  }
  if (settings.learner != nullptr && !settings.model_file.empty()) {
    at_model_key(node,
                 [&] { settings.model = read_model_file(settings.model_file, *settings.learner); });
  }
  read_models(settings.methods, settings.model_file, node);
  bool learns = true;
  try {
    learns = settings.learns();
    check_candidates(settings);
  } catch (const InputError& error) {
    node.fail(error.what());
  }
  if (!learns) {
    if (settings.model_file.empty()) return settings;
    at_model_key(node, [&] {
      settings.mixing_state = find_mixing_state(settings);
      GuidingState(settings, {});  // checks what was learned
    });
  }
  return settings;
}

}  // namespace pharos
