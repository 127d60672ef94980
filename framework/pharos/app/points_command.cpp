#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/error.h>
#include <pharos/core/log.h>
#include <pharos/core/writable.h>
#include <pharos/sampling/purpose_names.h>

#include "commands.h"
#include "sampler_pictures.h"

namespace pharos {
namespace {

/// The arguments of `pharos points`.
struct PointsOptions {
  std::vector<std::string> samplers;  ///< names or YAML mappings; none: all
  std::string dimension = "light_position";
  SamplerPictureOptions picture;
  std::filesystem::path output;
};

/// Returns the dimension of a 2D purpose at the first vertex that has it. Throws InputError with
/// the name of the option.
Dimension parse_dimension(const std::string& text) {
  std::vector<std::string> names;
  for (const auto& [name, purpose] : EnumNames<Purpose>::names) {
    const bool is_of_camera = purpose == Purpose::pixel || purpose == Purpose::lens;
    if (name == text) return {purpose, static_cast<std::uint16_t>(is_of_camera ? 0 : 1)};
    names.emplace_back(name);
  }
  throw InputError(Location{fmt::format("--dimension {}", text)},
                   fmt::format("expected one of {}, numbers that come in pairs{}",
                               quoted_list(names), suggestion(text, names)));
}

void check_output(const std::filesystem::path& file) {
  if (file.extension() != ".png") {
    throw InputError(fmt::format("{}: error: expected a name that ends in .png", file.string()));
  }
  check_writable(file);
}

std::vector<NamedSampler> chosen_samplers(const Registry& registry,
                                          const std::vector<std::string>& wanted) {
  if (wanted.empty()) return pictured_samplers(registry);
  std::vector<NamedSampler> all;
  for (const std::string& text : wanted) {
    BuildContext context{.registry = registry};
    ConfigNode resolved;
    auto sampler = registry.build<Sampler>(parse_yaml(text, "--sampler"), context, resolved);
    if (sampler->needs_probe()) {
      throw InputError(Location{fmt::format("--sampler {}", text)},
                       "it looks at a scene before rendering, and has no points without one");
    }
    all.push_back({text, std::move(sampler)});
  }
  return all;
}

void draw_points(PointsOptions options) {
  check_output(options.output);
  options.picture.dimension = parse_dimension(options.dimension);
  const Registry registry = load_default_modules();
  const std::vector<NamedSampler> samplers = chosen_samplers(registry, options.samplers);
  write_png(sampler_pictures(samplers, options.picture), options.output, 0, false);
  std::string names;
  for (const NamedSampler& s : samplers) names += (names.empty() ? "" : ", ") + s.name;
  log_info(fmt::format("{}: {}; {} points, power from {:g} to {:g}, logarithmic",
                       options.output.string(), names, options.picture.count, kLowestPower,
                       kHighestPower));
}

}  // namespace

void add_points_command(CLI::App& app, int&) {
  CLI::App* command =
      app.add_subcommand("points", "Make a picture of the points of samplers and their spectra");
  const auto options = std::make_shared<PointsOptions>();
  SamplerPictureOptions& picture = options->picture;
  command
      ->add_option("--sampler", options->samplers,
                   "A sampler's name, or its settings as '{ type: NAME, … }'; may be repeated. "
                   "Unless given: all")
      ->type_name("SAMPLER")
      ->allow_extra_args(false);
  command->add_option("-n,--samples", picture.count, "Points: samples of one pixel")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  command->add_option("--dimension", options->dimension, "What the numbers are for")
      ->type_name("NAME")
      ->capture_default_str();
  command
      ->add_option("--realizations", picture.realizations,
                   "Renders over which the spectrum is the mean")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command->add_option("--frequency", picture.max_frequency, "Highest frequency of the spectrum")
      ->check(CLI::Range(1, 512))
      ->capture_default_str();
  command->add_option("--size", picture.edge, "Edge of each square [pixels]")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  command->add_option("--seed", picture.seed, "Seed of the points that are shown")
      ->capture_default_str();
  command->add_option("-o,--output", options->output, "Picture (.png)")->required();
  command->callback([options] { draw_points(*options); });
}

}  // namespace pharos
