#include <algorithm>
#include <string>

#include <pharos/core/error.h>
#include <pharos/transport/light_selection.h>

namespace pharos {

LightSelector::LightSelector(const Scene& scene, LightSelection selection) : selection_(selection) {
  const std::size_t count = scene.lights().size();
  if (count == 0) return;
  if (selection == LightSelection::all) {
    if (count > 0xffff) {
      throw InputError("light_selection 'all' takes at most 65535 lights, the scene has " +
                       std::to_string(count));
    }
    branches_ = static_cast<std::uint16_t>(count);
    probability_.assign(count, 1.0f);
    return;
  }
  branches_ = 1;
  double total = 0;
  for (const auto& light : scene.lights()) total += light->power();
  double sum = 0;
  for (const auto& light : scene.lights()) {
    const double p = total > 0 ? light->power() / total : 1.0 / static_cast<double>(count);
    probability_.push_back(static_cast<float>(p));
    sum += p;
    cumulative_.push_back(static_cast<float>(sum));
  }
}

int LightSelector::choose(std::uint16_t branch, float u) const {
  if (selection_ == LightSelection::all) return branch;
  const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, u);
  return static_cast<int>(above - cumulative_.begin());
}

}  // namespace pharos
