#include "inspect_options.h"

#include <limits>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/values.h>
#include <pharos/core/error.h>
#include <pharos/core/writable.h>

namespace pharos {
namespace {

/// Parses `count` numbers separated by commas.
std::vector<float> numbers(const char* option, const std::string& text, std::size_t count,
                           const std::string& expected) {
  const Location where{fmt::format("{} {}", option, text)};
  ConfigNode list = ConfigNode::sequence(where);
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(',', begin);
    list.items().push_back(ConfigNode::scalar(text.substr(begin, end - begin), where));
  }
  return read_floats(list, count, expected);
}

void check_picture_file(const InspectOptions& options) {
  const std::filesystem::path& file = options.output;
  if (file.empty()) throw InputError("--output: error: expected the name of a picture");
  if (file.extension() != ".png" && file.extension() != ".exr") {
    throw InputError(fmt::format(
        "{}: error: expected a name that ends in .png, or in .exr for the numbers themselves",
        file.string()));
  }
  check_writable(file);
  for (const std::filesystem::path& read : {options.model, options.scene}) {
    std::error_code ignored;
    if (!std::filesystem::equivalent(file, read, ignored)) continue;
    throw InputError(fmt::format("{}: error: is read, and would be lost", file.string()));
  }
}

/// Refuses options that describe a picture if no picture was requested.
void refuse_without_picture(const InspectOptions& options) {
  const std::pair<const char*, bool> given[] = {{"--output", !options.output.empty()},
                                                {"--range", !options.range.empty()}};
  for (const auto& [name, is_given] : given) {
    if (!is_given) continue;
    throw InputError(fmt::format(
        "{}: error: expected one of --slice, --direction, --cloud and --ellipsoids beside "
        "it",
        name));
  }
}

void check_ellipsoids(const InspectOptions& options) {
  parse_point("--ellipsoids", options.ellipsoids);
  if (options.wants_exr()) {
    throw InputError(
        fmt::format("{}: error: ellipsoids are a drawing, not numbers: expected a name "
                    "that ends in .png",
                    options.output.string()));
  }
  if (!options.range.empty()) throw InputError("--range: error: ellipsoids have no densities");
}

}  // namespace

void InspectOptions::add_to(CLI::App& command) {
  command.add_option("model", model, "Model file, as `output.model` names it")->required();
  CLI::Option* slice_option =
      command.add_option("--slice", slice, "Picture of the density on a plane, such as y=0.5")
          ->type_name("AXIS=VALUE");
  CLI::Option* direction_option =
      command
          .add_option("--direction", direction,
                      "Picture of the density over directions at a point, latitude-longitude")
          ->type_name("X,Y,Z")
          ->excludes(slice_option);
  CLI::Option* cloud_option =
      command.add_flag("--cloud", cloud, "Picture of the densest places in space")
          ->excludes(slice_option)
          ->excludes(direction_option);
  command
      .add_option("--ellipsoids", ellipsoids,
                  "Picture of the Gaussians that guide paths at a point, for models that have some")
      ->type_name("X,Y,Z")
      ->excludes(slice_option)
      ->excludes(direction_option)
      ->excludes(cloud_option);
  command
      .add_flag("--shares", shares,
                "The slice shows how sampling techniques share the samples, not a density")
      ->needs(slice_option);
  command.add_option("--bounce", bounce, "Number of the vertices of --shares; the first one is 1")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.add_option("--index", index, "Number of the model in the file, from 0")
      ->capture_default_str();
  command.add_option("-o,--output", output, "Picture (.png), or its numbers (.exr)");
  command.add_option("--scene", scene,
                     "Config or scene whose outline a slice shows, and whose view a cloud or "
                     "ellipsoids");
  command.add_option("--size", size, "Longer edge of the picture [pixels]")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command.add_option("--range", range, "Densities of the first and the last color")
      ->type_name("LOW,HIGH");
  command.add_option("--threads", threads, "Number of threads; 0: all cores")
      ->check(CLI::Range(0, 1024));
}

void check_options(const InspectOptions& options) {
  if (!options.wants_picture()) return refuse_without_picture(options);
  check_picture_file(options);
  if (!options.slice.empty()) parse_slice(options.slice);
  if (!options.direction.empty()) parse_point("--direction", options.direction);
  if (!options.ellipsoids.empty()) check_ellipsoids(options);
  parse_range(options.range);
  if (!options.scene.empty() && !options.direction.empty()) {
    throw InputError("--scene: error: a picture over directions shows none");
  }
  if (!options.range.empty() && options.wants_exr()) {
    throw InputError("--range: error: an .exr file holds numbers, not colors");
  }
}

SliceOption parse_slice(const std::string& text) {
  const Location where{fmt::format("--slice {}", text)};
  const std::size_t equals = text.find('=');
  const std::size_t axis = std::string("xyz").find(text.substr(0, equals));
  if (equals != 1 || axis == std::string::npos) {
    throw InputError(where, "expected AXIS=VALUE with an axis x, y or z, such as y=0.5");
  }
  const ConfigNode value = ConfigNode::scalar(text.substr(equals + 1), where);
  return {static_cast<int>(axis),
          static_cast<float>(read_number(value, std::numeric_limits<float>::max()))};
}

Point3 parse_point(const char* option, const std::string& text) {
  const std::vector<float> xyz = numbers(option, text, 3, "three numbers X,Y,Z, such as 0,1.5,-2");
  return {xyz[0], xyz[1], xyz[2]};
}

std::optional<RangeOption> parse_range(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::string expected = "two numbers LOW,HIGH, such as 0.001,10";
  const std::vector<float> ends = numbers("--range", text, 2, expected);
  if (!(ends[0] > 0 && ends[0] < ends[1])) {
    throw InputError(Location{fmt::format("--range {}", text)},
                     fmt::format("expected {}, with 0 < LOW < HIGH", expected));
  }
  return RangeOption{ends[0], ends[1]};
}

}  // namespace pharos
