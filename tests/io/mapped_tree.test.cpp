// SPDX-License-Identifier: MIT
#include <glint/io/mapped_tree.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_mapped_tree {

namespace {

using glint::IoError;
using glint::MappedFile;
using glint::MappedTree;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;

std::string text_of(const MappedFile& file) {
  std::string text;
  for (const std::byte b : file.bytes()) text.push_back(char(b));
  return text;
}

}  // namespace

TEST_CASE("mapped file: its bytes are the file's, mapped or read", "[io][mapped_tree]") {
  const TemporaryDirectory directory;
  const MappedFile file(directory.write("file", "some bytes"));
  CHECK(file.is_mapped());
  CHECK(text_of(file) == "some bytes");
  const MappedFile empty(directory.write("empty", ""));  // which cannot be mapped
  CHECK_FALSE(empty.is_mapped());
  CHECK(empty.bytes().empty());
  const std::filesystem::path unmappable = "/proc/version";  // its size is said to be 0
  if (std::filesystem::exists(unmappable)) CHECK(text_of(MappedFile(unmappable)) == glint::read_file(unmappable));
}

TEST_CASE("mapped file: what is missing or a directory is an error", "[io][mapped_tree]") {
  const TemporaryDirectory directory;
  const auto path = directory / "missing";
  CHECK(message_of<IoError>([&] { MappedFile{path}; }) ==
        path.string() + ": cannot be read: No such file or directory");
  CHECK(message_of<IoError>([&] { MappedFile{directory.path()}; }) ==
        directory.path().string() + ": is a directory, expected a file");
}

TEMPLATE_TEST_CASE("mapped tree: its arrays are those of the tree that was written", "[io][mapped_tree]", float,
                   double) {
  const TemporaryDirectory directory;
  const auto buffers = glint::testing::scanned_blob<TestType>(500, 1);
  const auto tree = glint::BinnedSah{}.build(glint::view(buffers));
  write_tree(tree, directory / "tree", {.key = 3, .primitives = buffers.indices.size() / 3});
  MappedTree<TestType> first(directory / "tree", {.key = 3, .primitives = buffers.indices.size() / 3});
  const MappedTree<TestType> mapped = std::move(first);
  write_tree(glint::Tree<TestType>{}, directory / "tree", {});  // another file takes its place: nothing changes here
  CHECK(std::equal(tree.nodes.begin(), tree.nodes.end(), mapped.view().nodes.begin(), mapped.view().nodes.end()));
  CHECK(std::equal(tree.order.begin(), tree.order.end(), mapped.view().order.begin(), mapped.view().order.end()));
  CHECK(mapped.view().depth == tree.depth);
  CHECK(mapped.view().left_out == tree.left_out);
}

TEST_CASE("mapped tree: every flipped byte is an error, and every shortened file is", "[io][mapped_tree]") {
  const TemporaryDirectory directory;
  const auto buffers = glint::testing::scanned_blob<float>(40, 1);
  write_tree(glint::BinnedSah{}.build(glint::view(buffers)), directory / "tree",
             {.primitives = buffers.indices.size() / 3});
  const std::string good = glint::testing::content_of(directory / "tree");
  const auto is_error = [&](const std::string& content) {
    const auto path = directory.write("damaged", content);
    return message_of<IoError>([&] { MappedTree<float>(path, {.primitives = buffers.indices.size() / 3}); }) !=
           "no error";
  };
  CHECK_FALSE(is_error(good));
  for (std::size_t i = 0; i != good.size(); ++i) {
    std::string bad = good;
    bad[i] = char(~bad[i]);
    CAPTURE(i);
    CHECK(is_error(bad));
    CHECK(is_error(good.substr(0, i)));
  }
}

}  // namespace test_io_mapped_tree
