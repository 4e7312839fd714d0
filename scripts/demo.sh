#!/usr/bin/env bash
# Builds tcm-icp, registers the example in datasets/town and compares the result with the example's truth.
# The first run installs what is missing and compiles; later ones take seconds.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$repository"

scene=datasets/town
out=out/demo
evaluation=out/demo-evaluation.txt
tcm_icp=build/release/app/tcm-icp

configure() {
  # Tests are left as they were configured, and off at first: the demo needs no GoogleTest.
  if [[ -f build/release/build.ninja ]]; then
    cmake --preset release
  else
    cmake --preset release -DTCM_ICP_BUILD_TESTS=OFF
  fi
}

register() {
  local status=0
  "$tcm_icp" register "$scene"/*.ply --out "$out" --force --threads "$(nproc)" ||
    status=$?
  if ((status == 3)); then
    echo "some scans are unregistered; $out/report.json says which and why"
  fi
  return "$status"
}

evaluate() {
  "$tcm_icp" evaluate --scans "$scene" --poses "$out/poses.json" --truth "$scene/truth.json" >"$evaluation"
}

compgen -G "$scene/*.ply" >/dev/null || fail "the example is missing: there are no scans in $scene"
quiet_step install scripts/install_dependencies.sh || fail "dependencies cannot be installed"
quiet_step configure configure || fail "configuring failed"
quiet_step build cmake --build build/release --target tcm-icp --parallel "$(nproc)" || fail "the build failed"
mkdir -p out
quiet_step register register || fail "the example was not registered"
quiet_step evaluate evaluate || fail "the result cannot be compared with the truth"

# "town: 6/6 scans ok, 0 flagged, 0 WRONG; ...": the line of the table that counts.
summary=$(grep -m 1 -E '[0-9]+/[0-9]+ scans ok' "$evaluation") || fail "$evaluation has no line 'N/M scans ok'"
[[ $summary =~ ([0-9]+)/([0-9]+)' scans ok' ]]
echo
echo "Made:  one cloud of ${BASH_REMATCH[2]} scans: $out/registered.ply"
echo "Truth: $summary"
echo "Look:  $out/report.html in a browser, $out/registered.ply in CloudCompare; each scan's error is in $evaluation"
((BASH_REMATCH[1] == BASH_REMATCH[2])) || fail "not every scan is where the truth says"
