#!/bin/sh
# Makes datasets/town again: the same bytes each time.
#
#   scripts/make_dataset.sh [EXE]            EXE defaults to build/release/app/tcm-icp
#   scripts/make_dataset.sh --check [EXE]    makes it in a temporary folder and compares: exit 1 where a file differs
set -eu
cd "$(dirname "$0")/.."
check=no
if [ "${1:-}" = --check ]; then
  check=yes
  shift
fi
exe=${1:-build/release/app/tcm-icp}
if [ ! -x "$exe" ]; then
  echo "make_dataset.sh: $exe is not there; build it first: cmake --preset release && cmake --build --preset release" >&2
  exit 2
fi

make_town() {
  "$exe" simulate --scene town --scans 6 --seed 7 --thinning 0.18 --initial-guess 5 0.5 --out "$1" --force
}

if [ "$check" = no ]; then
  make_town datasets/town
else
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  make_town "$folder/town"
  diff -r "$folder/town" datasets/town
fi
