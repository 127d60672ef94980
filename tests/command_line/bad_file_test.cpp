// Wrong files that a config refers to: configs that it extends, scenes, images.

#include <fstream>
#include <limits>
#include <sys/stat.h>

#include <doctest/doctest.h>

#include <pharos/core/image.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

/// `render bad.yaml` in a folder with further files.
Mistake files(const std::string& config,
              const std::vector<std::pair<std::string, std::string>>& others) {
  return {.arguments = "render bad.yaml", .prepare = [=](const ScratchFolder& f) {
            f.write("bad.yaml", config);
            for (const auto& [name, text] : others) f.write(name, text);
          }};
}

TEST_CASE("extends") {
  check_refused("extends: nowhere.yaml\n",
                {"bad.yaml:1:10: error: ", "'nowhere.yaml': no such file"});
  check_refused("extends: bd.yaml\n", {"bad.yaml:1:10: error: ", "'bad.yaml'"});
  check_refused("extends: bad.yaml\n", {"bad.yaml:1:1: error: ", "in a circle"});
  check_refused(files("extends: a.yaml\n", {{"a.yaml", "extends: bad.yaml\n"}}),
                {"a.yaml:1:1: error: ", "in a circle", "'bad.yaml' extends 'a.yaml'"});
  check_refused("extends: .\n", {"found a folder"});
  check_refused("extends: /dev/zero\n", {"/dev/zero", "pipe or device"});
  check_refused("extends: 7\n", {"bad.yaml:1:10: error: ", "'7': no such file"});
  check_refused("extends: { a: b }\n", {"bad.yaml:1:10: error: ", "the path of a config"});
  check_refused("extends: [[a.yaml]]\n", {"bad.yaml:1:11: error: ", "the path of a config"});
  check_refused("extends: \"\"\n", {"bad.yaml:1:10: error: ", "the path of a config"});
  check_refused(files("extends: a.yaml\n", {{"a.yaml", "film: { width: [\n"}}),
                {"a.yaml:", "error: YAML"});
  check_refused(files("extends: a.yaml\n", {{"a.yaml", "film: { width: 0 }\n"}, {"s", ""}}),
                {"bad.yaml:1:1: error: ", "'scene'"});
  check_refused(files(config_with("extends: a.yaml\n"), {{"a.yaml", "film: { width: 0 }\n"}}),
                {"a.yaml:1:16: error: ", "width must be >= 1"});
  check_refused(files("extends: [a.yaml, a.yaml]\n",
                      {{"a.yaml", "extends: [b.yaml, b.yaml, b.yaml, b.yaml]\n"},
                       {"b.yaml", "extends: [c.yaml, c.yaml, c.yaml, c.yaml]\n"},
                       {"c.yaml", "extends: [d.yaml, d.yaml, d.yaml, d.yaml]\n"},
                       {"d.yaml", "extends: [e.yaml, e.yaml, e.yaml, e.yaml]\n"},
                       {"e.yaml", "seed: 1\n"}}),
                {"more than 256 files"});
}

TEST_CASE("presets") {
  check_refused(config_with("integrator: { guiding: fokal }\n"),
                {"bad.yaml:", "there is no preset 'fokal' (did you mean 'focal'?)", "'pavmm'"});
  check_refused(config_with("integrator: { guiding: ../presets/focal }\n"), {"there is no preset"});
  check_refused(config_with("integrator: { type: path, guiding: triplets-flt }\n"),
                {"bad.yaml:",
                 "the preset 'triplets-flt' needs the integrator 'bidirectional', "
                 "found 'path'"});
}

TEST_CASE("scene files") {
  const auto scene = [](const std::string& name) {
    return "scene: " + name + "\nbudget: { spp: 1 }\n";
  };
  check_refused(scene("nowhere.yaml"), {"bad.yaml:1:8: error: ", "nowhere.yaml"});
  check_refused(scene("/"), {"bad.yaml:1:8: error: ", "folder"});
  check_refused(scene(std::string(300, 'x')), {"bad.yaml:1:8: error: ", "the scene '"});
  check_refused(scene("/dev/zero"), {"bad.yaml:1:8: error: ", "pipe or device"});
  check_refused(files(scene("s.yaml"), {{"s.yaml", ""}}), {"s.yaml: error: ", "empty"});
  check_refused(files(scene("s.yaml"), {{"s.yaml", "shapes: [sphere\n"}}), {"s.yaml:", "YAML"});
  check_refused(files(scene("s.yaml"), {{"s.yaml", "sensor: perspective\nshapes: [spehre]\n"}}),
                {"s.yaml:2:10: error: ", "'sphere'"});
  check_refused(files(scene("s.yaml"), {{"s.yaml", "scene: s.yaml\n"}}),
                {"s.yaml:1:1: error: ", "unknown key 'scene'"});
  check_refused(files(scene("s.yaml"), {{"s.yaml", "extends: s.yaml\n"}}),
                {"s.yaml:1:1: error: ", "in a circle"});
  check_refused(scene("bad.yaml"), {"bad.yaml:1:1: error: ", "unknown key 'scene'"});
}

/// Checks that a render of a quad with the image `name`, which `make` writes, is refused.
void check_image_refused(const std::string& name,
                         const std::function<void(const std::filesystem::path&)>& make,
                         const std::vector<std::string>& says) {
  check_refused({.arguments = "render bad.yaml",
                 .prepare =
                     [&](const ScratchFolder& f) {
                       f.write("bad.yaml",
                               config_with_shape("{ type: quad, material: { type: diffuse, "
                                                 "reflectance: { type: bitmap, file: " +
                                                 name + " } } }"));
                       if (make) make(f.path() / name);
                     }},
                says);
}

std::function<void(const std::filesystem::path&)> bytes(std::string text) {
  return [text = std::move(text)](const std::filesystem::path& path) {
    std::ofstream(path, std::ios::binary) << text;
  };
}

TEST_CASE("images that claim to be huge") {
  check_image_refused("huge.ppm", bytes("P6 32000 32000 255\n"),
                      {"bad.yaml:4:", "huge.ppm", "32000 x 32000 pixels, more than the 268435456"});
}

/// Writes a valid image that is cut to a share of its length.
std::function<void(const std::filesystem::path&)> cut(bool exr, double share) {
  return [=](const std::filesystem::path& path) {
    Image image(64, 64, {"R", "G", "B"});
    for (std::size_t i = 0; i < image.values().size(); ++i) {
      image.values()[i] = static_cast<float>(i * 7919 % 1000) / 1000;
    }
    exr ? write_exr(image, path) : write_png(image, path);
    resize_file(path, static_cast<std::uintmax_t>(share * static_cast<double>(file_size(path))));
  };
}

/// Writes only the header of a PNG with this size.
std::string png_header(const std::string& size) {
  return "\x89PNG\r\n\x1a\n" + std::string("\0\0\0\rIHDR", 8) + size +
         std::string("\x08\x02\0\0\0\0\0\0\0", 9);
}

TEST_CASE("images") {
  const std::string place = "bad.yaml:4:";
  check_image_refused("none.png", {}, {place, "none.png", "no such file"});
  check_image_refused("text.exr", bytes("no image\n"), {place, "text.exr"});
  check_image_refused("text.png", bytes("no image\n"), {place, "text.png"});
  check_image_refused("image.xyz", bytes("no image\n"), {place, "image.xyz"});
  check_image_refused("empty.exr", bytes(""), {place, "empty.exr"});
  check_image_refused("empty.png", bytes(""), {place, "empty.png"});
  for (const double share : {0.1, 0.5, 0.98}) {
    check_image_refused("cut.exr", cut(true, share), {place, "cut.exr"});
    check_image_refused("cut.png", cut(false, share), {place, "cut.png"});
  }
  check_image_refused("zero.png", bytes(png_header(std::string(8, '\0'))), {place, "zero.png"});
  check_image_refused("huge.png", bytes(png_header("\x7f\xff\xff\xff\x7f\xff\xff\xff")),
                      {place, "huge.png"});
  check_image_refused("wide.hdr",
                      bytes("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000000000 +X 2000000000\n"),
                      {place, "wide.hdr"});
  check_image_refused("zero.pfm", bytes("PF\n0 0\n-1.0\n"), {place, "zero.pfm"});
  check_image_refused("huge.pfm", bytes("PF\n60000 60000\n-1.0\n"), {place, "huge.pfm"});
  check_image_refused("folder.exr", [](const auto& path) { create_directory(path); },
                      {place, "folder.exr", "found a folder"});
  check_image_refused("pipe.exr", [](const auto& path) { mkfifo(path.c_str(), 0600); },
                      {place, "pipe.exr", "pipe or device"});
  check_image_refused("/dev/zero", {}, {place, "/dev/zero", "pipe or device"});
}

TEST_CASE("images that are no colors") {
  for (const float value :
       {-1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    check_image_refused("values.exr",
                        [&](const std::filesystem::path& path) {
                          Image image(3, 2, {"R", "G", "B"});
                          image.pixel(2, 1)[1] = value;
                          write_exr(image, path);
                        },
                        {"values.exr", "pixel (2, 1)"});
  }
  check_image_refused("bright.exr",
                      [](const std::filesystem::path& path) {
                        Image image(3, 2, {"R", "G", "B"});
                        image.pixel(1, 1)[1] = 1.5f;
                        write_exr(image, path);
                      },
                      {"bad.yaml:4:", "at most 1"});
}

}  // namespace
}  // namespace pharos::testing
