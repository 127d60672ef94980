#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/learner.h>

namespace pharos {
namespace open_pgl {

/// The library's kinds of distributions of directions.
enum class Directions {
  parallax_vmm,  ///< von Mises-Fisher mixtures that store the distances of their lights
  vmm,           ///< the same without parallax
  quadtree       ///< directional quadtrees
};

/// Parameters of the library's fields. The library fixes all others.
struct OpenPglSettings {
  Directions directions = Directions::parallax_vmm;
  std::uint32_t cell_samples = 32000;
  std::uint32_t max_depth = 32;
  bool neighbors = true;
  std::uint32_t batch_samples = 1u << 22;
  float least_pdf = 0.01f;
  float glossy = 0.3f;

  static void describe(Schema<OpenPglSettings>& schema);
};

/// Learns incident radiance with a field of Intel's library Open PGL.
class OpenPglLearner final : public Learner {
 public:
  using Settings = OpenPglSettings;
  explicit OpenPglLearner(const Settings& settings) : settings_(settings) {}

  LearnerTraits traits() const override;
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<GuidingModel> empty_model() const override;

 private:
  Settings settings_;
};

}  // namespace open_pgl

template <>
struct EnumNames<open_pgl::Directions> {
  static constexpr auto names = std::to_array<EnumName<open_pgl::Directions>>(
      {{"parallax_vmm", open_pgl::Directions::parallax_vmm},
       {"vmm", open_pgl::Directions::vmm},
       {"quadtree", open_pgl::Directions::quadtree}});
};

}  // namespace pharos
