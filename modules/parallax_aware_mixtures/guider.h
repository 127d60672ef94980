#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/guiding/guider.h>

namespace pharos {
namespace vmf {

/// What the mixture of incident radiance is multiplied by.
enum class ProductFactor {
  none,    ///< nothing
  cosine,  ///< a lobe in place of the cosine, on opaque surfaces
  bsdf     ///< lobes in place of BSDF and cosine, or of the phase function
};

struct VmfGuiderSettings {
  ProductFactor product = ProductFactor::cosine;
  std::uint32_t bsdf_samples = 16;
  float bsdf_tail = 0.1f;
  static void describe(Schema<VmfGuiderSettings>& schema);
};

/// Samples directions in proportion to mixtures of von Mises-Fisher lobes (Ruppert et al. 2020).
class VmfGuider final : public Guider {
 public:
  using Settings = VmfGuiderSettings;
  explicit VmfGuider(const Settings& settings) : settings_(settings) {}

  GuiderTraits traits() const override;
  std::unique_ptr<const BoundGuider> bind(std::shared_ptr<const GuidingModel> model) const override;

 private:
  Settings settings_;
};

}  // namespace vmf

template <>
struct EnumNames<vmf::ProductFactor> {
  static constexpr std::array<std::pair<std::string_view, vmf::ProductFactor>, 3> names{
      {{"none", vmf::ProductFactor::none},
       {"cosine", vmf::ProductFactor::cosine},
       {"bsdf", vmf::ProductFactor::bsdf}}};
};

}  // namespace pharos
