#!/bin/sh
# tcm-icp simulate as a user meets it: files, refusals, exit codes. $1 is the executable.
set -u
exe=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

# expect CODE WHAT COMMAND...: runs the command, which must exit with CODE and say WHAT (a pattern) on stderr.
expect() {
  code=$1 what=$2
  shift 2
  "$@" >"$folder/out" 2>"$folder/err"
  got=$?
  if [ "$got" != "$code" ] || ! grep -q -e "$what" "$folder/err"; then
    echo "FAILED: $*: exit code $got, not $code; or stderr lacks '$what':"
    cat "$folder/err"
    failures=$((failures + 1))
  fi
}
same() { diff -r "$1" "$2" || failures=$((failures + 1)); }
# shellcheck disable=SC2317  # expect calls it
simulate() { "$exe" simulate --step 2 --seed 5 --scans 2 "$@"; }

expect 0 '001.ply' simulate --out "$folder/a" --threads 1 --initial-guess 5 0.5
# shellcheck disable=SC2012  # the names are ours
[ "$(ls "$folder/a" | tr '\n' ' ')" = '000.ply 001.ply initial_poses.json truth.json ' ] || failures=$((failures + 1))
expect 0 '001.ply' simulate --out "$folder/b/" --threads 2 --initial-guess 5 0.5
same "$folder/a" "$folder/b"

expect 4 'exists' simulate --out "$folder/a"
same "$folder/a" "$folder/b"
expect 0 '001.ply' simulate --out "$folder/a" --force
[ ! -e "$folder/a/initial_poses.json" ] || failures=$((failures + 1))

expect 0 '001.ply' simulate --out "$folder/street" --scene street
expect 0 '001.ply' simulate --out "$folder/block" --scene=block --spacing 10
if cmp -s "$folder/street/000.ply" "$folder/block/000.ply"; then failures=$((failures + 1)); fi
expect 1 'station_spacing_m' simulate --out "$folder/c" --scene street --spacing 0
expect 0 "001.ply" simulate --out "$folder/air" --scene plaza --sensor aerial --strip-length 20 --line-spacing 2
expect 0 "001.ply" simulate --out "$folder/lines" --scene urban --lines 16 --overlap 0.6
expect 0 "001.ply" simulate --out "$folder/bays" --scene bays --clutter 2
expect 0 "001.ply" simulate --out "$folder/storeys" --scene storeys
expect 0 "001.ply" simulate --out "$folder/orchard" --scene orchard
expect 0 "001.ply" simulate --out "$folder/tunnel" --scene tunnel
expect 0 "001.ply" simulate --out "$folder/motorway" --scene motorway --lines 16
expect 1 "aerial" simulate --out "$folder/c" --scene tunnel --sensor aerial
expect 1 "clutter" simulate --out "$folder/c" --scene bays --clutter -1
expect 1 "sonar" simulate --out "$folder/c" --sensor sonar
expect 1 "num_lines" simulate --out "$folder/c" --scene urban --lines 1
expect 1 "dropout_share" simulate --out "$folder/c" --dropouts 1
expect 1 "overlap" simulate --out "$folder/c" --scene street --overlap 2

mkdir "$folder/photos" && echo precious >"$folder/photos/picture"
expect 4 'not an earlier result' simulate --out "$folder/photos" --force
[ -e "$folder/photos/picture" ] || failures=$((failures + 1))

expect 1 'moon' simulate --out "$folder/c" --scene moon
expect 1 'max_tilt_deg' simulate --out "$folder/c" --tilt 91
expect 1 'range_noise_m' simulate --out "$folder/c" --range-noise -1
expect 1 'two numbers' simulate --out "$folder/c" --initial-guess 5
expect 1 'out' simulate
expect 1 'no returns' simulate --out "$folder/c" --max-range 0.7
[ ! -e "$folder/c" ] || failures=$((failures + 1))
if ls -d "$folder"/*.part* "$folder"/*.old* 2>/dev/null; then failures=$((failures + 1)); fi

exit "$failures"
