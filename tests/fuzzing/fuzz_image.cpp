// The first byte chooses a format, and the other bytes are an image file in this format. Wrong
// input may only end in an InputError.

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <pharos/core/color_image.h>
#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

namespace {

using namespace pharos;

constexpr std::array<std::string_view, 6> kFormats{"exr", "hdr", "jpg", "png", "ppm", "tif"};

template <class Read>
void check(Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::TemporaryFolder folder;
  if (size == 0) return -1;
  const std::string format(kFormats[data[0] % kFormats.size()]);
  const auto file = folder.write("fuzz." + format,
                                 std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  check([&] { read_metadata(file); });
  check([&] { read_image(file); });
  check([&] { read_colors(file); });
  return 0;
}
