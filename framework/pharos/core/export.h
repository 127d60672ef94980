#pragma once

/// Marks the symbols of a module's library that are visible to the loader.
#define PHAROS_EXPORT __attribute__((visibility("default")))
