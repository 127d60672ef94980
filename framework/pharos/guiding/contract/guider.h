#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/arena.h>
#include <pharos/core/error.h>
#include <pharos/guiding/contract/distribution.h>
#include <pharos/guiding/contract/model.h>
#include <pharos/scene/local_scattering.h>
#include <pharos/scene/sensor.h>

namespace pharos {

/// What a guide may know of a path vertex.
struct GuidingVertex {
  Point3 position;
  Vec3 normal;          ///< geometric, unit; zero in media
  Vec3 shading_normal;  ///< unit; zero in media
  VertexKind kind = VertexKind::surface;
  Event event = Event::none;  ///< what happened here; none at the current vertex
  float roughness = 1;
};

/// The question a guide is asked: where from here? Everything in it is a function of the path's
/// prefix.
struct GuidingQuery {
  const GuidingVertex* previous = nullptr;  ///< null only at a path's very first vertex
  GuidingVertex current;
  Vec3 towards_previous;  ///< unit
  Transport transport = Transport::radiance;
  /// Number of the current vertex; the first after the lens is 1. 0: not known, nor is the event at
  /// `previous`, where paths are made from both ends.
  std::uint16_t bounce = 1;
  const LocalScattering& scattering;  ///< BSDF or phase function here
  const Medium* medium = nullptr;     ///< that the path came through; null: empty space
};

/// What a guider offers and needs; checked before rendering starts.
struct GuiderTraits {
  std::string model;                ///< neutral name of the model contract it binds to
  bool steers_distance = false;     ///< decides how far paths go in media
  bool steers_events = false;       ///< proposes discrete events
  bool guides_camera = false;       ///< offers the first vertex
  bool guides_light_paths = false;  ///< is asked along paths from lights too
};

/// Proposes the first vertex, and so chooses the pixel.
class CameraGuider {
 public:
  virtual ~CameraGuider() = default;
  /// The distribution of directions from `lens`, or null when nothing is known. Proposals off the
  /// film are zero samples. Made in `arena`.
  virtual const GuidingDistribution* query_camera(const PreparedSensor& sensor,
                                                  const LensPoint& lens, Arena& arena) const = 0;
};

/// A guider bound to one model: constant, thread-safe, asked at every vertex.
class BoundGuider {
 public:
  virtual ~BoundGuider() = default;

  /// The distribution to propose from, made in `arena`; null when nothing is known here. Whether it
  /// is null depends on the query alone, and so on the path's prefix alone. No heap, no lock.
  /// Guides that do not steer events must decline purely discrete vertices.
  virtual const GuidingDistribution* query(const GuidingQuery& query, Arena& arena) const = 0;

  /// Null unless the traits say guides_camera.
  virtual const CameraGuider* camera() const { return nullptr; }
};

/// Contract: how a learned model is sampled.
class Guider : public Component {
 public:
  static constexpr std::string_view contract_name = "guider";

  virtual GuiderTraits traits() const = 0;
  /// Binds to a model; shares its ownership. Throws InputError naming both when the model is none
  /// that this guider can sample.
  virtual std::unique_ptr<const BoundGuider> bind(
      std::shared_ptr<const GuidingModel> model) const = 0;
};

/// The model as a Model, for Guider::bind(). Throws InputError naming both when it is none.
template <class Model>
std::shared_ptr<const Model> bind_model(const std::shared_ptr<const GuidingModel>& model,
                                        const Guider& guider) {
  if (auto bound = std::dynamic_pointer_cast<const Model>(model)) return bound;
  throw InputError("the guider '" + guider.plugin_name() + "' cannot sample the model '" +
                   model->name() + "'");
}

}  // namespace pharos
