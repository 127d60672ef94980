#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include <pharos/experiments/runner/reference.h>
#include <pharos/experiments/runner/run_record.h>

namespace pharos {

/// Everything that one run of an experiment needs. A process of its own can make the run, so that a
/// run that aborts ends nothing but itself.
struct RunOrder {
  std::string key;  ///< RunRecord::key
  std::string scene, method;
  std::uint64_t seed = 0;
  std::string config;               ///< resolved config without seed and output, as YAML
  std::string build;                ///< build_key() of the code that shall make the run
  float exposure = 0;               ///< at which metrics of displayed images look [stops]
  std::filesystem::path reference;  ///< image that errors are measured against
  std::filesystem::path stem;       ///< the run's files without their extensions
  bool keeps_image = false;         ///< writes the image
  bool keeps_pictures = false;      ///< writes pictures of what was learned
};

/// A piece of work that an experiment gives to a child process: a run or a part of a reference.
using Order = std::variant<RunOrder, PartOrder>;

/// Writes an order, or reads it. Both throw RunError.
void save_order(const Order& order, const std::filesystem::path& path);
Order load_order(const std::filesystem::path& path);

/// Makes a run and writes its files. Returns empty if it was stopped. Throws RunError if this
/// program has other code than the order asks for.
std::optional<RunRecord> make_run(const RunOrder& order, const Registry& registry,
                                  const RenderControl& control);

/// Does what an order asks for, see make_run() and make_part(). Returns false if it was stopped.
bool carry_out(const Order& order, const Registry& registry, const RenderControl& control);

}  // namespace pharos
