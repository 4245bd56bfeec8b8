# What the checks share: the files of the source tree, and how a check reports.
#
# A check is a program that prints one line a violation, `path:line: sentence`, and ends with 1 where there are any.

import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def files(*patterns):
    """The tree's own files, tracked or new, that match the given git patterns; never a build directory's."""
    command = ["git", "-C", str(ROOT), "ls-files", "--cached", "--others", "--exclude-standard", "--", *patterns]
    listed = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    return [path for path in (ROOT / name for name in sorted(listed)) if path.is_file()]


def relative(path):
    return path.relative_to(ROOT).as_posix()


class Report:
    def __init__(self):
        self.violations = 0

    def add(self, path, line, sentence):
        self.violations += 1
        print(f"{relative(path)}:{line}: {sentence}")

    def end(self, good):
        name = pathlib.Path(sys.argv[0]).name
        print(f"{name}: {good}" if not self.violations else f"{name}: {self.violations} violations")
        sys.exit(1 if self.violations else 0)
