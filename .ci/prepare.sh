# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
#
# What run-demo and run-tests share; sourced with the repository as working directory.

log_folder=build/log

say() { printf '==> %s\n' "$*"; }

die() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# Runs a command with its output in a log, which is shown if the command fails.
quietly() {
  local log="$log_folder/$1.log"
  shift
  mkdir -p "$log_folder"
  "$@" >"$log" 2>&1 || {
    tail -n 30 "$log" >&2
    die "'$*' failed; the whole log is in $log"
  }
}

# Names in the given package lists that are not installed.
missing_packages() {
  local package
  sed 's/#.*//' "$@" | while read -r package; do
    [ -n "$package" ] || continue
    dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
      printf '%s ' "$package"
  done
}

# Installs what is missing of the given package lists.
install_packages() {
  if [ -n "${SHEAF_SKIP_PACKAGES:-}" ]; then
    say "Packages: not looked at, because SHEAF_SKIP_PACKAGES is set"
    return
  fi
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    die "this is not Debian: install what these name, then set SHEAF_SKIP_PACKAGES=1: $*"
  fi
  local missing
  missing=$(missing_packages "$@")
  if [ -z "$missing" ]; then
    say "Packages: all there"
    return
  fi
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null || ! { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
      die "missing packages, and neither root nor sudo to install them: $missing"
    fi
    as_root=(sudo)
    sudo -v || die "missing packages, and sudo refused to install them: $missing"
  fi
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get -q -o DPkg::Lock::Timeout=300)
  say "Packages: installing $missing"
  quietly apt-update "${apt[@]}" update
  # shellcheck disable=SC2086  # one word a package
  quietly apt-install "${apt[@]}" install -y --no-install-recommends $missing
}

# Parallel jobs: one a processor, but no more than memory has room for (a compiler takes up to
# 1.5 GB).
parallel_jobs() {
  local processors memory_jobs
  processors=$(nproc)
  memory_jobs=$(awk '/^MemAvailable:/ { print int($2 / 1500000) }' /proc/meminfo)
  [ "${memory_jobs:-1}" -ge 1 ] || memory_jobs=1
  echo $((processors < memory_jobs ? processors : memory_jobs))
}

# Configures and builds a preset of CMakePresets.json.
build_preset() {
  say "Configuring build/$1"
  quietly "configure-$1" cmake --preset "$1"
  local jobs
  jobs=$(parallel_jobs)
  say "Building with $jobs jobs"
  cmake --build --preset "$1" --parallel "$jobs" || die "the build failed; see above"
}

# Makes build/venv with the Python package of explore/ and all it needs, at the versions of
# explore/requirements.txt; does nothing if it is up to date.
prepare_python() {
  local wanted
  wanted=$(cat explore/requirements.txt explore/pyproject.toml | sha256sum)
  if [ "$wanted" = "$(cat build/venv/made-from 2>/dev/null)" ]; then
    say "Python packages: all there"
    return
  fi
  say "Python packages: installing explore/requirements.txt into build/venv"
  rm -rf build/venv
  quietly venv "${SHEAF_PYTHON:-python3}" -m venv build/venv
  local pip=(build/venv/bin/python -m pip --quiet --disable-pip-version-check install)
  quietly pip-packages "${pip[@]}" --require-hashes --requirement explore/requirements.txt
  quietly pip-explore "${pip[@]}" --no-deps --no-build-isolation --editable explore
  printf '%s\n' "$wanted" >build/venv/made-from
}
