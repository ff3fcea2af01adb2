# shellcheck shell=bash
# Install, configure and build, each only as far as it is not done already.
# Sourced by contrib/run and contrib/test, which set -eu.

repository=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)

# To build and run, with gmsh and OpenCASCADE for CAD files. openblas-serial makes dense kernels 3 to 10 times faster
# than the reference BLAS; libnlopt-dev has the CMake package, -cxx- the header. Programs with
# OpenCASCADE link with fontconfig, but the packages of OpenCASCADE do not depend on its library.
# shellcheck disable=SC2034
run_packages=(g++ cmake ninja-build openmpi-bin libdeal.ii-dev libnlopt-dev
  libnlopt-cxx-dev nlohmann-json3-dev zlib1g-dev libopenblas0-serial gmsh
  libocct-foundation-dev libocct-modeling-data-dev libocct-modeling-algorithms-dev
  libocct-ocaf-dev libocct-visualization-dev libocct-data-exchange-dev libfontconfig-dev
  python3 python3-matplotlib python3-vtk9)

# deal.II of Debian 13 links with mold, but its package does not depend on mold.
grep -qs '^VERSION_ID="12"' /etc/os-release || run_packages+=(mold)

# To test as well. GTest's CMake package refuses to load without gmock.
# shellcheck disable=SC2034
test_packages=(git libgtest-dev libgmock-dev clang-format-19 clang-tidy-19 shellcheck python3-scipy)

# Debian 13 has no CalculiX: tests that compare with it are skipped there (contrib/lib/calculix.py).
grep -qs '^VERSION_ID="13"' /etc/os-release || test_packages+=(calculix-ccx)

# One thread per rank, and more ranks than cores allowed (doc/cluster.md).
set -a
# shellcheck source=contrib/lib/run.env
. "$repository/contrib/lib/run.env"
set +a

say()
{
  printf '%s\n' "$*" >&2
}

# die STATUS MESSAGE...
die()
{
  local status=$1
  shift
  say "contrib/$(basename -- "$0"): $*"
  exit "$status"
}

# step LOG MESSAGE COMMAND...: run the command and print one line with its time.
# What the command prints is appended to LOG, and shown where the command fails.
step()
{
  local log=$1 message=$2 begin=$SECONDS
  shift 2
  mkdir -p -- "$(dirname -- "$log")"
  printf '%s ... ' "$message" >&2
  if "$@" 3>&2 >>"$log" 2>&1; then
    say "($((SECONDS - begin)) s)"
  else
    say failed
    tail -n 40 -- "$log" >&2
    say "The full log is in $log"
    return 1
  fi
}

# The packages among the arguments that dpkg does not have, in one line.
missing_packages()
{
  local installed package missing=''
  # dpkg-query fails when it does not know one of them: that is an answer.
  # shellcheck disable=SC2016
  installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "$@" \
    2>/dev/null | sed -n 's/ installed$//p') || true
  for package; do
    printf '%s\n' "$installed" | grep -qxF -- "$package" ||
      missing="$missing $package"
  done
  printf '%s\n' "${missing# }"
}

# install PACKAGE...: those that are missing, or say how to and stop.
install_packages()
{
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null
  then
    die 1 "this is not a Debian system (no dpkg-query or apt-get):" \
      "build with CMake as in doc/cluster.md"
  fi
  local missing
  missing=$(missing_packages "$@")
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    say "Missing packages. Run this line, then this command again:"
    say "sudo apt install --no-install-recommends $missing"
    exit 1
  fi
  local log=$repository/build/build.log
  export DEBIAN_FRONTEND=noninteractive
  step "$log" "Updating the lists of packages" apt-get update -q ||
    say "apt-get update failed; trying with the old lists"
  # The list is split on purpose.
  # shellcheck disable=SC2086
  step "$log" "Installing $missing" \
    apt-get install -q -y --no-install-recommends $missing ||
    die 1 "apt could not install: $missing"
}

# cached DIRECTORY VARIABLE VALUE: is that what the build was configured with?
cached()
{
  grep -q "^$2:[A-Z]*=$3\$" "$1/CMakeCache.txt" 2>/dev/null
}

# configure DIRECTORY VARIABLE=VALUE...: run CMake unless it already has with
# these values. A directory configured by hand keeps its generator.
configure()
{
  local directory=$1 setting done=yes
  shift
  [ -f "$directory/build.ninja" ] || [ -f "$directory/Makefile" ] || done=no
  for setting; do
    cached "$directory" "${setting%%=*}" "${setting#*=}" || done=no
  done
  [ $done = no ] || return 0
  set -- "${@/#/-D}"
  [ -f "$directory/CMakeCache.txt" ] || set -- -G Ninja "$@"
  step "$directory/build.log" "Configuring ${directory##*/}" \
    cmake -S "$repository" -B "$directory" "$@"
}

# GiB that may still be used here: the machine's, or less in a container.
free_gigabytes()
{
  local free limit used
  free=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo)
  limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || echo max)
  if [ "$limit" != max ]; then
    used=$(cat /sys/fs/cgroup/memory.current 2>/dev/null || echo 0)
    limit=$(((limit - used) / 1073741824))
    [ "$limit" -ge "$free" ] || free=$limit
  fi
  echo "$free"
}

# Cores this process may use; nproc takes OMP_NUM_THREADS for their number.
cores()
{
  env -u OMP_NUM_THREADS nproc
}

# Compilers at a time: one per core, but each has 2 GiB (a unity file with
# deal.II headers takes up to 1.7).
jobs_at_once()
{
  local jobs memory
  jobs=$(cores)
  memory=$(($(free_gigabytes) / 2))
  [ "$jobs" -le "$memory" ] || jobs=$memory
  [ "$jobs" -ge 1 ] || jobs=1
  echo "$jobs"
}

# compile DIRECTORY TARGET...: the command of build()'s step. The progress count goes to the
# descriptor 3: on a terminal in place, else once for each tenth.
compile()
{
  local line tenth shown=0
  cmake --build "$1" --target "${@:2}" --parallel "$(jobs_at_once)" 2>&1 |
    while IFS= read -r line; do
      printf '%s\n' "$line"
      [[ $line =~ ^\[\ *([0-9]+)[/%]([0-9]*)\]\ (Building|Linking) ]] || continue
      tenth=$((10 * BASH_REMATCH[1] / ${BASH_REMATCH[2]:-100}))
      if [ -t 3 ]; then
        printf '\r%s ... %s ' "$message" "${line%%]*}]" >&3
      elif [ "$tenth" != "$shown" ]; then
        printf '%s ' "${line%%]*}]" >&3
      fi
      shown=$tenth
    done
  return "${PIPESTATUS[0]}"
}

# build DIRECTORY TARGET...
build()
{
  step "$1/build.log" "Compiling ${1##*/}" compile "$@"
}
