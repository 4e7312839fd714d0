#!/bin/sh
# tcm-icp evaluate as a user meets it, on two scans of four points whose errors are known by hand. $1 is the executable.
set -u
exe=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

# expect CODE FILE WHAT COMMAND...: the command must exit with CODE and write WHAT (a pattern) to FILE (out or err).
expect() {
  code=$1 file=$2 what=$3
  shift 3
  "$@" >"$folder/out" 2>"$folder/err"
  got=$?
  if [ "$got" != "$code" ] || ! grep -q -e "$what" "$folder/$file"; then
    echo "FAILED: $*: exit code $got, not $code; or '$what' is missing:"
    cat "$folder/out" "$folder/err"
    failures=$((failures + 1))
  fi
}
# shellcheck disable=SC2317  # expect calls it
evaluate() { "$exe" evaluate --scans "$folder" --truth "$folder/truth.json" "$@"; }

# pose_of X: the identity, shifted along x.
pose_of() { echo "[[1,0,0,$1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"; }
# poses STATUS POSE: poses.json whose second scan has these.
poses() {
  cat <<JSON
{"schema": 1, "reference": "0.xyz", "scans": [
  {"file": "0.xyz", "status": "reference", "pose": $(pose_of 0), "component": 0, "verdict": "", "reason": ""},
  {"file": "1.xyz", "status": "$1", "pose": $2, "component": 0, "verdict": "", "reason": ""}]}
JSON
}

printf '0 0 0\n1 0 0\n0 1 0\n0 0 1\n' | tee "$folder/0.xyz" >"$folder/1.xyz"
cat >"$folder/truth.json" <<JSON
{"scans": [{"file": "0.xyz", "pose": $(pose_of 5)}, {"file": "1.xyz", "pose": $(pose_of 8)}],
 "tolerance": {"rotation_deg": 1, "rmse_m": 0.1}}
JSON
poses registered "$(pose_of 3.0625)" >"$folder/good.json"
poses registered "$(pose_of 3.25)" >"$folder/wrong.json"
poses unregistered null >"$folder/flagged.json"

expect 0 out '1.xyz  ok  *0.0000  *0.0625  *0.0625' evaluate --poses "$folder/good.json"
expect 0 out '2/2 scans ok, 0 flagged, 0 WRONG; pairs 1/1' evaluate --poses "$folder/good.json"
expect 0 out '1.xyz  WRONG  *0.0000  *0.2500  *0.2500' evaluate --poses "$folder/wrong.json"
expect 0 out '1/2 scans ok, 1 flagged, 0 WRONG; pairs 0/1' evaluate --poses "$folder/flagged.json"
expect 0 out 'WRONG' evaluate --poses "$folder/wrong.json" --json "$folder/score.json"
expect 0 out '"max_rmse": 0.25' cat "$folder/score.json"

expect 0 out '0.xyz 1.xyz  ok  *0.0000  *0.0625' evaluate --poses "$folder/good.json"
expect 0 out 'registration recall 1.000: pairs of true overlap 0.1 or more, within 1 deg and 0.1 m' evaluate --poses "$folder/good.json"
expect 0 out 'registration recall 0.000' evaluate --poses "$folder/good.json" --max-rmse 0.05
expect 0 out 'registration recall 1.000' evaluate --poses "$folder/wrong.json" --max-rmse 0.3
# One of the two scans, four points each, is off by 1/4 along x, which is nearest for each of its points.
expect 0 out 'RMS of 8 points 0.1768 m' evaluate --poses "$folder/wrong.json"
expect 0 out 'registered to truth: mean 0.1250 m, standard deviation 0.1250 m (8 points to 8)' \
  evaluate --poses "$folder/wrong.json"
expect 0 out 'registered to truth 0.2500 m, truth to registered 0.2500 m, symmetric 0.2500 m' \
  evaluate --poses "$folder/wrong.json"
expect 0 out 'registered to truth 0.0000 m, truth to registered 3.0000 m' evaluate --poses "$folder/flagged.json"
expect 0 out 'RMS of 2 points' evaluate --poses "$folder/wrong.json" --rms-points 2 --threads 2
expect 0 out '"registration_recall": 0.0' cat "$folder/score.json"
expect 0 out '"standard_deviation": 0.125' cat "$folder/score.json"

expect 2 err 'missing.json' evaluate --poses "$folder/missing.json"
expect 2 err 'truth.json' evaluate --poses "$folder/truth.json"
expect 4 err 'score.json' evaluate --poses "$folder/good.json" --json "$folder/missing/score.json"
expect 1 err 'poses' evaluate
expect 1 err 'min_overlap' evaluate --poses "$folder/good.json" --min-overlap 2
expect 1 err 'max-rmse' evaluate --poses "$folder/good.json" --max-rmse 0
expect 1 err 'rms-points' evaluate --poses "$folder/good.json" --rms-points 0
rm "$folder/1.xyz"
expect 2 err '1.xyz' evaluate --poses "$folder/good.json"

exit "$failures"
