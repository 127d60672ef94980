// Checkpoint files: read back as they were written; all damage is reported.

#include <memory>

#include <doctest/doctest.h>

#include <pharos/rendering/checkpoint.h>

#include "fixtures.h"

namespace pharos::test {
namespace {

const SavedRender kSaved{
    .config = "budget: { spp: 4 }", .build = "abc", .finished = true, .state = "a state"};

/// Returns the error message for a file of these bytes.
std::string refusal(const TemporaryFolder& folder, const std::string& bytes) {
  const std::filesystem::path path = folder.write("changed", bytes);
  return input_error_in(folder, [&] { read_checkpoint(path); });
}

std::string sound_file(const TemporaryFolder& folder) {
  write_checkpoint(kSaved, folder / "sound");
  return bytes_of(folder / "sound");
}

TEST_CASE("checkpoint files: what is read is what was written") {
  const TemporaryFolder folder;
  write_checkpoint(kSaved, folder / "a");
  const SavedRender read = read_checkpoint(folder / "a");
  CHECK(read.config == kSaved.config);
  CHECK(read.build == kSaved.build);
  CHECK(read.finished);
  CHECK(read.state == kSaved.state);
}

TEST_CASE("checkpoint files: every flipped bit and every shorter file is refused") {
  const TemporaryFolder folder;
  const std::string sound = sound_file(folder);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    CAPTURE(i);
    CHECK(refusal(folder, sound.substr(0, i)) != "no error");
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = sound;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      CHECK(refusal(folder, damaged) != "no error");
    }
  }
  CHECK(refusal(folder, sound + "x").find("goes on after its end") != std::string::npos);
  CHECK(refusal(folder, "text").find("is no checkpoint of Pharos") != std::string::npos);
  CHECK(input_error_in(folder, [&] { read_checkpoint(folder / "none"); }).find("none") !=
        std::string::npos);
}

TEST_CASE("a writer writes what is due, and removes what dead writers have left") {
  const TemporaryFolder folder;
  // Processes have at most seven digits on Linux.
  const std::filesystem::path dead = folder.write("a.99999999.tmp", "left");
  const std::filesystem::path other = folder.write("a.b.tmp", "of someone else");
  std::string warning;
  {
    CheckpointWriter writer(folder / "a", kSaved, 1e9,
                            [&](const std::string& message) { warning += message; });
    CHECK_FALSE(std::filesystem::exists(dead));
    CHECK(std::filesystem::exists(other));
    CHECK_FALSE(writer.is_due());
    writer.request();
    CHECK(writer.is_due());
    writer.write("new", false);
    CHECK_FALSE(writer.is_due());
    CHECK(writer.finish());
  }
  CHECK(read_checkpoint(folder / "a").state == "new");
  CHECK(warning.empty());

  std::filesystem::create_directory(folder / "b");
  CheckpointWriter lost(folder / "b" / "a", kSaved, 1e9,
                        [&](const std::string& message) { warning += message; });
  std::filesystem::remove_all(folder / "b");
  lost.write("new", false);
  CHECK_FALSE(lost.finish());
  CHECK(warning.find("no checkpoint: cannot write") != std::string::npos);
}

TEST_CASE("a checkpoint has one writer at a time, which replaces no other file") {
  const TemporaryFolder folder;
  const auto writer = [&](const char* name) {
    return std::make_unique<CheckpointWriter>(folder / name, kSaved, 1e9,
                                              [](const std::string&) {});
  };
  auto first = writer("a");
  CHECK(input_error_in(folder, [&] { writer("a"); }) ==
        "the checkpoint 'a' is being written by another render: choose another name, or wait until "
        "it ends");
  first.reset();
  CHECK_FALSE(std::filesystem::exists(folder / "a.pharos-lock"));
  writer("a");
  folder.write("empty", "");
  writer("empty");
  // A link and what it points to are the same checkpoint.
  write_checkpoint(kSaved, folder / "b");
  std::filesystem::create_symlink(folder / "b", folder / "link");
  first = writer("link");
  CHECK(input_error_in(folder, [&] { writer("b"); }).find("another render") != std::string::npos);
  first->skip("no memory");
  CHECK_FALSE(first->is_due());
  CHECK_FALSE(first->finish());
  folder.write("notes", "text");
  CHECK(input_error_in(folder, [&] { writer("notes"); }) ==
        "the checkpoint 'notes' exists and is no checkpoint of Pharos, so it is not overwritten: "
        "choose another name");
}

}  // namespace
}  // namespace pharos::test
