# shellcheck shell=bash
# Sourced by the other scripts: what glint's programs, tests and checks need, and how it gets onto this machine.
#
# On Debian and Ubuntu what is missing is installed with apt-get; nothing is asked of the network when nothing is
# missing. Elsewhere, and without the right to install, what is missing is named and CMake looks for itself.

glint_root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

glint_build_packages=(build-essential cmake ninja-build libglm-dev libtinyobjloader-dev libstb-dev libopenexr-dev
  libtbb-dev nlohmann-json3-dev libcli11-dev catch2)
glint_benchmark_packages=(libbenchmark-dev libembree-dev)
glint_check_packages=(clang clang-format clang-tidy libclang-rt-14-dev python3 shellcheck git)

glint_say() { printf '%s: %s\n' "${0##*/}" "$*"; }

glint_die() {
  printf '%s: error: %s\n' "${0##*/}" "$*" >&2
  exit 1
}

# A tool found on the path counts, wherever it came from; a library counts when its package is installed.
glint_has() {
  case "$1" in
    build-essential) command -v g++ >/dev/null || command -v clang++ >/dev/null ;;
    cmake | clang-format | clang-tidy | git | python3 | shellcheck) command -v "$1" >/dev/null ;;
    clang) command -v clang++ >/dev/null ;;
    ninja-build) command -v ninja >/dev/null ;;
    *) dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'install ok installed' ;;
  esac
}

glint_apt() {
  local as_root=()
  ((EUID == 0)) || as_root=(sudo -n)
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300 "$@" </dev/null
}

# The package lists of a new system are empty, and those of an old one name files that are gone: only then are they
# fetched again.
glint_apt_install() {
  local log
  log="$(mktemp)"
  if ! glint_apt install --no-install-recommends -y "$@" >"$log" 2>&1; then
    if ! { glint_apt update && glint_apt install --no-install-recommends -y "$@"; } >"$log" 2>&1; then
      tail -n 20 "$log" >&2
      rm -f "$log"
      glint_die "apt-get could not install: $*. Is the network there?"
    fi
  fi
  rm -f "$log"
}

# Installs those of the named packages that are missing, or says which they are.
glint_install() {
  local missing=() package
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    glint_say "this is not a Debian system: cannot tell whether all of these are here: $*"
    return
  fi
  for package in "$@"; do
    glint_has "$package" || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  if ((EUID != 0)) && ! sudo -n true 2>/dev/null; then
    glint_say "missing, and only root may install them: apt-get install ${missing[*]}"
    return
  fi
  glint_say "installing ${missing[*]}"
  glint_apt_install "${missing[@]}"
}

# The words of "$1 --version" that are a version number, such as 3.25.1.
glint_version_of() { "$1" --version | grep -Eo '[0-9]+(\.[0-9]+)+' | head -n 1; }

glint_require_tool() {
  local tool="$1" least="$2" found
  command -v "$tool" >/dev/null || glint_die "$tool is needed, version $least or later, and is not installed"
  found="$(glint_version_of "$tool")"
  [[ "$(printf '%s\n' "$least" "$found" | sort -V | head -n 1)" == "$least" ]] ||
    glint_die "$tool $least or later is needed; this is $tool $found"
}

# All that a build with the tests and the program takes. Ends the script with a sentence where that cannot be had.
glint_require_build() {
  glint_install "${glint_build_packages[@]}"
  glint_require_tool cmake 3.24
  glint_require_tool ninja 1.10
  local compiler="${CXX:-c++}"
  command -v "$compiler" >/dev/null || glint_die "no C++ compiler: install g++ 12 or clang 14, or later, or set CXX"
  case "$("$compiler" --version)" in
    *clang*) glint_require_tool "$compiler" 14 ;;
    *) glint_require_tool "$compiler" 12 ;;
  esac
  if ! mkdir -p "$glint_root/build" 2>/dev/null || ! [[ -w "$glint_root/build" ]]; then
    glint_die "cannot write to $glint_root/build: work in a clone that is yours"
  fi
}

# What the benchmarks take beyond that, and what the checks do.
glint_require_benchmarks() { glint_install "${glint_benchmark_packages[@]}"; }
glint_require_checks() { glint_install "${glint_check_packages[@]}"; }

# Configures a preset (extra arguments go to CMake); its words are shown when it fails, or to name what is left out.
glint_configure() {
  local preset="$1" log
  shift
  log="$(mktemp)"
  if ! (cd "$glint_root" && cmake --preset "$preset" "$@") >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    glint_die "CMake could not configure the preset $preset"
  fi
  grep 'glint: not found' "$log" || true
  rm -f "$log"
}

# Builds targets of a preset: glint_build PRESET [TARGET]…
glint_build() {
  local preset="$1" targets=()
  shift
  (($# == 0)) || targets=(--target "$@")
  (cd "$glint_root" && cmake --build --preset "$preset" "${targets[@]}") ||
    glint_die "the build of ${*:-everything} failed (preset $preset)"
}
