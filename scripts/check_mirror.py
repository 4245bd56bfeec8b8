#!/usr/bin/env python3
"""Every header has its test and every test its header: include/glint/X.hpp and tests/X.test.cpp.

Each test is a namespace of its own, so that several can be compiled together.
And every header is where readers look for it: in glint.hpp, but for testing/, and in the map of the headers."""

import source_tree

# Headers without behavior of their own to test; what is said there is tested where it is done.
NOTHING_TO_RUN = {
    "glint.hpp": "includes the others; the consumer of two units builds it",
    "version.hpp": "CMake reads it, and the consumers ask for it",
    "core/config.hpp": "macros, used by every header",
}
ALONE = "// first, so the header proves it stands alone"


def nothing_to_run(name):
    return name in NOTHING_TO_RUN or name.split("/")[-1] == "concepts.hpp"  # laws are tested on the models


def check_listed(report, headers):
    everything = source_tree.ROOT / "include/glint/glint.hpp"
    page = source_tree.ROOT / "docs/reference/headers.md"
    included, mapped = everything.read_text(), page.read_text()
    for name in sorted(headers.keys() - {"glint.hpp"}):
        if not name.startswith("testing/") and f"#include <glint/{name}>" not in included:
            report.add(everything, 1, f"does not include <glint/{name}>")
        if f"glint/{name}" not in mapped:
            report.add(page, 1, f"does not name {name}")


def main():
    report = source_tree.Report()
    include, tests = source_tree.ROOT / "include/glint", source_tree.ROOT / "tests"
    headers = {path.relative_to(include).as_posix(): path for path in source_tree.files("include/glint/*.hpp")}
    mirrors = {
        path.relative_to(tests).as_posix().removesuffix(".test.cpp") + ".hpp": path
        for path in source_tree.files("tests/*.test.cpp")
    }
    for name in sorted(headers.keys() - mirrors.keys()):
        if not nothing_to_run(name):
            report.add(headers[name], 1, f"has no test: tests/{name.removesuffix('.hpp')}.test.cpp")
    for name in sorted(mirrors.keys() - headers.keys()):
        report.add(mirrors[name], 1, f"tests a header that does not exist: include/glint/{name}")
    for name in sorted(mirrors.keys() & headers.keys()):
        lines = mirrors[name].read_text().splitlines()
        first = next(((n, line) for n, line in enumerate(lines, 1) if line.startswith("#include")), (1, ""))
        if first[1] != f"#include <glint/{name}>  {ALONE}":
            report.add(mirrors[name], first[0], f"must first say: #include <glint/{name}>  {ALONE}")
        space = "test_" + name.removesuffix(".hpp").replace("/", "_")
        if f"namespace {space} {{" not in lines or lines[-1] != f"}}  // namespace {space}":
            report.add(mirrors[name], len(lines), f"is not, but for its includes, in one namespace {space}")
    check_listed(report, headers)
    report.end(f"{len(mirrors)} tests mirror {len(headers)} headers")


main()
