#!/usr/bin/env python3
"""Nothing in README.md and docs/ may be untrue: code is compiled, commands are run, links lead somewhere.

A fenced block says in an HTML comment on the line before it where its truth comes from:

    <!-- examples/first_ray.cpp -->            the block is that file, which the build compiles and the tests run
    <!-- examples/first_ray.cpp#trace -->      the block is the file's lines between <region: trace> and </region: trace>
    <!-- not run: it needs a network -->       the commands of a sh block are not run, for that reason

Without a comment a cpp block must be a whole program with a main, which is compiled and run against the source tree;
a sh block is run from the root of the tree, and json must parse. Other languages (text, console, …) are only shown.

    check_docs.py                 compares and resolves, in a second
    check_docs.py --programs DIR  writes the whole programs as a CMake project into DIR
    check_docs.py --shell         runs the sh blocks
    check_docs.py --reasons       lists what is not run, and why
"""

import argparse
import json
import pathlib
import re
import subprocess
import textwrap
from dataclasses import dataclass

import source_tree

COMMENT = re.compile(r"^\s*<!--\s*(.*?)\s*-->\s*$")
FENCE = re.compile(r"^(\s*)(```+|~~~+)\s*([\w+-]*)")
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)(?:\s+\"[^\"]*\")?\)")
INLINE_CODE = re.compile(r"`[^`]*`")
REGION_MARKER = re.compile(r"\s*(//|#)\s*</?region: [\w-]+>\s*$")
MUST_BE_PROVED = {"cpp", "c++", "cmake", "sh", "bash", "shell", "json"}
SHELL = {"sh", "bash", "shell"}


@dataclass
class Block:
    page: pathlib.Path
    line: int
    language: str
    proof: str
    text: str

    @property
    def not_run(self):
        return self.proof.removeprefix("not run: ") if self.proof.startswith("not run: ") else None

    @property
    def source(self):
        return None if self.not_run or not self.proof else self.proof

    @property
    def is_program(self):
        return self.language in {"cpp", "c++"} and not self.source and re.search(r"\bint main\(", self.text)

    @property
    def is_shell_to_run(self):
        return self.language in SHELL and not self.source and not self.not_run


def blocks_of(page):
    """The fenced blocks of a page, and its lines with those blanked out."""
    blocks, prose, fence, proof = [], [], None, ""
    for number, line in enumerate(page.read_text().splitlines(), 1):
        found = FENCE.match(line)
        if fence is None and found:
            fence = (found[1], found[2])
            blocks.append(Block(page, number, found[3].lower(), proof, ""))
            prose.append("")
        elif fence is not None and found and found[2].startswith(fence[1]) and line.strip() == found[2]:
            fence = None
            prose.append("")
        elif fence is not None:
            blocks[-1].text += line.removeprefix(fence[0]) + "\n"
            prose.append("")
        else:
            comment = COMMENT.match(line)
            proof = comment[1] if comment else ("" if line.strip() else proof)
            prose.append(line)
            continue
        proof = ""
    return blocks, prose


def cited(source):
    """The lines that `path` or `path#region` names, without license line and region markers; None if it is not there."""
    name, _, region = source.partition("#")
    path = source_tree.ROOT / name
    if not path.is_file():
        return None
    lines = path.read_text().splitlines()
    if region:
        starts = [n for n, line in enumerate(lines) if f"<region: {region}>" in line]
        ends = [n for n, line in enumerate(lines) if f"</region: {region}>" in line]
        if len(starts) != 1 or len(ends) != 1:
            return None
        lines = lines[starts[0] + 1 : ends[0]]
    kept = [line for line in lines if not REGION_MARKER.match(line) and "SPDX-License-Identifier" not in line]
    return textwrap.dedent("\n".join(kept)).strip("\n")


def check_block(report, block):
    if block.source:
        text = cited(block.source)
        if text is None:
            report.add(block.page, block.line, f"cites {block.source}, which is not there once")
        elif text.rstrip() != block.text.strip("\n").rstrip():
            report.add(block.page, block.line, f"differs from {block.source}, which it cites")
    elif block.not_run is not None and block.language not in SHELL:
        report.add(block.page, block.line, "only commands may go unproved")
    elif block.language == "json":
        try:
            json.loads(block.text)
        except json.JSONDecodeError as error:
            report.add(block.page, block.line + error.lineno, f"is not JSON: {error.msg}")
    elif block.language in MUST_BE_PROVED - SHELL and not block.is_program:
        report.add(block.page, block.line, f"{block.language} that nothing compiles: cite a source, or be a whole program")
    elif not block.language:
        report.add(block.page, block.line, "does not name its language")


def anchors(page):
    """The anchors of a page's headings, as Markdown viewers make them."""
    _, prose = blocks_of(page)
    made = set()
    for line in prose:
        heading = re.match(r"#+\s+(.*?)\s*#*$", line)
        if not heading:
            continue
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).lower()
        anchor = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        number = 0
        while (anchor if not number else f"{anchor}-{number}") in made:
            number += 1
        made.add(anchor if not number else f"{anchor}-{number}")
    return made


def check_link(report, page, number, target):
    if re.match(r"[a-z]+:", target):
        return
    path, _, anchor = target.partition("#")
    there = (page.parent / path).resolve() if path else page
    if not there.exists():
        report.add(page, number, f"links to {target}, which does not exist")
    elif not there.is_relative_to(source_tree.ROOT):
        report.add(page, number, f"links to {target}, outside the source tree")
    elif anchor and there.suffix == ".md" and anchor not in anchors(there):
        report.add(page, number, f"links to {target}, but there is no such heading")


def check_pages(pages):
    report, count = source_tree.Report(), 0
    for page in pages:
        blocks, prose = blocks_of(page)
        count += len(blocks)
        for block in blocks:
            check_block(report, block)
        for number, line in enumerate(prose, 1):
            for target in LINK.findall(INLINE_CODE.sub("", line)):
                check_link(report, page, number, target)
    report.end(f"{len(pages)} pages with {count} blocks agree with the sources")


def write_programs(blocks, directory):
    programs = [block for block in blocks if block.is_program]
    directory.mkdir(parents=True, exist_ok=True)
    lines = [
        "cmake_minimum_required(VERSION 3.24)",
        "project(documentation LANGUAGES CXX)",
        "enable_testing()",
        f"add_subdirectory({source_tree.ROOT} glint)",
    ]
    for block in programs:
        name = re.sub(r"\W+", "_", source_tree.relative(block.page)) + f"_{block.line}"
        source = directory / f"{name}.cpp"
        source.write_text(f'#line {block.line + 1} "{block.page}"\n{block.text}')
        lines += [
            f"add_executable({name} {name}.cpp)",
            f"target_link_libraries({name} PRIVATE glint::glint)",
            f"add_test(NAME {name} COMMAND {name})",
        ]
    (directory / "CMakeLists.txt").write_text("\n".join(lines) + "\n")
    print(f"{len(programs)} programs in {directory}")


def run_shell(blocks):
    report = source_tree.Report()
    run = [block for block in blocks if block.is_shell_to_run]
    for block in run:
        print(f"{source_tree.relative(block.page)}:{block.line}: running", flush=True)
        command = ["bash", "-euo", "pipefail", "-c", block.text]
        done = subprocess.run(command, cwd=source_tree.ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace")
        if done.returncode:
            print(done.stdout[-4000:])
            report.add(block.page, block.line, f"its commands fail with status {done.returncode}")
    report.end(f"{len(run)} blocks of commands work")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=pathlib.Path, metavar="DIR")
    parser.add_argument("--shell", action="store_true")
    parser.add_argument("--reasons", action="store_true")
    arguments = parser.parse_args()

    pages = source_tree.files("README.md", "docs/*.md")
    blocks = [block for page in pages for block in blocks_of(page)[0]]
    if arguments.programs:
        write_programs(blocks, arguments.programs.resolve())
    elif arguments.shell:
        run_shell(blocks)
    elif arguments.reasons:
        for block in blocks:
            if block.not_run:
                print(f"{source_tree.relative(block.page)}:{block.line}: not run: {block.not_run}")
    else:
        check_pages(pages)


main()
