#pragma once

#include <cstdint>
#include <filesystem>

#include <pharos/config/command.h>
#include <pharos/config/schema.h>

#include "synthesis.h"

namespace pharos::aligned {

/// See synthesize_command.cpp.
class SynthesizeCommand final : public Command {
 public:
  struct Settings : SynthesisSettings {
    std::filesystem::path output;   ///< .txt or .bin
    std::filesystem::path picture;  ///< .png
    int frequency = 128;            ///< highest one of the picture, along each axis
    int size = 514;                 ///< edge of its squares [pixels]
    std::filesystem::path library;  ///< folder as the cache of PointSetLibrary
    int pair_step = 5;              ///< of the sets that it gets
    std::filesystem::path shipped;  ///< folder for the sets that are part of the program

    static void describe(Schema<Settings>& schema);
  };

  /// Throws InputError where nothing is to be written, or the sets of a library were to have other
  /// settings than they have.
  explicit SynthesizeCommand(const Settings& settings);
  CommandEnd run(const CommandControl& control) const override;

 private:
  CommandEnd make_one(const CommandControl& control) const;
  CommandEnd make_library(const CommandControl& control) const;
  CommandEnd make_shipped(const CommandControl& control) const;

  Settings settings_;
};

}  // namespace pharos::aligned
