// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/tree.hpp>
#include <glint/core/hash.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/io/error.hpp>
#include <glint/io/file.hpp>

namespace glint {

/// What a tree was built over, so that a file is not taken for a tree over something else.
struct TreeOrigin {
  std::uint64_t key = 0;         ///< whatever tells geometries apart, as their hash does; 0 where nobody asks
  std::uint64_t primitives = 0;  ///< the size of the set

  [[nodiscard]] friend bool operator==(const TreeOrigin&, const TreeOrigin&) = default;
};

/// The arrays of a tree, wherever they are.
template <std::floating_point T, std::unsigned_integral I = std::uint32_t>
struct TreeView {
  std::span<const BinaryNode<T, I>> nodes{};
  std::span<const I> order{};
  int depth = 0;
  std::size_t left_out = 0;
};

namespace detail {

/// The first bytes of a file. All numbers are little-endian; nodes follow, then the order, and nothing else.
struct TreeFileHeader {
  std::array<char, 8> magic{'g', 'l', 'i', 'n', 't', 'r', 'e', 'e'};
  std::uint32_t version = 1;
  std::uint16_t scalar_bytes = 0;
  std::uint16_t index_bytes = 0;
  TreeOrigin origin{};
  std::uint64_t nodes = 0;
  std::uint64_t slots = 0;
  std::uint32_t left_out = 0;
  std::uint32_t depth = 0;
  std::uint64_t checksum = 0;  ///< hash_bytes of the file, with zeros here
};
static_assert(sizeof(TreeFileHeader) == 64 && std::endian::native == std::endian::little);

/// Of a header, with zeros for its checksum, and of all that follows it.
[[nodiscard]] inline std::uint64_t tree_checksum(TreeFileHeader header, std::span<const std::byte> content) noexcept {
  header.checksum = 0;
  return hash_bytes(content, hash_values(std::span<const TreeFileHeader>(&header, 1)));
}

[[noreturn]] inline void fail_tree(const std::filesystem::path& path, std::size_t byte, const std::string& problem) {
  throw IoError(path, "byte " + std::to_string(byte), problem);
}

template <typename A>
void expect_in_tree(const std::filesystem::path& path, std::size_t byte, const char* what, const A& found,
                    const A& expected) {
  if (found != expected)
    fail_tree(path, byte,
              std::string(what) + " is " + std::to_string(found) + ", expected " + std::to_string(expected));
}

/// The header of a file whose size, kind, origin and checksum are right.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] TreeFileHeader checked_header(const std::filesystem::path& path, std::span<const std::byte> bytes,
                                            const TreeOrigin& origin) {
  TreeFileHeader header;
  if (bytes.size() < sizeof(header)) {
    fail_tree(path, bytes.size(), "the file ends, expected the 64 bytes with which a tree begins");
  }
  std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof(header));
  if (header.magic != TreeFileHeader{}.magic) fail_tree(path, 0, "is no file of a tree, expected \"glintree\"");
  expect_in_tree(path, 8, "the version", header.version, TreeFileHeader{}.version);
  expect_in_tree<std::size_t>(path, 12, "the size of a number", header.scalar_bytes, sizeof(T));
  expect_in_tree<std::size_t>(path, 14, "the size of an index", header.index_bytes, sizeof(I));
  constexpr std::size_t node_bytes = sizeof(BinaryNode<T, I>);
  static_assert(node_bytes == 6 * sizeof(T) + 2 * sizeof(I));
  const std::size_t room = bytes.size() - sizeof(header);
  if (header.nodes > room / node_bytes || header.slots != (room - header.nodes * node_bytes) / sizeof(I) ||
      (room - header.nodes * node_bytes) % sizeof(I) != 0) {
    fail_tree(path, bytes.size(),
              "the file ends, which does not fit its " + std::to_string(header.nodes) + " nodes and " +
                  std::to_string(header.slots) + " slots");
  }
  expect_in_tree(path, 56, "the checksum", header.checksum, tree_checksum(header, bytes.subspan(sizeof(header))));
  expect_in_tree(path, 16, "the key", header.origin.key, origin.key);
  expect_in_tree(path, 24, "the number of primitives", header.origin.primitives, origin.primitives);
  return header;
}

/// Checks all that traversal relies on.
template <std::floating_point T, std::unsigned_integral I>
class TreeFileCheck {
 public:
  TreeFileCheck(const std::filesystem::path& path, const TreeView<T, I>& tree, std::uint64_t primitives)
      : path_(path),
        tree_(tree),
        primitives_(primitives),
        has_parent_(tree.nodes.size()),
        in_leaf_(tree.order.size()) {}

  void run() {
    const std::size_t order_at = sizeof(TreeFileHeader) + tree_.nodes.size_bytes();
    for (std::size_t slot = 0; slot != tree_.order.size(); ++slot)
      if (tree_.order[slot] >= primitives_) {
        fail_tree(path_, order_at + slot * sizeof(I),
                  "found primitive " + std::to_string(tree_.order[slot]) + ", expected less than " +
                      std::to_string(primitives_));
      }
    if (!tree_.nodes.empty()) pending_.emplace_back(std::size_t{0}, 0);
    int depth = 0;
    while (!pending_.empty()) {
      const auto [at, steps] = pending_.back();
      pending_.pop_back();
      if (steps > Tree<T, I>::max_depth) fail(at, "is too deep, expected at most 64 steps from the root");
      depth = std::max(depth, steps);
      visit(at, steps);
    }
    expect_in_tree(path_, 52, "the depth", tree_.depth, depth);
    require_all(has_parent_, tree_.nodes.empty() ? 0 : 1, sizeof(TreeFileHeader), sizeof(BinaryNode<T, I>),
                "is a node without a parent");
    require_all(in_leaf_, 0, order_at, sizeof(I), "is a slot of no leaf");
  }

 private:
  [[noreturn]] void fail(std::size_t node, const std::string& problem) const {
    fail_tree(path_, sizeof(TreeFileHeader) + node * sizeof(BinaryNode<T, I>),
              "node " + std::to_string(node) + " " + problem);
  }
  void require_all(const std::vector<bool>& marks, std::size_t first, std::size_t at, std::size_t size,
                   const char* problem) const {
    for (std::size_t i = first; i < marks.size(); ++i)
      if (!marks[i]) fail_tree(path_, at + i * size, problem);
  }

  void visit(std::size_t at, int steps) {
    const BinaryNode<T, I>& node = tree_.nodes[at];
    if (!is_bounded(node.bounds) && node.bounds != Aabb<T>{}) fail(at, "has no box, expected a finite or an empty one");
    if (node.is_leaf())
      mark(at, in_leaf_, node.first, node.count, "has slots that are not there, or another leaf's");
    else
      visit_children(at, steps);
  }
  void visit_children(std::size_t at, int steps) {
    const BinaryNode<T, I>& node = tree_.nodes[at];
    if (node.first == 0) fail(at, "has the root as a child");
    mark(at, has_parent_, node.first, 2, "has children that are not there, or another node's");
    for (const std::size_t child : {std::size_t(node.first), std::size_t(node.first) + 1}) {
      if (!contains(node.bounds, tree_.nodes[child].bounds)) fail(at, "does not hold its children");
      pending_.emplace_back(child, steps + 1);
    }
  }
  void mark(std::size_t at, std::vector<bool>& marks, std::size_t first, std::size_t count, const char* problem) const {
    if (first > marks.size() || count > marks.size() - first) fail(at, problem);
    for (std::size_t i = first; i != first + count; ++i) {
      if (marks[i]) fail(at, problem);
      marks[i] = true;
    }
  }

  const std::filesystem::path& path_;
  const TreeView<T, I>& tree_;
  std::uint64_t primitives_;
  std::vector<bool> has_parent_;
  std::vector<bool> in_leaf_;
  std::vector<std::pair<std::size_t, int>> pending_;
};

}  // namespace detail

/// Writes a tree, in one step: 64 bytes that say what follows, its nodes and its order as they are in memory of a
/// little-endian machine.
///
/// Errors: IoError where the file cannot be written.
template <std::floating_point T, std::unsigned_integral I>
void write_tree(const Tree<T, I>& tree, const std::filesystem::path& path, const TreeOrigin& origin) {
  const auto nodes = std::as_bytes(std::span(tree.nodes));
  const auto order = std::as_bytes(std::span(tree.order));
  std::vector<std::byte> content(nodes.begin(), nodes.end());
  content.insert(content.end(), order.begin(), order.end());
  detail::TreeFileHeader header{.scalar_bytes = sizeof(T),
                                .index_bytes = sizeof(I),
                                .origin = origin,
                                .nodes = tree.nodes.size(),
                                .slots = tree.order.size(),
                                .left_out = std::uint32_t(tree.left_out),
                                .depth = std::uint32_t(tree.depth)};
  header.checksum = detail::tree_checksum(header, content);
  replace_file(path, [&](std::ofstream& stream) {
    const auto put = [&](const void* bytes, std::size_t size) {
      stream.write(static_cast<const char*>(bytes), std::streamsize(size));
    };
    put(&header, sizeof(header));
    put(content.data(), content.size());
  });
}

/// Reads a tree that write_tree wrote.
///
/// Ensures: a tree that can be walked: what it refers to is there, each node and slot once; boxes hold those below them
///          and have no NaN; no primitive is beyond the set.
/// Errors:  IoError where the file cannot be read, is damaged, or is of another version, origin, scalar or index. It
///          names the byte, counted from 0, what was found there and what was expected.
template <std::floating_point T, std::unsigned_integral I = std::uint32_t>
[[nodiscard]] Tree<T, I> read_tree(const std::filesystem::path& path, const TreeOrigin& origin) {
  const std::string content = read_file(path);
  const std::span<const std::byte> bytes = std::as_bytes(std::span(content));
  const detail::TreeFileHeader header = detail::checked_header<T, I>(path, bytes, origin);
  Tree<T, I> tree{.nodes = std::vector<BinaryNode<T, I>>(header.nodes),
                  .order = std::vector<I>(header.slots),
                  .depth = int(header.depth),
                  .left_out = header.left_out};
  const auto copy = [&](std::span<const std::byte> from, auto& to) {
    if (!to.empty()) std::memcpy(static_cast<void*>(to.data()), from.data(), std::span(to).size_bytes());
  };
  copy(bytes.subspan(sizeof(header)), tree.nodes);
  copy(bytes.subspan(sizeof(header) + std::span(tree.nodes).size_bytes()), tree.order);
  const TreeView<T, I> view{tree.nodes, tree.order, tree.depth, tree.left_out};
  detail::TreeFileCheck<T, I>(path, view, origin.primitives).run();
  return tree;
}

}  // namespace glint
