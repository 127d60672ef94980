#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/error.h>
#include <pharos/guiding/contract/distribution.h>
#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/contract/vertex.h>

namespace pharos {

/// The capabilities of a guider. The framework checks them before rendering starts.
struct GuiderTraits {
  bool steers_distance = false;     ///< decides how far paths go in media
  bool steers_events = false;       ///< proposes discrete events
  bool guides_camera = false;       ///< proposes the first vertex, and so chooses the pixel
  bool guides_light_paths = false;  ///< can be asked along paths from lights
};

/// Contract: how a learned model is sampled. Plugins derive from GuiderOf<Model>.
class Guider : public Component {
 public:
  static constexpr std::string_view contract_name = "guider";

  virtual GuiderTraits traits() const = 0;

  // The following functions connect GuiderOf to the framework. Only decorators of guiders implement
  // them directly.

  /// Returns the name of the kind of model that this guider samples.
  virtual std::string_view model_name() const = 0;
  /// Returns the address within `model` of the kind of model that this guider samples. Returns null
  /// if `model` is of another kind.
  virtual const void* find(const GuidingModel& model) const = 0;
  /// Answers a query; `found` is what find() returned.
  virtual const GuidingDistribution* query_found(const void* found, const GuidingQuery& query,
                                                 Arena& arena) const = 0;
};

/// Base of guiders that sample models of type `Model`. `Model` is a class with a member
/// `static constexpr … kName`. It is a GuidingModel or a neutral contract that models implement.
/// The framework checks the type once, when a guider is bound to a model.
template <class Model>
class GuiderOf : public Guider {
 public:
  /// Returns the sampling distribution at a vertex. The distribution is made in `arena` and lives
  /// until the next vertex is known; the query lives as long. Returns null if nothing is known
  /// here; the other methods then sample the vertex. Whether the result is null depends on the
  /// query alone. The function allocates nothing on the heap and takes no lock. At vertices whose
  /// events are all discrete, the framework asks only if GuiderTraits::steers_events is true.
  virtual const GuidingDistribution* query(const Model& model, const GuidingQuery& query,
                                           Arena& arena) const = 0;

  std::string_view model_name() const final { return Model::kName; }
  const void* find(const GuidingModel& model) const final {
    return dynamic_cast<const Model*>(&model);
  }
  const GuidingDistribution* query_found(const void* found, const GuidingQuery& question,
                                         Arena& arena) const final {
    return query(*static_cast<const Model*>(found), question, arena);
  }
};

/// A guider with the model that it samples: constant and thread-safe.
class BoundGuider {
 public:
  /// Shares ownership of the model; the guider must live as long. Throws an InputError that names
  /// both if the guider cannot sample the model.
  BoundGuider(const Guider& guider, std::shared_ptr<const GuidingModel> model)
      : guider_(&guider), model_(std::move(model)), found_(guider.find(*model_)) {
    if (found_ != nullptr) return;
    throw InputError("the guider '" + guider.plugin_name() + "' samples models '" +
                     std::string(guider.model_name()) + "' and cannot sample the model '" +
                     model_->info().name + "'");
  }

  const GuidingModel& model() const { return *model_; }
  const GuidingDistribution* query(const GuidingQuery& query, Arena& arena) const {
    return guider_->query_found(found_, query, arena);
  }

 private:
  const Guider* guider_;
  std::shared_ptr<const GuidingModel> model_;
  const void* found_;
};

}  // namespace pharos
