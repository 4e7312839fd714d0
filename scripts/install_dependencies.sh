#!/usr/bin/env bash
# Installs what building tcm-icp needs on Debian 12, and only what is missing: with everything there it changes nothing
# and needs neither root nor network.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: install_dependencies.sh [--tests] [--checks] [--crs] [--conventional] [--outside] [--paper] [--benchmarks]
                               [--comparison] [--python] [--packages] [--site] [--workflow]
  --tests       also what the tests need (GoogleTest; for the Python module pybind11, NumPy; Chromium, to look at a report)
  --checks      also what the format and script checks and scripts/fuzz.sh need (clang-format, shellcheck, clang)
  --crs         also what the text of EPSG codes in LAS and E57 needs (PROJ)
  --outside     also what scripts/check_formats_outside.py opens files with (CloudCompare, PCL's tools, Open3D for Python)
  --conventional
                also what register --method icp and features need (PCL: with its dependencies about 1 GB)
  --paper       also what scripts/paper_tables.py and scripts/ablations.py need (PCL, numpy, matplotlib)
  --benchmarks  also what the benchmarks compare with (Google Benchmark, nanoflann, PCL: more than 1 GB)
  --comparison  also what scripts/compare_registration.py compares with (PCL, Open3D for Python)
  --python      also what the Python module needs (pybind11, Python's headers, NumPy)
  --packages    also what scripts/make_packages.sh needs (those, dpkg-dev)
  --site        also what scripts/make_site.sh needs (mkdocs, Doxygen)
  --workflow    also what workflow/ and scripts/test_workflow.sh need (Snakemake, Slurm: with dependencies 700 MB)
TCM_ICP_SKIP_INSTALL=1 turns the script off: for systems other than Debian, where the libraries came another way.
TEXT
}

# GMP, MPFR and Boost's headers come with libcgal-dev.
packages=(g++ cmake ninja-build ccache libcgal-dev libeigen3-dev libfftw3-dev libglpk-dev libboost-program-options-dev
          libtbb-dev nlohmann-json3-dev libpugixml-dev zlib1g-dev libjs-three)
while (($# > 0)); do
  case $1 in
    --tests) packages+=(libgtest-dev pybind11-dev python3-dev python3-numpy chromium python3-websocket) ;;
    --checks) packages+=(clang-format shellcheck clang libclang-rt-14-dev) ;;
    --conventional) packages+=(libpcl-dev) ;;
    --outside) packages+=(cloudcompare pcl-tools python3-numpy python3-open3d) ;;
    --crs) packages+=(libproj-dev) ;;
    --paper) packages+=(libpcl-dev python3-matplotlib python3-numpy) ;;
    --benchmarks) packages+=(libbenchmark-dev libnanoflann-dev libpcl-dev python3) ;;
    --comparison) packages+=(libbenchmark-dev libpcl-dev python3-numpy python3-open3d) ;;
    --python) packages+=(pybind11-dev python3-dev python3-numpy) ;;
    --packages) packages+=(pybind11-dev python3-dev python3-numpy dpkg-dev file) ;;
    --site) packages+=(doxygen mkdocs) ;;
    --workflow) packages+=(snakemake slurmctld slurmd slurm-client munge) ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 1 ;;
  esac
  shift
done

if [[ ${TCM_ICP_SKIP_INSTALL:-0} == 1 ]]; then
  exit 0
fi
if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  {
    echo "install_dependencies.sh: this system has no apt-get. Install what these Debian 12 packages hold by other means,"
    echo "then set TCM_ICP_SKIP_INSTALL=1 to go on without this step:"
    printf '  %s\n' "${packages[@]}"
  } >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  if [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then
    missing+=("$package")
  fi
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

as_root=()
if (($(id -u) != 0)); then
  if ! command -v sudo >/dev/null; then
    {
      echo "install_dependencies.sh: there is no sudo; ask root to run"
      echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    } >&2
    exit 1
  fi
  as_root=(sudo)
  # sudo asks at the terminal itself; without one nobody can type a password, so it fails instead of waiting.
  { : </dev/tty; } 2>/dev/null || as_root+=(-n)
fi

apt_get() {
  ${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive \
    apt-get -q -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 "$@"
}
echo "Installing ${missing[*]}"
apt_get update
apt_get install --yes --no-install-recommends "${missing[@]}"
