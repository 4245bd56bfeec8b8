#!/usr/bin/env python3
"""What the house style asks of every source file, and of the library's headers beyond that."""

import re

import source_tree

LONGEST = 400  # lines of a header: one family of types each

LICENSE = "// SPDX-License-Identifier: MIT"
UNFINISHED = re.compile(r"\b(TODO|FIXME|XXX|HACK)\b")
MAY_USE_THE_PREPROCESSOR = re.compile(r"include/glint/(core/config\.hpp|simd/.*)")
DIRECTIVE = re.compile(r"^\s*#\s*(?!include\b|pragma once\b)(\w+)")

# The library has no globals, prints nothing, never ends the program, and starts no threads.
FORBIDDEN = [
    (re.compile(r"\bstd::(cout|cerr|clog)\b|\b(std::)?(printf|puts|fprintf)\s*\("), "prints"),
    (re.compile(r"\bstd::(exit|abort|terminate|quick_exit)\b|[^\w.:](exit|abort)\s*\("), "ends the program"),
    (re.compile(r"\bstd::(thread|jthread|async)\b"), "starts threads"),
    (re.compile(r"\bthread_local\b"), "has state of the whole program"),
    (re.compile(r"\bvirtual\b"), "has a virtual function"),
    (re.compile(r"(?<!std::)\b(?!get_if\b)(get|compute)_[a-z]"), "names a function get_ or compute_"),
    (re.compile(r"\busing namespace\b(?!.*_literals)"), "opens a namespace"),
]
# A variable at the left margin that is not constant.
GLOBAL = re.compile(
    r"(?!(using|return|template|typedef|struct|class|enum|union|namespace|friend|concept|requires)\b)"
    r"(?!.*\b(const|constexpr|consteval|concept)\b)[A-Za-z_][\w:<>, *&]*\s[*&]?\w+(\{.*\}|\s*=[^=].*)?;"
)
STRING = re.compile(r'"(\\.|[^"\\])*"')


def check_header(report, header, lines):
    name = source_tree.relative(header)
    if len(lines) > LONGEST:
        report.add(header, len(lines), f"has more than {LONGEST} lines: does it hold more than one thing?")
    if lines[1:2] != ["#pragma once"]:
        report.add(header, 2, "its second line must be #pragma once")
    for number, line in enumerate(lines, 1):
        directive = DIRECTIVE.match(line)
        if directive and not MAY_USE_THE_PREPROCESSOR.fullmatch(name):
            report.add(header, number, f"has #{directive[1]}, which only core/config.hpp and simd/ may")
        code = STRING.sub('""', line).split("//")[0]
        if GLOBAL.match(code):
            report.add(header, number, "has a global variable")
        for pattern, sentence in FORBIDDEN:
            if pattern.search(code):
                report.add(header, number, sentence)


def main():
    report = source_tree.Report()
    sources = source_tree.files("*.hpp", "*.cpp")
    for source in sources:
        lines = source.read_text().splitlines()
        if lines[:1] != [LICENSE]:
            report.add(source, 1, f"its first line must be: {LICENSE}")
        for number, line in enumerate(lines, 1):
            if UNFINISHED.search(line):
                report.add(source, number, "is unfinished")
        if source_tree.relative(source).startswith("include/"):
            check_header(report, source, lines)
    report.end(f"{len(sources)} files keep the house style")


main()
