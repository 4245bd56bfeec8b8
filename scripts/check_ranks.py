#!/usr/bin/env python3
"""A header includes only headers of its own folder or of a lower rank, so that the library has no cycles."""

import re

import source_tree

RANKS = [
    ["core", "version.hpp"],
    ["math", "simd"],
    ["geometry"],
    ["bvh"],
    ["color", "bsdf", "texture", "sampler", "camera", "film"],
    ["material", "light"],
    ["scene"],
    ["integrator", "render"],
    ["io"],
    ["testing"],
    ["glint.hpp"],
]
RANK_OF = {folder: rank for rank, folders in enumerate(RANKS) for folder in folders}

# Folders of one rank that may build on each other, one way. The rest of a rank stand side by side.
WITHIN_A_RANK = {
    ("bsdf", "color"),
    ("texture", "color"),
    ("film", "color"),
    ("render", "integrator"),
}

# Libraries that only one folder, or one header, may bring in.
LIBRARIES = {
    r"tbb/|oneapi/": {"core/tbb_executor.hpp"},
    r"OpenEXR/|Imf|Imath": {"io"},
    r"stb_|tiny_obj_loader|nlohmann/": {"io"},
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def may_include(folder, other):
    if folder == other or RANK_OF[other] < RANK_OF[folder]:
        return True
    return (folder, other) in WITHIN_A_RANK


def check_include(report, header, number, delimiter, name, folder):
    if delimiter == '"':
        report.add(header, number, f'includes "{name}"; glint\'s headers are included as <glint/…>')
        return
    if name == "glm/glm.hpp":
        report.add(header, number, "includes <glm/glm.hpp>; include the parts of GLM that are used")
    here = header.relative_to(source_tree.ROOT / "include/glint").as_posix()
    for library, allowed in LIBRARIES.items():
        if re.match(library, name) and not {here, folder} & allowed:
            report.add(header, number, f"includes <{name}>, which belongs to {', '.join(sorted(allowed))}")
    if not name.startswith("glint/"):
        return
    other = name.split("/")[1]
    if not (source_tree.ROOT / "include" / name).is_file():
        report.add(header, number, f"includes <{name}>, which does not exist")
    elif other not in RANK_OF:
        report.add(header, number, f"includes <{name}>, whose folder has no rank")
    elif not may_include(folder, other):
        report.add(header, number, f"{folder} (rank {RANK_OF[folder]}) includes <{name}> (rank {RANK_OF[other]})")


def main():
    report = source_tree.Report()
    headers = source_tree.files("include/glint/*.hpp")
    for header in headers:
        folder = header.relative_to(source_tree.ROOT / "include/glint").parts[0]
        if folder not in RANK_OF:
            report.add(header, 1, f"the folder {folder} has no rank in scripts/check_ranks.py")
            continue
        for number, line in enumerate(header.read_text().splitlines(), 1):
            found = INCLUDE.match(line)
            if found:
                check_include(report, header, number, found[1], found[2], folder)
    report.end(f"{len(headers)} headers keep their ranks")


main()
