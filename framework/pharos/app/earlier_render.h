#pragma once

#include <filesystem>
#include <string>

#include <pharos/config/registry.h>
#include <pharos/rendering/checkpoint.h>
#include <pharos/rendering/render_config.h>

namespace pharos {

/// Throws InputError if the config names no checkpoint, which `option` needs.
void check_named(const OutputSettings& output, const char* option);

/// Returns a checkpoint of the render of `loaded`, without a state.
SavedRender saved_render_head(const LoadedConfig& loaded, const Registry& registry);

/// Returns the state from which `pharos render --resume` goes on; empty if there is no checkpoint
/// yet. Throws InputError if the checkpoint cannot be read or belongs to another config. Warns if
/// it was written by another build of Pharos.
std::string state_to_resume(const LoadedConfig& loaded, const SavedRender& own);

/// Returns the state from which `pharos render --continue IMAGE` adds samples to a finished image.
/// Throws InputError in the same cases as state_to_resume(), and if there is no checkpoint, if its
/// render is not finished, if `image` is not the image of this render, or if the budget has not
/// grown.
std::string state_to_continue(const LoadedConfig& loaded, const SavedRender& own,
                              const std::filesystem::path& image);

/// Returns a name of a state: the same for equal states only.
std::string state_name(const std::string& state);

}  // namespace pharos
