#include <fmt/format.h>

#include <pharos/config/registry.h>
#include <pharos/guiding/guiding.h>

namespace pharos {

void GuidingMethod::describe(Schema<GuidingMethod>& s) {
  s.field("learner", &GuidingMethod::learner, "Turns recorded paths into a model").required();
  s.field("guider", &GuidingMethod::guider, "How the model is sampled").required();
  s.field("weight", &GuidingMethod::weight,
          "Share relative to the other methods that know something at a vertex")
      .above(0);
}

void GuidingSettings::describe(Schema<GuidingSettings>& s) {
  s.field("learner", &GuidingSettings::learner, "Turns recorded paths into a model");
  s.field("guider", &GuidingSettings::guider, "How the model is sampled");
  s.field("methods", &GuidingSettings::methods,
          "Several learner/guider pairs side by side, instead of one in place");
  s.field("mixing", &GuidingSettings::mixing, "How guided and unguided sampling share the samples")
      .otherwise("fixed");
  s.field("training", &GuidingSettings::training, "How the budget is divided");
}

std::vector<GuidingMethod> GuidingSettings::resolved_methods() const {
  const bool in_place = learner != nullptr || guider != nullptr;
  if (in_place == !methods.empty()) {
    throw InputError("guiding needs either a learner and a guider, or a list of methods");
  }
  if (in_place && (learner == nullptr || guider == nullptr)) {
    throw InputError(fmt::format("guiding has a {} but no {}", learner ? "learner" : "guider",
                                 learner ? "guider" : "learner"));
  }
  return in_place ? std::vector<GuidingMethod>{{learner, guider, 1.0f}} : methods;
}

}  // namespace pharos
