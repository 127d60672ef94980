#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/guiding/learner.h>

namespace pharos {
namespace pgl {

/// The library's kinds of distributions of directions.
enum class Directions {
  parallax_vmm,  ///< von Mises-Fisher mixtures that know where their light is
  vmm,           ///< the same without parallax
  quadtree       ///< directional quadtrees
};

/// Parameters of the library's fields; what it does not let be set keeps its own values.
struct PglSettings {
  Directions directions = Directions::parallax_vmm;
  std::uint32_t cell_samples = 32000;
  std::uint32_t max_depth = 32;
  bool neighbours = true;
  std::uint32_t batch_samples = 1u << 22;
  float least_pdf = 0.01f;
  float glossy = 0.3f;

  static void describe(Schema<PglSettings>& schema);
};

/// Learns where light comes from by Intel's library Open PGL.
class PglLearner final : public Learner {
 public:
  using Settings = PglSettings;
  explicit PglLearner(const Settings& settings) : settings_(settings) {}

  LearnerTraits traits() const override;
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<const GuidingModel> load_model(std::istream& in) const override;

 private:
  Settings settings_;
};

}  // namespace pgl

template <>
struct EnumNames<pgl::Directions> {
  static constexpr std::array<std::pair<std::string_view, pgl::Directions>, 3> names{
      {{"parallax_vmm", pgl::Directions::parallax_vmm},
       {"vmm", pgl::Directions::vmm},
       {"quadtree", pgl::Directions::quadtree}}};
};

}  // namespace pharos
