// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include <peers/contenders.hpp>
#include <peers/embree.hpp>
#include <peers/race.hpp>
#include <support/named_mesh.hpp>
#include <support/timing.hpp>

/// What was measured, for people and for programs.
namespace glint::bench {

/// The fastest of ours over the fastest of theirs; theirs of the same kind of edges, ours of it or of a stricter one.
inline void print_best(const std::string& mesh, const Contenders& contenders, const Measured& measured, Call call,
                       Edges edges) {
  std::size_t best[2] = {contenders.size(), contenders.size()};
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const bool ours = is_ours(contenders[i]);
    const bool allowed = contenders[i].call == call &&
                         (contenders[i].edges == edges || (ours && contenders[i].edges == Edges::Watertight));
    std::size_t& leader = best[ours ? 0 : 1];
    if (allowed && (leader == contenders.size() || mega_rays(measured, i) > mega_rays(measured, leader))) leader = i;
  }
  if (best[0] == contenders.size() || best[1] == contenders.size()) return;
  std::printf("best  %-10s %-8s %-7s %-10s %5.2f  %s over %s\n", mesh.c_str(), measured.set.name.c_str(),
              call == Call::Single ? "single" : "batch", edges == Edges::Watertight ? "watertight" : "any",
              median_ratio(measured.times[best[1]], measured.times[best[0]]), contenders[best[0]].name.c_str(),
              contenders[best[1]].name.c_str());
}

inline void print_rates(const std::string& mesh, const Contenders& contenders, const std::vector<Measured>& all) {
  std::printf("%-38s", "million rays a second");
  for (const Measured& measured : all) std::printf("%9s", measured.set.name.c_str());
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    std::printf("\n%-7s%-31s", is_ours(contenders[i]) ? "glint" : "embree", contenders[i].name.c_str());
    for (const Measured& measured : all) std::printf("%9.2f", mega_rays(measured, i));
  }
  std::printf("\n");
  for (const Measured& measured : all) {
    for (std::size_t ours = 0; ours < contenders.size(); ++ours) {
      for (std::size_t theirs = 0; theirs < contenders.size(); ++theirs) {
        if (!is_ours(contenders[ours]) || is_ours(contenders[theirs])) continue;
        if (contenders[ours].call != contenders[theirs].call) continue;
        std::printf("RATIO %s %s %s %s %.3f\n", mesh.c_str(), measured.set.name.c_str(), contenders[ours].name.c_str(),
                    contenders[theirs].name.c_str(), median_ratio(measured.times[theirs], measured.times[ours]));
      }
    }
  }
}

inline void print_bytes(const NamedMesh& mesh, const EmbreeDevice& device, const Contenders& contenders) {
  const double triangles = double(mesh.buffers.indices.size() / 3);
  for (const Contender& ours : contenders) {
    if (!is_ours(ours)) continue;
    const auto like = std::find_if(contenders.begin(), contenders.end(),
                                   [&](const Contender& one) { return !is_ours(one) && one.name == ours.like; });
    const std::size_t theirs =
        like != contenders.end() ? like->bytes : EmbreeCaster(device, mesh.buffers, settings_named(ours.like)).bytes();
    std::printf("BYTES %s %s %.1f %.1f\n", mesh.name.c_str(), ours.name.c_str(), double(ours.bytes) / triangles,
                double(theirs) / triangles);
  }
}

}  // namespace glint::bench
