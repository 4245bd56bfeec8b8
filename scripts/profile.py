#!/usr/bin/env python3
"""Where the time of a rendering goes, by parts of the library: traversal, shading, sampling, film.

Runs a command under `perf record`, and sorts its samples by the headers that the code at them was inlined from. The
program has to be built with -g; needs perf and addr2line.

    scripts/profile.py build/profile/bin/glint render scene.json --threads 1 --no-png --quiet -o /tmp/out.exr
"""
import argparse
import collections
import re
import subprocess
import sys
import tempfile

# The first rule of which one frame matches a sample's inlined frames, innermost first, names its part.
RULES = (
    ("traversal", re.compile(r"glint/bvh/")),
    ("sampling", re.compile(r"glint/(sampler/|math/(low_discrepancy|random))")),
    ("film", re.compile(r"glint/film/")),
    ("BSDFs and materials", re.compile(r"glint/(bsdf|material|texture)/")),
    ("lights", re.compile(r"glint/light/")),
    ("hit points", re.compile(r"glint/(scene|geometry)/")),
    ("camera", re.compile(r"glint/camera/")),
    ("integrator", re.compile(r"glint/integrator/")),
    ("rendering loop", re.compile(r"glint/(render|math|core|simd)/")),
    ("files", re.compile(r"glint/io/")),
)


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def load_offset(data, program):
    """What to take off an address in memory to have it in the program's file."""
    pattern = re.compile(r"\[(0x[0-9a-f]+)\(0x[0-9a-f]+\) @ (0x[0-9a-f]+|0) .*r-xp (\S+)")
    for line in run("perf", "script", "-i", data, "--show-mmap-events").splitlines():
        found = pattern.search(line)
        if found and found[3].endswith("/" + program.split("/")[-1]):
            return int(found[1], 16) - int(found[2], 16)
    sys.exit(f"profile.py: perf saw nothing of {program} mapped to memory")


def sampled_addresses(data, program):
    """How often each address of the program was met, and each other library."""
    addresses, libraries = collections.Counter(), collections.Counter()
    for line in run("perf", "script", "-i", data, "-F", "ip,dso").splitlines():
        words = line.split()
        if not words:
            continue
        library = words[-1].strip("()")
        if library.endswith("/" + program.split("/")[-1]):
            addresses[int(words[0], 16)] += 1
        else:
            libraries[library.split("/")[-1]] += 1
    return addresses, libraries


def inlined_frames(program, addresses):
    """The source files at each address, innermost first."""
    frames, current = {}, None
    for line in run("addr2line", "-i", "-a", "-e", program, *map(hex, addresses)).splitlines():
        if line.startswith("0x"):
            current = frames.setdefault(int(line, 16), [])
        else:
            current.append(line)
    return frames


def part_of(frames):
    return next((name for name, rule in RULES if any(map(rule.search, frames))), "other")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="built with -g")
    parser.add_argument("arguments", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        data = folder + "/perf.data"
        run("perf", "record", "-F", "2000", "-o", data, options.program, *options.arguments)
        addresses, libraries = sampled_addresses(data, options.program)
        offset = load_offset(data, options.program)
    frames = inlined_frames(options.program, [a - offset for a in addresses])
    parts = collections.Counter(libraries)
    for address, count in addresses.items():
        parts[part_of(frames[address - offset])] += count
    total = sum(parts.values())
    for name, count in parts.most_common():
        if 1000 * count >= total:
            print(f"{100 * count / total:5.1f} %  {name}")


if __name__ == "__main__":
    try:
        main()
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"profile.py: {error}")
