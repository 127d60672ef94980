#pragma once

#include <filesystem>
#include <vector>

#include <pharos/config/registry.h>

namespace pharos {

/// Loads all module libraries (`*.pharos.so`) of `folder` in the order of their file names.
/// Libraries stay loaded until the program ends. Throws InputError with the path if a library
/// cannot be opened, lacks the entry point, was built for another ABI version or registers a name
/// that is taken. A folder that does not exist is an error only if `required` is set.
void load_modules(Registry& registry, const std::filesystem::path& folder, bool required = false);

/// Returns the folders from which every program loads modules: `../plugins` (build tree) and
/// `pharos/plugins` (install prefix) beside the library libpharos, and then the folders of the
/// colon-separated PHAROS_MODULE_PATH. Each folder is listed once.
std::vector<std::filesystem::path> default_module_folders();

/// Returns a registry with the modules of all default folders. Folders that PHAROS_MODULE_PATH
/// names must exist.
Registry load_default_modules();

}  // namespace pharos
