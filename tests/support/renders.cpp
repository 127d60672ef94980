#include "renders.h"

#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/config/module_loader.h>

namespace pharos::testing {

const Registry& registry() {
  static const Registry all = [] {
    Registry made;
    load_modules(made, PHAROS_PLUGINS, true);
    load_modules(made, PHAROS_TEST_PLUGINS, true);
    load_modules(made, PHAROS_FAULTY_PLUGINS);
    return made;
  }();
  return all;
}

LoadedConfig config_from(const std::string& yaml) {
  return build_render_config(parse_yaml(yaml, "test"), registry());
}

RenderResult render(const std::string& yaml, int threads) {
  const LoadedConfig loaded = config_from(yaml);
  if (threads == 0) return RenderJob(loaded.config).run();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute([&] { return RenderJob(loaded.config).run(); });
}

std::string bits_of(const RenderResult& result) {
  const std::vector<float>& values = result.image.values();
  std::string all(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  if (result.learned != nullptr) {
    for (const LearnedModel& each : result.learned->models) {
      std::ostringstream model;
      save(model, *each.model);
      all += model.str();
    }
    all += result.learned->mixing_state;
  }
  if (result.gain) {
    all += fmt::format("{} {} {}", result.gain->nats, result.gain->noise_ratio.value_or(-1),
                       result.gain->is_off);
  }
  return all;
}

double image_mean(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += mean(image.rgb(x, y));
  }
  return sum / (static_cast<double>(image.width()) * image.height());
}

Estimate estimate(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Estimate result;
  for (const double v : values) result.mean += v / n;
  double squares = 0;
  for (const double v : values) squares += (v - result.mean) * (v - result.mean);
  result.standard_error = std::sqrt(squares / (n - 1) / n);
  return result;
}

Estimate mean_over_seeds(const std::string& yaml, int runs) {
  std::vector<double> means;
  for (int seed = 1; seed <= runs; ++seed) {
    means.push_back(image_mean(render(yaml + "\nseed: " + std::to_string(seed) + "\n").image));
  }
  return estimate(means);
}

}  // namespace pharos::testing
