// SPDX-License-Identifier: MIT
#include <glint/io/tree_file.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_tree_file {

namespace {

using glint::IoError;
using glint::read_tree;
using glint::Tree;
using glint::TreeOrigin;
using glint::write_tree;
using glint::testing::content_of;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;

template <typename T>
Tree<T> some_tree(std::size_t triangles) {
  const auto buffers = glint::testing::scanned_blob<T>(triangles, 1);
  return glint::BinnedSah{}.build(glint::view(buffers));
}

/// Gives a file that was changed the checksum it should have.
std::string sealed(std::string content) {
  glint::detail::TreeFileHeader header;
  std::memcpy(static_cast<void*>(&header), content.data(), sizeof(header));
  header.checksum = glint::detail::tree_checksum(header, std::as_bytes(std::span(content)).subspan(sizeof(header)));
  std::memcpy(content.data(), &header, sizeof(header));
  return content;
}

}  // namespace

TEMPLATE_TEST_CASE("tree file: what is read is what was written", "[io][tree_file]", float, double) {
  const TemporaryDirectory directory;
  Tree<TestType> tree = some_tree<TestType>(300);
  tree.left_out = 7;
  const TreeOrigin origin{.key = 0xFEDCBA9876543210U, .primitives = tree.order.size() + 7};
  write_tree(tree, directory / "tree", origin);
  CHECK(read_tree<TestType>(directory / "tree", origin) == tree);
  // 64 bytes, six numbers and two indices a node, an index a slot.
  CHECK(std::filesystem::file_size(directory / "tree") ==
        64 + tree.nodes.size() * (6 * sizeof(TestType) + 8) + tree.order.size() * 4);
  write_tree(Tree<TestType>{}, directory / "none", {});
  CHECK(read_tree<TestType>(directory / "none", {}) == Tree<TestType>{});
}

TEST_CASE("tree file: bytes are those of the manual, little end first", "[io][tree_file]") {
  const TemporaryDirectory directory;
  const Tree<float> tree{.nodes = {{.bounds = {{0, 0, 0}, {1, 1, 1}}, .first = 0, .count = 1}}, .order = {258}};
  write_tree(tree, directory / "tree", {.key = 5, .primitives = 259});
  const std::string bytes = content_of(directory / "tree");
  REQUIRE(bytes.size() == 64 + 32 + 4);
  CHECK(bytes.substr(0, 16) == std::string("glintree\1\0\0\0\4\0\4\0", 16));
  CHECK(bytes.substr(16, 8) == std::string("\5\0\0\0\0\0\0\0", 8));
  CHECK(bytes.substr(64 + 12, 4) == std::string("\0\0\x80\x3f", 4));  // 1.0F
  CHECK(bytes.substr(64 + 28, 4) == std::string("\1\0\0\0", 4));
  CHECK(bytes.substr(96) == std::string("\2\1\0\0", 4));
}

TEST_CASE("tree file: every flipped byte is an error, and every shortened file is", "[io][tree_file]") {
  const TemporaryDirectory directory;
  const Tree<float> tree = some_tree<float>(60);
  const TreeOrigin origin{.primitives = tree.order.size()};
  write_tree(tree, directory / "tree", origin);
  const std::string good = content_of(directory / "tree");
  const auto is_error = [&](const std::string& content) {
    const std::string path = directory.write("damaged", content).string();
    return message_of<IoError>([&] { (void)read_tree<float>(path, origin); }).starts_with(path + ":byte ");
  };
  for (std::size_t i = 0; i != good.size(); ++i) {
    std::string bad = good;
    bad[i] = char(~bad[i]);
    CAPTURE(i);
    CHECK(is_error(bad));
    CHECK(is_error(good.substr(0, i)));
  }
  CHECK(is_error(good + '\0'));
}

TEST_CASE("tree file: a forged file is an error, or a tree that can be walked", "[io][tree_file]") {
  const TemporaryDirectory directory;
  const Tree<float> tree = some_tree<float>(60);
  const TreeOrigin origin{.primitives = tree.order.size()};
  write_tree(tree, directory / "tree", origin);
  const std::string good = content_of(directory / "tree");
  int errors = 0;
  int walked = 0;
  for (std::size_t i = 0; i != good.size(); ++i) {
    for (const unsigned change : {0x01U, 0x80U, 0xFFU}) {
      std::string bad = good;
      bad[i] = char(static_cast<unsigned char>(bad[i]) ^ change);
      const auto path = directory.write("forged", sealed(bad));
      try {
        const Tree<float> read = read_tree<float>(path, origin);
        std::vector<std::string> wrong;
        glint::detail::NodeCheck(read, wrong).run();
        CHECK(wrong.empty());
        ++walked;
      } catch (const IoError&) {
        ++errors;
      }
    }
  }
  CHECK(errors > walked);
  CHECK(walked > 0);  // a larger root, another order
}

TEST_CASE("tree file: each error names the byte, what is there, and what was expected", "[io][tree_file]") {
  const TemporaryDirectory directory;
  // A root (node 0) over two leaves (1, 2) of one slot each: nodes at 64, 96, 128; slots at 160, 164.
  const glint::Aabb<float> whole{{0, 0, 0}, {2, 1, 1}};
  const Tree<float> good{.nodes = {{whole, 1, 0}, {{{0, 0, 0}, {1, 1, 1}}, 0, 1}, {{{1, 0, 0}, {2, 1, 1}}, 1, 1}},
                         .order = {0, 1},
                         .depth = 1};
  const auto error_of = [&](const Tree<float>& tree, const TreeOrigin& origin = {.primitives = 2}) {
    write_tree(tree, directory / "tree", {.primitives = 2});
    return message_of<IoError>([&] { (void)read_tree<float>(directory / "tree", origin); },
                               (directory / "tree").string());
  };
  const auto with = [&](auto change) {
    Tree<float> tree = good;
    change(tree);
    return error_of(tree);
  };
  CHECK(error_of(good) == "no error");
  CHECK(error_of(good, {.primitives = 3}) == ":byte 24: the number of primitives is 2, expected 3");
  CHECK(error_of(good, {.key = 9, .primitives = 2}) == ":byte 16: the key is 0, expected 9");
  CHECK(message_of<IoError>([&] { (void)read_tree<double>(directory / "tree", {.primitives = 2}); },
                            (directory / "tree").string()) == ":byte 12: the size of a number is 4, expected 8");
  CHECK(with([](auto& t) { t.order[1] = 2; }) == ":byte 164: found primitive 2, expected less than 2");
  CHECK(with([](auto& t) { t.depth = 2; }) == ":byte 52: the depth is 2, expected 1");
  CHECK(with([](auto& t) { t.nodes[0].first = 0; }) == ":byte 64: node 0 has the root as a child");
  CHECK(with([](auto& t) { t.nodes[0].first = 2; }) ==
        ":byte 64: node 0 has children that are not there, or another node's");
  CHECK(with([](auto& t) {
          t.nodes[1] = {t.nodes[1].bounds, 1, 0};
        }) == ":byte 96: node 1 has children that are not there, or another node's");  // a cycle
  CHECK(with([](auto& t) { t.nodes[2].first = 0; }) ==
        ":byte 96: node 1 has slots that are not there, or another leaf's");
  CHECK(with([](auto& t) { t.nodes[2].count = 4'000'000'000; }) ==
        ":byte 128: node 2 has slots that are not there, or another leaf's");
  CHECK(with([](auto& t) { t.nodes[2].bounds.upper.x = 3; }) == ":byte 64: node 0 does not hold its children");
  CHECK(with([](auto& t) { t.nodes[0].bounds.lower.y = std::numeric_limits<float>::quiet_NaN(); }) ==
        ":byte 64: node 0 has no box, expected a finite or an empty one");
  CHECK(with([](auto& t) { t.order.push_back(0); }) == ":byte 168: is a slot of no leaf");
  CHECK(with([](auto& t) { t.nodes.push_back(t.nodes[1]); }) == ":byte 160: is a node without a parent");
  CHECK(with([](auto& t) { t = {.order = {0}}; }) == ":byte 64: is a slot of no leaf");
}

}  // namespace test_io_tree_file
