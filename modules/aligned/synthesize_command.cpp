// synthesize: makes sets of points with low energy along stated directions. It writes them as text
// (one line "x y" per point) or in the binary form of point_set_file.h, and draws the points and
// their spectrum.
//
//     pharos synthesize --points 4096 --directions 30,75 -o points.txt --picture points.png
//     pharos synthesize --library ~/.cache/pharos/aligned-sets --points 2048
#include "synthesize_command.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/image.h>
#include <pharos/core/writable.h>
#include <pharos/experiments/pictures/point_pictures.h>

#include "point_set_file.h"
#include "point_set_library.h"
#include "shipped_sets.h"

namespace pharos::aligned {
namespace {

namespace fs = std::filesystem;
using Settings = SynthesizeCommand::Settings;

/// Converts a pointer to a member of SynthesisSettings to a pointer to a member of the command's
/// settings.
template <class T>
constexpr T Settings::*own(T SynthesisSettings::*member) {
  return member;
}

void make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!fs::is_directory(folder, failed)) {
    throw InputError(fmt::format("{}: error: the folder cannot be made", folder.string()));
  }
  check_writable(folder / "set.bin");
}

/// Makes sets one after the other with `make(name, control)`. Returns false if one of them was
/// stopped.
template <class Make>
bool make_all(const std::vector<SetName>& names, const CommandControl& control, Make&& make) {
  // Each frequency costs one pass over the points, and the number of frequencies is proportional to
  // the number of points.
  const auto cost = [](const SetName& name) {
    return static_cast<double>(name.points) * name.points;
  };
  double total = 0, done = 0;
  for (const SetName& name : names) total += cost(name);
  for (const SetName& name : names) {
    const SynthesisControl one{
        .on_progress = [&](double part) { control.progress((done + part * cost(name)) / total); },
        .stop = control.stop};
    if (!make(name, one)) return false;
    done += cost(name);
  }
  return true;
}

void draw(const PointSet& set, const Settings& settings) {
  const std::vector<Vec2> points = positions(set);
  statistics::PowerSpectrum spectrum(settings.frequency);
  spectrum.add(points);
  const std::vector<Image> squares{points_picture(points, settings.size),
                                   spectrum_picture(spectrum, settings.size)};
  write_png(contact_sheet(squares, 2), settings.picture, 0, false);
}

void write(const PointSet& set, const fs::path& file) {
  if (file.extension() == ".txt") return write_point_list(file, set);
  write_point_sets(file, {.key = 0, .sets = {set}});
}

}  // namespace

void Settings::describe(Schema<Settings>& s) {
  const auto is_size = [](const std::uint32_t& n) { return is_set_size(n); };
  s.field("points", own(&SynthesisSettings::points), "Number of points")
      .check("a power of two from 64 to 65536", is_size);
  s.field("directions", own(&SynthesisSettings::directions),
          "Directions of low energy in addition to both axes: normals of edges, as angles from the "
          "x axis toward the y axis")
      .unit("degrees")
      .check("at most 16 directions", [](const std::vector<double>& d) { return d.size() <= 16; });
  s.field("steps", own(&SynthesisSettings::steps), "Steps of gradient descent")
      .at_least(1)
      .at_most(100'000);
  s.field("step", own(&SynthesisSettings::step),
          "Length of the first step; the length falls to zero")
      .unit("1 / square root of the number of points")
      .above(0)
      .at_most(1);
  s.field("spectrum", own(&SynthesisSettings::spectrum),
          "Weight of the power spectrum loss; 0 leaves it out")
      .at_least(0);
  s.field("wasserstein", own(&SynthesisSettings::wasserstein),
          "Weight of the sliced Wasserstein loss, multiplied by 4096/N for N above 4096; 0 leaves "
          "it out")
      .at_least(0);
  s.field("rule", own(&SynthesisSettings::rule), "Rule that selects the suppressed frequencies");
  s.field("mask", own(&SynthesisSettings::mask),
          "Frequencies with target powers, used instead of the rule")
      .check("of other frequencies than (0, 0)", [](const std::vector<TargetPower>& mask) {
        return std::ranges::none_of(mask,
                                    [](const TargetPower& v) { return v.x == 0 && v.y == 0; });
      });
  s.field("seed", own(&SynthesisSettings::seed),
          "Seed of the jittered grid from which descent starts");
  s.field("output", &Settings::output,
          "File for the points: .txt, or .bin with coordinates in steps of 2^-16");
  s.field("picture", &Settings::picture, "Picture of the points beside their spectrum (.png)");
  s.field("frequency", &Settings::frequency, "Highest frequency of the picture, along each axis")
      .unit("1/edge")
      .at_least(1)
      .at_most(1024);
  s.field("size", &Settings::size, "Edge of each square of the picture")
      .unit("pixels")
      .at_least(16)
      .at_most(4096);
  s.field(
      "library", &Settings::library,
      "Folder for all sets of one and two directions with this number of points that the library "
      "would otherwise synthesize when they are requested");
  s.field("pair_step", &Settings::pair_step,
          "Spacing of the grid of directions for the library's sets of two directions")
      .unit("degrees")
      .check("a divisor of 45", [](const int& step) { return step > 0 && 45 % step == 0; });
  s.field("shipped", &Settings::shipped, "Folder for the sets that are part of the program");
  s.example("{ points: 1024, directions: [30], output: points.txt }");
  s.example("{ points: 256, spectrum: 1, wasserstein: 0, picture: points.png }");
}

SynthesizeCommand::SynthesizeCommand(const Settings& settings) : settings_(settings) {
  const auto is_given = [](const fs::path& path) { return !path.empty(); };
  const auto has_extension = [](const fs::path& file, const char* extension) {
    return file.extension() == extension;
  };
  const bool many = is_given(settings.library) || is_given(settings.shipped);
  if (!many && !is_given(settings.output) && !is_given(settings.picture)) {
    throw InputError("expected one of 'output', 'picture', 'library' and 'shipped'");
  }
  if (is_given(settings.output) && !has_extension(settings.output, ".txt") &&
      !has_extension(settings.output, ".bin")) {
    throw InputError(fmt::format("output: expected a name that ends in .txt or .bin, found '{}'",
                                 settings.output.filename().string()));
  }
  if (is_given(settings.picture) && !has_extension(settings.picture, ".png")) {
    throw InputError(fmt::format("picture: expected a name that ends in .png, found '{}'",
                                 settings.picture.filename().string()));
  }
  if (settings.spectrum == 0 && settings.wasserstein == 0) {
    throw InputError("expected a positive weight: 'spectrum' or 'wasserstein'");
  }
  const SynthesisSettings& stated = settings;
  if (many && stated != settings_of({settings.points, {}})) {
    throw InputError(
        "the sets of 'library' and 'shipped' have settings of their own; only 'points' of the "
        "library can be chosen");
  }
}

CommandEnd SynthesizeCommand::run(const CommandControl& control) const {
  check_writable(settings_.output);
  check_writable(settings_.picture);
  for (const fs::path& folder : {settings_.library, settings_.shipped}) {
    if (!folder.empty()) make_folder(folder);
  }
  if (!settings_.output.empty() || !settings_.picture.empty()) {
    if (make_one(control) == CommandEnd::stopped) return CommandEnd::stopped;
  }
  if (!settings_.library.empty()) {
    if (make_library(control) == CommandEnd::stopped) return CommandEnd::stopped;
  }
  return settings_.shipped.empty() ? CommandEnd::done : make_shipped(control);
}

CommandEnd SynthesizeCommand::make_one(const CommandControl& control) const {
  const auto start = std::chrono::steady_clock::now();
  const Synthesis made =
      synthesize(settings_, {.on_progress = control.on_progress, .stop = control.stop});
  if (made.points.empty()) return CommandEnd::stopped;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  if (!settings_.output.empty()) write(made.points, settings_.output);
  if (!settings_.picture.empty()) draw(made.points, settings_);
  const LossRecord& last = made.history.back();
  control.tell(fmt::format(
      "{} points, {} frequencies: losses {:.3g} (spectrum) and {:.3g} (Wasserstein), in {:.1f} s",
      made.points.size(), made.frequencies, last.spectrum, last.wasserstein, taken.count()));
  return CommandEnd::done;
}

CommandEnd SynthesizeCommand::make_library(const CommandControl& control) const {
  const PointSetLibrary library(
      {.cache_folder = settings_.library, .pair_step = settings_.pair_step});
  std::vector<SetName> names = library.names(1, settings_.points);
  const std::vector<SetName> pairs = library.names(2, settings_.points);
  names.insert(names.end(), pairs.begin(), pairs.end());
  const bool all = make_all(names, control, [&](const SetName& name, const SynthesisControl& one) {
    return library.find(name, one).has_value();
  });
  if (!all) return CommandEnd::stopped;
  control.tell(fmt::format("{}: {} sets of {} points, those of the program left out",
                           settings_.library.string(), names.size(), settings_.points));
  return CommandEnd::done;
}

CommandEnd SynthesizeCommand::make_shipped(const CommandControl& control) const {
  std::vector<SetName> names;
  for (const std::uint32_t points : kShippedSizes) {
    for (int d = 0; d < kShippedDirections; ++d) names.push_back({points, {d}});
  }
  std::vector<PointSet> sets;
  const bool all = make_all(names, control, [&](const SetName& name, const SynthesisControl& one) {
    sets.push_back(synthesize(settings_of(name), one).points);
    if (sets.back().empty()) return false;
    if (sets.size() < kShippedDirections) return true;
    write_point_sets(settings_.shipped / fmt::format("{}.bin", name.points),
                     {.key = 0, .sets = std::move(sets)});
    sets.clear();
    return true;
  });
  if (!all) return CommandEnd::stopped;
  control.tell(fmt::format("{}: {} sets", settings_.shipped.string(), names.size()));
  return CommandEnd::done;
}

}  // namespace pharos::aligned
