#pragma once

#include <cstdint>
#include <filesystem>

#include <pharos/config/command.h>
#include <pharos/config/schema.h>

namespace pharos::aligned {

/// The command `directions`; see directions_command.cpp.
class DirectionsCommand final : public Command {
 public:
  struct Settings {
    std::filesystem::path render;
    std::filesystem::path output;
    std::uint32_t samples = 16;
    int scale = 4;

    static void describe(Schema<Settings>& schema);
  };
  /// Throws InputError if the picture is not a PNG file.
  explicit DirectionsCommand(const Settings& settings);
  CommandEnd run(const CommandControl& control) const override;

 private:
  Settings settings_;
};

}  // namespace pharos::aligned
