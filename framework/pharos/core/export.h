#pragma once

/// Marks what a module's library shows to the loader.
#define PHAROS_EXPORT __attribute__((visibility("default")))
