// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace glint::bench {

struct PeerOptions {
  bool help = false;
  bool quick = false;
  int threads = 2;
  std::size_t max_triangles = 2'000'000;
  std::vector<std::string> mesh_files;
  std::vector<std::string> only;
};

inline constexpr std::string_view peers_help =
    R"(bench_peers [--mesh FILE]... [--threads N] [--quick] [--max-triangles N] [--only NAME]...

Measures glint against Embree, side by side in turns: rays on one thread, builds on one and on several.

  --mesh FILE         an OBJ file, any number of times; without, meshes made by rule
  --threads N         of the builds that use several, 2 unless given
  --quick             small meshes, few rays: whether it works, not how fast it is
  --max-triangles N   of the meshes made by rule, at most
  --only NAME         nothing else of its kind, any number of times: a mesh, one of our trees, a setting of Embree,
                      or of primary, diffuse, ao, shadow, build
  --help

Lines to be read by programs:
  RATIO mesh rays ours theirs r       rays a second, ours over theirs
  BUILD mesh ours threads r           time of a build, theirs over ours
  BYTES mesh ours b b                 bytes a triangle beside the mesh, ours and theirs
  WRONG mesh n                        answers of ours that are wrong; the exit status is 1 unless all are right
)";

inline constexpr std::string_view queries_help =
    R"(bench_queries [--mesh FILE]... [--quick] [--max-triangles N] [--only NAME]...

Measures what is asked of a tree beside rays against Embree, side by side in turns, on one thread.

  --mesh FILE         an OBJ file, any number of times; without, meshes made by rule
  --quick             small meshes, few questions: whether it works, not how fast it is
  --max-triangles N   of the meshes made by rule, at most
  --only NAME         nothing else of its kind, any number of times: a mesh, or of
                        near      the closest point of the mesh, asked from beside it
                        far       the same from anywhere about it
                        radius    the same where it may be no farther than a fiftieth of the mesh's size
                        pairs     the triangles of two meshes that overlap
                        instances rays, into a thousand instances of the mesh
                        refit     vertices that moved, until rays can be cast
  --help

Lines to be read by programs:
  RATIO mesh what ours theirs r       time of theirs over time of ours
  WRONG mesh n                        answers of ours that are wrong; the exit status is 1 unless all are right
)";

[[nodiscard]] inline std::size_t positive_number(const std::string& option, const std::string& text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value == 0 || value > 1'000'000'000)
    throw std::runtime_error(option + " takes a positive whole number, not '" + text + "'");
  return value;
}

/// Options are those that `help` names. Errors: what is not an option, or lacks its value.
[[nodiscard]] inline PeerOptions parse_peer_options(const std::vector<std::string>& arguments, std::string_view help) {
  PeerOptions options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& option = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) throw std::runtime_error(option + " takes a value");
      return arguments[++i];
    };
    if (help.find("\n  " + option + ' ') == help.npos && option != "--help")
      throw std::runtime_error("unknown option '" + option + "'; --help shows those there are");
    if (option == "--help")
      options.help = true;
    else if (option == "--quick")
      options.quick = true;
    else if (option == "--mesh")
      options.mesh_files.push_back(value());
    else if (option == "--only")
      options.only.push_back(value());
    else if (option == "--threads")
      options.threads = int(positive_number("--threads", value()));
    else
      options.max_triangles = positive_number("--max-triangles", value());
  }
  if (options.quick) options.max_triangles = std::min<std::size_t>(options.max_triangles, 4000);
  return options;
}

/// Which names of a kind were asked for; all, if none of the kind was.
[[nodiscard]] inline bool is_wanted(const PeerOptions& options, const std::vector<std::string>& kind,
                                    const std::string& name) {
  const auto asked = [&](const std::string& n) {
    return std::find(options.only.begin(), options.only.end(), n) != options.only.end();
  };
  return asked(name) || std::none_of(kind.begin(), kind.end(), asked);
}

/// Errors: a name after --only that is of no kind.
inline void check_names(const PeerOptions& options, const std::vector<std::vector<std::string>>& kinds) {
  std::vector<std::string> known;
  for (const std::vector<std::string>& kind : kinds) known.insert(known.end(), kind.begin(), kind.end());
  for (const std::string& name : options.only) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string list;
    for (const std::string& one : known) list += ' ' + one;
    throw std::runtime_error("--only does not know '" + name + "'; there are:" + list);
  }
}

}  // namespace glint::bench
