// SPDX-License-Identifier: MIT
#include <glint/io/file.hpp>  // first, so the header proves it stands alone

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_file {

using glint::IoError;
using glint::read_file;
using glint::replace_file;
using glint::testing::content_of;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;

namespace {

auto writer(std::string content) {
  return [content = std::move(content)](std::ofstream& stream) { stream << content; };
}

}  // namespace

TEST_CASE("file: every byte is read, zeros and line ends included", "[io][file]") {
  const TemporaryDirectory directory;
  std::string content;
  for (int i = 0; i < 200'000; ++i) content.push_back(static_cast<char>(i));
  CHECK(read_file(directory.write("bytes", content)) == content);
  CHECK(read_file(directory.write("empty", "")).empty());
}

TEST_CASE("file: reading what is missing or a directory is an error that says so", "[io][file]") {
  const TemporaryDirectory directory;
  const auto missing = directory / "missing";
  CHECK(message_of<IoError>([&] { (void)read_file(missing); }) ==
        missing.string() + ": cannot be read: No such file or directory");
  CHECK(message_of<IoError>([&] { (void)read_file(directory.path()); }) ==
        directory.path().string() + ": is a directory, expected a file");
}

TEST_CASE("file: a replaced file holds the new content and leaves nothing beside it", "[io][file]") {
  const TemporaryDirectory directory;
  const auto path = directory.write("image", "a longer former content");
  replace_file(path, writer("new"));
  CHECK(content_of(path) == "new");
  CHECK(directory.entries() == 1);
}

TEST_CASE("file: the former content stays until the new one is complete", "[io][file]") {
  const TemporaryDirectory directory;
  const auto path = directory.write("image", "former");
  replace_file(path, [&](std::ofstream& stream) {
    stream << "new" << std::flush;
    CHECK(content_of(path) == "former");
  });
  CHECK(content_of(path) == "new");
}

TEST_CASE("file: a writer that throws changes nothing and leaves nothing", "[io][file]") {
  const TemporaryDirectory directory;
  const auto path = directory.write("image", "former");
  const auto fail = [](std::ofstream& stream) {
    stream << "half";
    throw std::runtime_error("no more");
  };
  CHECK_THROWS_AS(replace_file(path, fail), std::runtime_error);
  CHECK(content_of(path) == "former");
  CHECK(directory.entries() == 1);
}

TEST_CASE("file: a stream that failed is an error, even if the writer did not notice", "[io][file]") {
  const TemporaryDirectory directory;
  const auto path = directory.write("image", "former");
  const auto fail = [](std::ofstream& stream) { stream.setstate(std::ios::badbit); };
  CHECK(message_of<IoError>([&] { replace_file(path, fail); }) ==
        path.string() + ": writing failed: is the disk full?");
  CHECK(content_of(path) == "former");
  CHECK(directory.entries() == 1);
}

TEST_CASE("file: a folder that is missing, or is a file, cannot be written to", "[io][file]") {
  const TemporaryDirectory directory;
  const auto in_missing = directory / "missing/image";
  CHECK(message_of<IoError>([&] { replace_file(in_missing, writer("")); }) ==
        in_missing.string() + ": cannot be written: No such file or directory");
  const auto in_file = directory.write("plain", "") / "image";
  CHECK(message_of<IoError>([&] { replace_file(in_file, writer("")); }) ==
        in_file.string() + ": cannot be written: Not a directory");
}

TEST_CASE("file: a directory and a device are not replaced", "[io][file]") {
  const TemporaryDirectory directory;
  CHECK(message_of<IoError>([&] { replace_file(directory.path(), writer("")); }) ==
        directory.path().string() + ": cannot be written: it is a directory");
  CHECK(message_of<IoError>([&] { replace_file("/dev/null", writer("")); }) ==
        "/dev/null: cannot be written: it is not a regular file");
}

TEST_CASE("file: a folder without permission to write is an error, and stays as it was", "[io][file]") {
  const TemporaryDirectory directory;
  const auto folder = directory / "locked";
  std::filesystem::create_directory(folder);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  if (std::ofstream(folder / "probe")) {
    WARN("skipped: this user may write everywhere");
    return;
  }
  CHECK(message_of<IoError>([&] { replace_file(folder / "image", writer("")); }) ==
        (folder / "image").string() + ": cannot be written: Permission denied");
}

TEST_CASE("file: writing through a link replaces the file behind it", "[io][file]") {
  const TemporaryDirectory directory;
  const auto path = directory.write("image", "former");
  std::filesystem::create_symlink("image", directory / "link");
  replace_file(directory / "link", writer("new"));
  CHECK(std::filesystem::is_symlink(directory / "link"));
  CHECK(content_of(path) == "new");
}

TEST_CASE("file: of many writers at once, one wins as a whole", "[io][file]") {
  const TemporaryDirectory directory;
  const auto path = directory / "image";
  std::vector<std::thread> writers;
  for (char name = 'a'; name < 'i'; ++name) {
    writers.emplace_back([&, name] {
      for (int i = 0; i < 20; ++i) replace_file(path, writer(std::string(20'000, name)));
    });
  }
  for (auto& thread : writers) thread.join();
  const std::string content = content_of(path);
  REQUIRE(content.size() == 20'000);
  CHECK(content == std::string(20'000, content[0]));
  CHECK(directory.entries() == 1);
}

}  // namespace test_io_file
