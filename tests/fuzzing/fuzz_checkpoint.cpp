// The first byte chooses between a checkpoint file and the state within one, which the file's
// checksum protects from damage. Wrong input may only end in an InputError.

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <pharos/config/module_loader.h>
#include <pharos/rendering/checkpoint.h>
#include <pharos/rendering/render_job.h>
#include <pharos/tests/fixtures.h>

namespace {

using namespace pharos;

/// A small guided render.
const LoadedConfig& config() {
  static const Registry registry = load_default_modules();
  static const LoadedConfig loaded = build_render_config(
      parse_yaml("scene:\n  shapes: [sphere]\n  emitters: [constant]\n  sensor: perspective\n"
                 "film: { width: 4, height: 4 }\nbudget: { spp: 8 }\n"
                 "integrator: { type: path, guiding: { learner: spatial_gaussians, guider: p0, "
                 "mixing: simplex } }\n",
                 "fuzz"),
      registry);
  return loaded;
}

/// Goes on from a state and stops at once.
void go_on(const std::string& state) {
  static const std::atomic<bool> stop{true};
  RenderControl control;
  control.stop = &stop;
  RenderJob(config().config).run(control, state);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::TemporaryFolder folder;
  if (size < 2) return -1;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (data[0] % 2 == 0) {
      read_checkpoint(folder.write("fuzz.checkpoint", bytes));
    } else {
      go_on(bytes);
    }
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
