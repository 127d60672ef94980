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

/// What a guider offers. Checked before rendering starts.
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

  // The framework's side of GuiderOf. Only decorators of guiders implement it themselves.

  /// The name of the kind of model that it samples.
  virtual std::string_view model_name() const = 0;
  /// Returns the address of that kind of model within `model`; null if `model` is of another kind.
  virtual const void* find(const GuidingModel& model) const = 0;
  /// Answers a query; `found` is what find() returned.
  virtual const GuidingDistribution* query_found(const void* found, const GuidingQuery& query,
                                                 Arena& arena) const = 0;
};

/// Base of guiders that sample models of type `Model`: a class with a member
/// `static constexpr … kName`, which is a GuidingModel or a neutral contract that models meet.
/// The framework checks the type once, when a guider is bound to a model.
template <class Model>
class GuiderOf : public Guider {
 public:
  /// Returns the distribution to sample at a vertex, made in `arena`, where it lives until the next
  /// vertex is known; the query lives as long. Null: nothing is known here, and the vertex is
  /// sampled by the other methods. Whether it is null depends on the query alone. No heap, no lock.
  /// Vertices with discrete events only are asked if GuiderTraits::steers_events is true.
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
  /// Shares ownership of the model; the guider must live as long. Throws InputError, naming both,
  /// if the guider cannot sample the model.
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
