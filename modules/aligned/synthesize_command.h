#pragma once

#include <cstdint>
#include <filesystem>

#include <pharos/config/command.h>
#include <pharos/config/schema.h>

#include "synthesis.h"

namespace pharos::aligned {

/// The command `synthesize`; see synthesize_command.cpp.
class SynthesizeCommand final : public Command {
 public:
  struct Settings : SynthesisSettings {
    std::filesystem::path output;   ///< .txt or .bin
    std::filesystem::path picture;  ///< .png
    int frequency = 128;            ///< highest frequency of the picture, along each axis
    int size = 514;                 ///< edge of each square of the picture [pixels]
    std::filesystem::path library;  ///< folder with the same files as the cache of PointSetLibrary
    int pair_step = 5;  ///< spacing of the grid of directions for sets of two directions [degrees]
    std::filesystem::path shipped;  ///< folder for the sets that are part of the program

    static void describe(Schema<Settings>& schema);
  };

  /// Throws InputError if no output is requested, or if the settings differ from the settings that
  /// the sets of a library have.
  explicit SynthesizeCommand(const Settings& settings);
  CommandEnd run(const CommandControl& control) const override;

 private:
  CommandEnd make_one(const CommandControl& control) const;
  CommandEnd make_library(const CommandControl& control) const;
  CommandEnd make_shipped(const CommandControl& control) const;

  Settings settings_;
};

}  // namespace pharos::aligned
