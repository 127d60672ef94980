#include <cerrno>
#include <cstddef>
#include <cstring>
#include <exception>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfVersion.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/core/exr_file.h>
#include <pharos/core/exr_header.h>
#include <pharos/core/image_files.h>

namespace pharos {
namespace {

using Names = std::vector<std::string>;

constexpr const char* kChannels = "pharos:channels";
/// An entry that OpenEXR adds while it reads a header.
constexpr const char* kPartType = "type";
/// OpenEXR works on the caller's thread. Threads of its own would compete with the renderer's.
constexpr int kNoThreads = 0;

/// Returns the channels as write_exr() listed them; null in files by other programs.
const Names* listed_channels(const Imf::Header& header) {
  const auto* names = header.findTypedAttribute<Imf::StringVectorAttribute>(kChannels);
  return names == nullptr ? nullptr : &names->value();
}

/// Whether a file has the listed channels and no others, all as floats for each pixel.
bool has_channels(const Imf::Header& header, const Names& names) {
  std::set<std::string> missing(names.begin(), names.end());
  if (missing.size() != names.size()) return false;
  const Imf::ChannelList& channels = header.channels();
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    const Imf::Channel& channel = c.channel();
    const bool is_whole = channel.xSampling == 1 && channel.ySampling == 1;
    if (channel.type != Imf::FLOAT || !is_whole || missing.erase(c.name()) == 0) return false;
  }
  return missing.empty();
}

/// Whether the image is uncropped, begins at (0, 0), and has a size that Pharos reads.
bool has_plain_size(const Imf::Header& header, std::size_t channels) {
  const Imath::Box2i& window = header.dataWindow();
  if (window != header.displayWindow() || window.min != Imath::V2i(0, 0)) return false;
  if (window.max.x >= kLargestEdge || window.max.y >= kLargestEdge) return false;
  const std::size_t pixels =
      (static_cast<std::size_t>(window.max.x) + 1) * (static_cast<std::size_t>(window.max.y) + 1);
  return pixels <= kMostPixels && channels >= 1 && channels <= kMostChannels &&
         pixels * channels <= kMostValues;
}

/// Whether a file is one that write_exr() could have written.
bool is_own(const Imf::MultiPartInputFile& file) {
  const bool has_scan_lines = (Imf::getFlags(file.version()) & ~Imf::LONG_NAMES_FLAG) == 0;
  if (!has_scan_lines || file.parts() != 1) return false;
  const Imf::Header& header = file.header(0);
  const Names* const names = listed_channels(header);
  return names != nullptr && has_channels(header, *names) && has_plain_size(header, names->size());
}

/// Returns read(file) for a file of write_exr(). Returns nothing if the file is another one or if
/// OpenEXR refuses it: OpenImageIO then finds the same fault and reports it.
template <class Read>
auto read_own(const std::filesystem::path& path, Read&& read)
    -> decltype(read(std::declval<Imf::MultiPartInputFile&>())) {
  try {
    if (!file_problem(path).empty() || !exr_header_fits(path)) return std::nullopt;
    if (!Imf::isOpenExrFile(path.c_str())) return std::nullopt;
    Imf::MultiPartInputFile file(path.c_str(), kNoThreads);
    if (!is_own(file)) return std::nullopt;
    return read(file);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

/// Describes the memory of an image: channels of these names, interleaved, from `values` on.
Imf::FrameBuffer interleaved(const Names& names, float* values, int width) {
  Imf::FrameBuffer buffer;
  const std::size_t pixel = names.size() * sizeof(float);
  for (std::size_t c = 0; c < names.size(); ++c) {
    char* const first = reinterpret_cast<char*>(values + c);
    buffer.insert(names[c], Imf::Slice(Imf::FLOAT, first, pixel, pixel * width));
  }
  return buffer;
}

struct Size {
  int width, height;
};

Size size_of(const Imf::MultiPartInputFile& file) {
  const Imath::V2i last = file.header(0).dataWindow().max;
  return {last.x + 1, last.y + 1};
}

/// Reads channels of all pixels, interleaved. Throws what OpenEXR throws at damaged files.
void read_channels(Imf::MultiPartInputFile& file, const Names& names, float* values) {
  const auto [width, height] = size_of(file);
  Imf::InputPart part(file, 0);
  part.setFrameBuffer(interleaved(names, values, width));
  part.readPixels(0, height - 1);
}

Imf::Header header_of(const Image& image, const Metadata& metadata) {
  Imf::Header header(image.width(), image.height());
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& name : image.channels()) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  }
  header.insert(kChannels, Imf::StringVectorAttribute(image.channels()));
  for (const auto& [key, text] : metadata) header.insert(key, Imf::StringAttribute(text));
  return header;
}

/// Writes a file. Throws what OpenEXR throws; its messages call the file `name`.
void write_file(const Image& image, const Metadata& metadata, std::ofstream& out,
                const std::string& name) {
  Imf::StdOFStream stream(out, name.c_str());
  Imf::OutputFile file(stream, header_of(image, metadata), kNoThreads);
  // OpenEXR reads from the buffer, although its type permits writing.
  float* const values = const_cast<float*>(image.values().data());
  file.setFrameBuffer(interleaved(image.channels(), values, image.width()));
  file.writePixels(image.height());
}

}  // namespace

std::optional<Image> read_own_exr(const std::filesystem::path& path) {
  return read_own(path, [](Imf::MultiPartInputFile& file) -> std::optional<Image> {
    if (!file.partComplete(0)) return std::nullopt;
    const auto [width, height] = size_of(file);
    Image image(width, height, *listed_channels(file.header(0)));
    read_channels(file, image.channels(), image.values().data());
    return image;
  });
}

std::optional<ColorImage> read_own_exr_colors(const std::filesystem::path& path) {
  return read_own(path, [](Imf::MultiPartInputFile& file) -> std::optional<ColorImage> {
    if (!file.partComplete(0)) return std::nullopt;
    const Names& all = *listed_channels(file.header(0));
    const auto [red, green, blue] = Image(1, 1, all).color_channels();
    Names colors{all[red]};
    if (green != red) colors.insert(colors.end(), {all[green], all[blue]});
    const auto [width, height] = size_of(file);
    const int channels = static_cast<int>(colors.size());
    ColorImage image(width, height, channels, ColorImage::Depth::single, {});
    read_channels(file, colors, reinterpret_cast<float*>(image.data()));
    return image;
  });
}

std::optional<Metadata> read_own_exr_metadata(const std::filesystem::path& path) {
  return read_own(path, [](Imf::MultiPartInputFile& file) -> std::optional<Metadata> {
    Metadata metadata;
    const Imf::Header& header = file.header(0);
    for (auto entry = header.begin(); entry != header.end(); ++entry) {
      const auto* text = dynamic_cast<const Imf::StringAttribute*>(&entry.attribute());
      if (text != nullptr) metadata[entry.name()] = text->value();
    }
    metadata.erase(kPartType);
    return metadata;
  });
}

void write_exr(const Image& image, const std::filesystem::path& path, const Metadata& metadata) {
  const auto fail = [&](const std::string& why) {
    throw RunError("cannot write the image '" + path.string() + "': " + one_line(why));
  };
  if (image.empty()) fail("it has no pixels");
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    if (!out) fail(std::strerror(errno));
    try {
      write_file(image, metadata, out, path.filename().string());
    } catch (const std::exception& e) {
      fail(e.what());
    }
    // The table of the lines comes last, in a destructor of OpenEXR, which reports no errors.
    out.close();
    if (!out) fail("it could not be written to the end");
  });
}

}  // namespace pharos
