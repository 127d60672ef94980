#include <algorithm>

#include <pharos/config/registry.h>
#include <pharos/guiding/pipeline/guiding_settings.h>
#include <pharos/guiding/pipeline/model_file.h>

namespace pharos {
namespace {

constexpr const char* kModelHelp =
    "File of a learned model, which then guides from the start; nothing is learned";

/// Reads the model file of a method, if it has one. `stated` is the config of the method.
template <class Method>
void read_model(Method& method, const ConfigNode& stated) {
  if (method.model_file.empty() || method.learner == nullptr) return;
  try {
    method.model = read_model_file(method.model_file, *method.learner);
  } catch (const InputError& error) {
    stated.find("model")->fail(error.what());
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
  s.field("model", &GuidingSettings::model_file, kModelHelp);
  s.field("methods", &GuidingSettings::methods,
          "List of several methods, instead of a single learner and guider");
  s.field("mixing", &GuidingSettings::mixing, "How guided and unguided sampling share the samples")
      .otherwise("fixed");
  s.field("training", &GuidingSettings::training,
          "How the budget is divided between training and the final image");
}

std::vector<GuidingMethod> GuidingSettings::resolved_methods() const {
  const bool in_place = learner != nullptr || guider != nullptr || !model_file.empty();
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
  read_model(settings, node);
  for (std::size_t i = 0; i < settings.methods.size(); ++i) {
    read_model(settings.methods[i], node.find("methods")->items()[i]);
  }
  return settings;
}

}  // namespace pharos
