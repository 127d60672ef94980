#include <ctime>
#include <map>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <pharos/core/version.h>
#include <pharos/experiments/metrics/summary.h>
#include <pharos/experiments/runner/machine.h>
#include <pharos/experiments/runner/results_files.h>
#include <pharos/experiments/runner/runs.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

std::string budget_text(const Budget& budget) {
  return budget.spp ? fmt::format("{} samples a pixel", *budget.spp)
                    : fmt::format("{:g} s", *budget.seconds);
}

/// Returns text such as "; 60 s in hall, pool", which names the entries (scenes or methods) with a
/// budget of their own.
template <class Entry>
std::string own_budgets_text(const std::vector<Entry>& entries, std::string_view relation) {
  std::map<std::string, std::string> by_budget;
  for (const Entry& entry : entries) {
    if (!entry.budget) continue;
    std::string& names = by_budget[budget_text(*entry.budget)];
    names += (names.empty() ? "" : ", ") + entry.name;
  }
  std::string text;
  for (const auto& [budget, names] : by_budget) {
    text += fmt::format("; {} {} {}", budget, relation, names);
  }
  return text;
}

/// Returns the experiment's budget, followed by the budgets of scenes and methods.
std::string budgets_text(const ExperimentConfig& config) {
  return budget_text(config.budget) + ", training included" +
         own_budgets_text(config.scenes, "in") + own_budgets_text(config.methods, "for");
}

/// Returns text such as "8; 4 of slow, old".
std::string seeds_text(const ExperimentConfig& config) {
  std::map<std::uint32_t, std::string> fewer;
  for (const ExperimentMethod& method : config.methods) {
    const std::uint32_t seeds = config.seeds_of(method);
    if (seeds == config.seeds) continue;
    fewer[seeds] += (fewer[seeds].empty() ? "" : ", ") + method.name;
  }
  std::string text = std::to_string(config.seeds);
  for (const auto& [seeds, names] : fewer) text += fmt::format("; {} of {}", seeds, names);
  return text;
}

std::vector<std::pair<std::string, std::string>> facts_of(const ExperimentResults& results) {
  std::vector<std::pair<std::string, std::string>> facts{
      {"Budget of a run", budgets_text(results.config)},
      {"Seeds", seeds_text(results.config)},
      {"Baseline", results.config.baseline},
      {"Pharos", version()},
      {"Threads", std::to_string(thread_count())}};
  if (const std::string name = processor_name(); !name.empty())
    facts.emplace_back("Processor", name);
  facts.emplace_back("Written",
                     fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))));
  if (results.records.size() < results.run_count) {
    facts.emplace_back("Incomplete", fmt::format("{} of {} runs are done", results.records.size(),
                                                 results.run_count));
  }
  return facts;
}

std::string reference_note(const Reference& reference) {
  if (reference.samples_per_pixel == 0) {
    return fmt::format("Reference: {}.", reference.file.filename().string());
  }
  std::string note = fmt::format("Reference: {:g} samples a pixel in {:.0f} s by Pharos {}.",
                                 reference.samples_per_pixel, reference.seconds, reference.version);
  if (reference.relative_mse) {
    note += fmt::format(" Its own expected relMSE is {:.2g}, its MSE {:.2g}.",
                        *reference.relative_mse, *reference.mse);
  }
  return note;
}

/// Returns the papers to cite for each method, one a line.
std::string papers_text(const ExperimentResults& results) {
  std::string text;
  for (const auto& [method, papers] : papers_by_method(results)) {
    text += fmt::format("{}:\n", method);
    for (const std::string& paper : papers) text += fmt::format("  {}\n", paper);
  }
  return text;
}

ReportImage method_image(const fs::path& file, const std::string& method, const Image& reference) {
  ReportImage image{.label = method, .image = read_image(file), .error_maps = {}};
  for (const Metric metric : {Metric::relative_mse, Metric::hdr_flip}) {
    image.error_maps.push_back(
        {std::string(metric_info(metric).title), error_map(metric, image.image, reference)});
  }
  return image;
}

/// Returns the pictures of a run's learned density.
std::vector<ReportPicture> pictures_of(const fs::path& run, const std::string& method) {
  std::vector<ReportPicture> pictures;
  for (const char* name : {"slice-x", "slice-y", "slice-z", "directions"}) {
    const fs::path file = run.string() + "." + name + ".exr";
    if (!fs::exists(file)) continue;
    const Metadata metadata = read_metadata(file);
    const auto caption = metadata.find("pharos:caption");
    pictures.push_back(
        {method + ": " + (caption == metadata.end() ? name : caption->second), read_image(file)});
  }
  return pictures;
}

ReportScene scene_of(const ExperimentResults& results, std::size_t index) {
  const std::string& name = results.config.scenes[index].name;
  const Reference& reference = *results.references[index];
  ReportScene scene{.name = name, .note = reference_note(reference), .images = {}, .pictures = {}};
  for (const ExperimentMethod& method : results.config.methods) {
    if (results.find(name, method.name, results.config.first_seed) == nullptr) continue;
    const fs::path run =
        run_file(results.folder(), name, method.name, results.config.first_seed, "");
    const fs::path file = run.string() + ".exr";
    scene.images.push_back(method_image(file, method.name, reference.image));
    for (ReportPicture& picture : pictures_of(run, method.name)) {
      scene.pictures.push_back(std::move(picture));
    }
  }
  scene.images.push_back({.label = "reference", .image = reference.image, .error_maps = {}});
  return scene;
}

}  // namespace

Report experiment_report(const ExperimentResults& results) {
  Report report{.title = results.config.title,
                .description = results.config.description,
                .facts = facts_of(results),
                .methods = {},
                .baseline = results.config.baseline,
                .tables = summary_tables(results),
                .curves = convergence_curves(results),
                .scenes = {},
                .texts = {}};
  for (const ExperimentMethod& method : results.config.methods) {
    report.methods.push_back(method.name);
  }
  report.tables.push_back(equal_error_table(results));
  for (std::size_t s = 0; s < results.references.size(); ++s) {
    if (results.references[s]) report.scenes.push_back(scene_of(results, s));
  }
  report.texts.push_back({"runs.csv", runs_csv(results)});
  report.texts.push_back({"convergence.csv", convergence_csv(results)});
  if (std::string papers = papers_text(results); !papers.empty()) {
    report.texts.push_back({"papers to cite", std::move(papers)});
  }
  for (const PlannedCell& cell : results.plan.cells) {
    report.texts.push_back({fmt::format("{}, {}.yaml", results.config.scenes[cell.scene].name,
                                        results.config.methods[cell.method].name),
                            cell.text});
  }
  return report;
}

}  // namespace pharos
