#pragma once

#include <filesystem>
#include <vector>

#include <pharos/config/registry.h>

namespace pharos {

/// Loads every module library (`*.pharos.so`) of `folder` in order of file name. Libraries stay
/// loaded until the program ends. Throws InputError with the path when a library cannot be opened,
/// lacks the entry point, was built for another ABI version or brings a name that is taken.
/// A folder that does not exist is an error only if `required`.
void load_modules(Registry& registry, const std::filesystem::path& folder, bool required = false);

/// The folders that every program loads from: beside the program (build tree) or in the install
/// prefix's `lib/pharos/plugins`, then those of the colon-separated PHAROS_MODULE_PATH. Each folder
/// stands once.
std::vector<std::filesystem::path> default_module_folders();

/// A registry with the modules of all default folders. Those that PHAROS_MODULE_PATH names must
/// exist.
Registry load_default_modules();

}  // namespace pharos
