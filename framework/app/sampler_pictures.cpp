#include "sampler_pictures.h"

#include <pharos/conformance/subjects.h>
#include <pharos/experiments/sampled_points.h>

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
  std::vector<Image> points, spectra;
  for (const NamedSampler& s : samplers) {
    points.push_back(points_picture(
        sampled_points(*s.sampler, options.dimension, options.count, options.seed), options.edge));
    spectra.push_back(
        spectrum_picture(expected_spectrum(*s.sampler, options.dimension, options.count,
                                           options.realisations, options.max_frequency),
                         options.edge));
  }
  const int columns = samplers.size() == 1 ? 2 : static_cast<int>(samplers.size());
  points.insert(points.end(), spectra.begin(), spectra.end());
  return contact_sheet(points, columns);
}

}  // namespace pharos
