#!/bin/sh
# tcm-icp evaluate and the scorer of the shared scenes must say the same of the same poses. $1 is the executable, $2 the
# repository. Skipped (77) where the scorer, python3 or numpy are not there.
set -u
exe=$1 repository=$2
scorer=
for place in "$repository/../shared" "$repository/../../shared"; do
  [ -f "$place/eval/score.py" ] && scorer=$place/eval/score.py
done
if [ -z "$scorer" ]; then
  echo "SKIPPED: there is no ../shared/eval/score.py to compare with"
  exit 77
fi
python=/usr/bin/python3
if ! "$python" -c 'import numpy' 2>/dev/null; then
  echo "SKIPPED: $python lacks numpy: apt install python3-numpy"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
town=$repository/datasets/town

# Poses of every kind: right ones, ones 2 cm and 3 m off, one turned, one left out.
"$python" - "$town" "$folder" <<'PYTHON'
import json, sys
import numpy as np
town, folder = sys.argv[1:]
poses = [np.array(s["pose"]) for s in json.load(open(town + "/truth.json"))["scans"]]
poses = [np.linalg.inv(poses[2]) @ p for p in poses]
poses[0][:3, 3] += [0.02, 0, 0]
poses[1][:3, 3] += [0, 3, 0]
c, s = np.cos(0.02), np.sin(0.02)
poses[3] = poses[3] @ np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
entries = [{"file": f"00{i}.ply", "status": "reference" if i == 2 else "registered", "pose": p.tolist(), "component": 0,
            "verdict": "", "reason": ""} for i, p in enumerate(poses)]
entries[5].update(status="unregistered", pose=None)
json.dump({"schema": 1, "reference": "002.ply", "scans": entries}, open(folder + "/poses.json", "w"))
PYTHON

"$exe" evaluate --scans "$town" --poses "$folder/poses.json" --truth "$town/truth.json" --json "$folder/ours.json" || exit 1
"$python" "$scorer" "$town" "$folder/poses.json" --json "$folder/theirs.json" # its exit status tells of wrong scans
"$python" - "$folder" <<'PYTHON'
import json, sys
ours = json.load(open(sys.argv[1] + "/ours.json"))
theirs = json.load(open(sys.argv[1] + "/theirs.json"))["scenes"][0]
assert (theirs["ok"], theirs["flagged"], theirs["wrong"]) == (3, 1, 2), theirs  # the poses are what they are meant to be
bad = []
for name in ("ok", "flagged", "wrong", "pairs", "pairs_ok", "median_rotation_deg", "median_rmse", "max_rmse"):
    # Both sum up doubles, in different orders.
    if abs(ours[name] - theirs[name]) > 1e-9 * max(1, abs(theirs[name])):
        bad.append(f"{name}: {ours[name]} here, {theirs[name]} there")
sys.exit("; ".join(bad) or 0)
PYTHON
