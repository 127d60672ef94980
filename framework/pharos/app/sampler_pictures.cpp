#include "sampler_pictures.h"

#include <algorithm>

#include <pharos/conformance/subjects.h>

namespace pharos {

std::vector<NamedSampler> pictured_samplers(const Registry& registry) {
  const conformance::ExampleFolder folder;
  std::vector<NamedSampler> all;
  for (const auto& s : conformance::first_cases(registry, Sampler::contract_name, folder.path())) {
    auto sampler = std::static_pointer_cast<const Sampler>(s.component);
    if (!sampler->needs_probe()) all.push_back({s.plugin->name, std::move(sampler)});
  }
  return all;
}

Image sampler_pictures(std::span<const NamedSampler> samplers,
                       const SamplerPictureOptions& options) {
  constexpr std::size_t kMostColumns = 5;
  const auto columns = std::min(samplers.size(), kMostColumns);
  const std::size_t rows = columns == 0 ? 0 : (samplers.size() + columns - 1) / columns;
  std::vector<Image> pictures(2 * columns * rows);
  for (std::size_t i = 0; i < samplers.size(); ++i) {
    const std::size_t place = i / columns * 2 * columns + i % columns;
    const Sampler& sampler = *samplers[i].sampler;
    pictures[place] = points_picture(
        sampled_points(sampler, options.dimension, options.count, options.seed), options.edge);
    const SpectrumPlan plan{.dimension = options.dimension,
                            .count = options.count,
                            .realizations = options.realizations,
                            .max_frequency = options.max_frequency};
    pictures[place + columns] = spectrum_picture(expected_spectrum(sampler, plan), options.edge);
  }
  return contact_sheet(pictures, samplers.size() == 1 ? 2 : static_cast<int>(columns));
}

}  // namespace pharos
