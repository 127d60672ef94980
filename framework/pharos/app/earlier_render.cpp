#include "earlier_render.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <pharos/core/checksum.h>
#include <pharos/core/error.h>
#include <pharos/core/image.h>
#include <pharos/core/log.h>
#include <pharos/experiments/runner/build_key.h>
#include <pharos/experiments/runner/content_key.h>
#include <pharos/rendering/render_job.h>

namespace pharos {
namespace {

std::string value_text(const ConfigNode* node) {
  return node == nullptr ? "nothing" : node->describe();
}

/// Whether a value stands for the content of a file, see content_of().
bool is_content(const ConfigNode* node) {
  constexpr std::size_t kDigits = 32;
  return node != nullptr && node->is_scalar() && node->text().size() == kDigits &&
         node->text().find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Returns where two configs first differ: "budget.spp: the scalar '64' there, the scalar '128'
/// here"; nothing if they are equal.
std::optional<std::string> difference(const ConfigNode* there, const ConfigNode* here,
                                      const std::string& path = {}) {
  const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  if (there != nullptr && here != nullptr && there->kind() == here->kind()) {
    for (const ConfigNode::Entry& entry : there->entries()) {
      if (auto found = difference(&entry.value, here->find(entry.key), below(entry.key))) {
        return found;
      }
    }
    for (const ConfigNode::Entry& entry : here->entries()) {
      if (there->find(entry.key) == nullptr) {
        return difference(nullptr, &entry.value, below(entry.key));
      }
    }
    const std::size_t count = std::max(there->items().size(), here->items().size());
    for (std::size_t i = 0; i < count; ++i) {
      const auto item = [&](const ConfigNode* node) {
        return i < node->items().size() ? &node->items()[i] : nullptr;
      };
      if (auto found = difference(item(there), item(here), below(std::to_string(i)))) return found;
    }
    if (there->text() == here->text()) return std::nullopt;
  }
  if (is_content(there) && is_content(here)) {
    return fmt::format("the file that '{}' names has changed since then", path);
  }
  return fmt::format("'{}' is {} there and {} here", path, value_text(there), value_text(here));
}

/// Reads the checkpoint of `loaded` and checks that it belongs to the same config. Without `budget`
/// the budgets may differ.
SavedRender matching_checkpoint(const LoadedConfig& loaded, const SavedRender& own, bool budget) {
  const std::string& file = loaded.config.output.checkpoint;
  SavedRender checkpoint = read_checkpoint(file);
  ConfigNode there = parse_yaml(checkpoint.config, file), here = parse_yaml(own.config, file);
  if (!budget) {
    there.take("budget");
    here.take("budget");
  }
  if (const auto found = difference(&there, &here)) {
    throw InputError(
        fmt::format("the checkpoint '{}' belongs to another config: {}", file, *found));
  }
  if (checkpoint.build != own.build) {
    log_warning(fmt::format(
        "{}: written by another build of Pharos, so the image may have other bits", file));
  }
  return checkpoint;
}

void check_budget_grows(const SavedRender& checkpoint, const Budget& now) {
  const ConfigNode config = parse_yaml(checkpoint.config, "checkpoint");
  const ConfigNode* before = config.find("budget");
  const char* key = now.spp ? "spp" : "seconds";
  const ConfigNode* value = before->find(key);
  if (value == nullptr) {
    throw InputError(
        fmt::format("--continue: error: the finished image had a budget of {}, so expected one of "
                    "the same kind",
                    now.spp ? "seconds" : "spp"));
  }
  const double wanted = now.spp ? *now.spp : *now.seconds;
  if (wanted > std::stod(value->text())) return;
  throw InputError(fmt::format("--continue: error: expected a budget.{} above {}, found {:g}", key,
                               value->text(), wanted));
}

}  // namespace

void check_named(const OutputSettings& output, const char* option) {
  if (!output.checkpoint.empty()) return;
  throw InputError(fmt::format(
      "{}: error: the config names no checkpoint: expected --set output.checkpoint=FILE", option));
}

SavedRender saved_render_head(const LoadedConfig& loaded, const Registry& registry) {
  return {.config = to_yaml(content_of(loaded)), .build = build_key(loaded.resolved, registry)};
}

std::string state_to_resume(const LoadedConfig& loaded, const SavedRender& own) {
  const OutputSettings& output = loaded.config.output;
  if (!std::filesystem::exists(output.checkpoint)) {
    log_info(fmt::format("{}: there is no such checkpoint yet, so the render starts anew",
                         output.checkpoint));
    return {};
  }
  return matching_checkpoint(loaded, own, true).state;
}

std::string state_to_continue(const LoadedConfig& loaded, const SavedRender& own,
                              const std::filesystem::path& image) {
  const OutputSettings& output = loaded.config.output;
  const Metadata metadata = read_metadata(image);
  SavedRender checkpoint = matching_checkpoint(loaded, own, false);
  if (!checkpoint.finished) {
    const ConfigNode config = parse_yaml(checkpoint.config, output.checkpoint);
    const ConfigNode* budget = config.find("budget");
    const char* key = budget->find("spp") != nullptr ? "spp" : "seconds";
    throw InputError(
        fmt::format("--continue: error: the render of the checkpoint '{}' is not finished: "
                    "expected --resume -o {} --set budget.{}={}",
                    output.checkpoint, image.string(), key, budget->find(key)->text()));
  }
  const auto entry = metadata.find(kStateEntry);
  if (entry == metadata.end() || entry->second != state_name(checkpoint.state)) {
    throw InputError(fmt::format("{}: error: this is not the image of the checkpoint '{}'",
                                 image.string(), output.checkpoint));
  }
  check_budget_grows(checkpoint, loaded.config.budget);
  return std::move(checkpoint.state);
}

std::string state_name(const std::string& state) {
  return fmt::format("{:016x}", checksum(state));
}

}  // namespace pharos
