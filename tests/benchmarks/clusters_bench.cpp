// What guided renders cost, by what ranks on many machines must do, and the efficiency of such
// renders according to a simulation with these rates.

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include <fmt/format.h>

#include <pharos/rendering/render_config.h>

#include "bench.h"
#include "bench_scenes.h"
#include "cluster_model.h"
#include "cluster_plots.h"
#include "cluster_rates.h"
#include "guide_pairs.h"
#include "plot.h"

namespace pharos::bench {
namespace {

using testing::GuidePair;

/// The machines of the simulation.
constexpr double kRanks[]{1, 8, 64, 512};
constexpr double kGigabits[]{10, 100};

/// A way to learn on many machines.
struct Design {
  const char* name;
  const char* title;
  LearningPlace place;
  double recorded;  ///< as in ClusterJob
};
constexpr Design kDesigns[]{
    {"all-logs", "rank 0 learns from all samples", LearningPlace::rank_0, 0},
    {"recorded-16", "recorded_samples: 16", LearningPlace::rank_0, 16},
    {"recorded-2", "recorded_samples: 2", LearningPlace::rank_0, 2},
    {"owners", "each rank learns its own cells", LearningPlace::owners, 0}};

std::string title_of(const std::string& network, const std::string& design) {
  const auto* const found =
      std::ranges::find_if(kDesigns, [&](const Design& d) { return design == d.name; });
  return fmt::format("efficiency, {}, {}/s", found->title,
                     network == "10-gbit" ? "10 Gbit" : "100 Gbit");
}

/// A way to guide: settings on one line.
struct Way {
  std::string name, guiding;
};

/// Returns every learner with its first guider, and the robust mixture.
std::vector<Way> ways(const Registry& registry) {
  std::vector<Way> all;
  std::set<std::string> learners;
  for (const GuidePair& pair : testing::guide_pairs(registry)) {
    const std::string learner = pair.name.substr(0, pair.name.find('+'));
    if (!learners.insert(learner).second) continue;
    all.push_back(
        {learner, fmt::format("{{ learner: {}, guider: {} }}", pair.learner, pair.guider)});
  }
  all.push_back({"robust", "robust"});
  return all;
}

std::string config_of(const std::string& scene, const Way& way) {
  return fmt::format(
      "{}film: {{ width: 240, height: 160, filter: box }}\nbudget: {{ spp: 128 }}\n"
      "integrator: {{ type: path, max_depth: 12, guiding: {} }}\n",
      scene_entry(scene), way.guiding);
}

void add_rates(const std::string& name, const ClusterRates& rates, std::vector<Measurement>& all) {
  const auto add = [&](const char* figure, const char* unit, double value) {
    all.push_back({fmt::format("clusters.{}.{}", name, figure), unit, {value}});
  };
  add("trace", "ns/path", 1e9 * rates.trace);
  add("log", "B/path", rates.log_bytes);
  add("samples", "B/path", rates.sample_bytes);
  add("pack", "ns/path", 1e9 * rates.pack);
  add("unpack", "ns/path", 1e9 * rates.unpack);
  add("absorb_serial", "ns/path", 1e9 * rates.absorb_serial);
  add("absorb_shared", "ns/path", 1e9 * rates.absorb_shared);
  add("update", "ms", 1e3 * rates.updates.back());
  add("update_growth", "1", rates.updates.back() / rates.updates[rates.updates.size() - 2]);
  add("update_shared", "1", rates.update_shared);
  add("guides", "MB", 1e-6 * rates.guide_bytes);
  add("final_trace", "ns/path", 1e9 * rates.final_trace);
  add("tile", "B/pixel", rates.tile_bytes);
  add("tile_merge", "ns/pixel", 1e9 * rates.tile_merge);
}

void add_efficiencies(const std::string& name, const ClusterRates& rates,
                      std::vector<Measurement>& all) {
  for (const double gigabits : kGigabits) {
    for (const Design& design : kDesigns) {
      ClusterJob job;
      job.bandwidth = 1e9 / 8 * gigabits;
      job.recorded = design.recorded;
      for (const double ranks : kRanks) {
        all.push_back({fmt::format("clusters.{}.{}-gbit.{}.{}", name, gigabits, design.name, ranks),
                       "1",
                       {cluster_efficiency(rates, job, design.place, ranks)}});
      }
    }
  }
}

/// Splits clusters.SCENE.METHOD.NETWORK.DESIGN.RANKS. Returns nothing for other names.
std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts;
  std::istringstream in(name);
  for (std::string part; std::getline(in, part, '.');) parts.push_back(part);
  const bool fits = parts.size() == 6 && parts[0] == "clusters";
  return fits ? parts : std::vector<std::string>();
}

}  // namespace

void write_cluster_plots(const std::filesystem::path& folder, const std::vector<Measurement>& all) {
  std::map<std::string, Plot> plots;
  for (const Measurement& m : all) {
    const std::vector<std::string> parts = parts_of(m.name);
    if (parts.empty()) continue;
    const auto& [scene, method, network, design] = std::tie(parts[1], parts[2], parts[3], parts[4]);
    Plot& plot = plots[fmt::format("{}-{}-{}", scene, network, design)];
    plot.title = title_of(network, design);
    plot.x_name = "ranks";
    plot.least = 1e-4;
    if (plot.curves.empty() || plot.curves.back().name != method)
      plot.curves.push_back({method, {}});
    plot.curves.back().points.push_back({std::stod(parts[5]), m.median()});
  }
  for (const auto& [name, plot] : plots)
    write_plot(folder / fmt::format("clusters-{}.svg", name), plot);
}

Group clusters_group(const std::shared_ptr<const Registry>& registry) {
  return {"clusters", [registry](int) {
            std::vector<Measurement> all;
            for (const char* scene : {"cornell-box", "pool"}) {
              for (const Way& way : ways(*registry)) {
                const LoadedConfig loaded =
                    build_render_config(parse_yaml(config_of(scene, way), "benchmark"), *registry);
                const ClusterRates rates = cluster_rates(loaded.config);
                const std::string name = fmt::format("{}.{}", scene, way.name);
                add_rates(name, rates, all);
                add_efficiencies(name, rates, all);
              }
            }
            return all;
          }};
}

}  // namespace pharos::bench
