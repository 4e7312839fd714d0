#!/usr/bin/env bash
# Feeds every reader with damaged files for some seconds each (libFuzzer, address and undefined behaviour sanitizers).
# Begins with small good files of each format and with what earlier runs found interesting; ends with a table.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() {
  cat <<'TEXT'
Usage: fuzz.sh SECONDS [TARGET...]
  SECONDS  for each target; as many run side by side as there are processors
  TARGET   ply, las, pcd, e57, ptx, pts, xyz, csv, kitti, nuscenes, gzip, poses, truth, control, positions,
           priors, config; all of them by default
Needs clang (install_dependencies.sh --checks) and builds build/fuzz. Files found interesting are kept in
build/fuzz/corpus, those that break a reader in build/fuzz/crashes. TCM_ICP_FORMATS=FOLDER adds the files of other
programs in it, by extension, to the first ones. The exit status is 1 where a reader broke.
TEXT
}

if (($# == 0)) || [[ $1 == -h || $1 == --help ]]; then
  usage
  exit $(($# == 0))
fi
if ! [[ $1 =~ ^[1-9][0-9]*$ ]]; then
  usage >&2
  exit 1
fi
seconds=$1
shift

build=build/fuzz
cmake --preset fuzz >/dev/null
rm -rf "$build/seeds"
mkdir -p "$build/seeds" "$build/corpus" "$build/crashes" "$build/logs"
if ! cmake --build --preset fuzz --parallel "$(nproc)" >"$build/logs/build.log" 2>&1; then
  grep -v '^\[' "$build/logs/build.log" >&2
  exit 1
fi
"$build/tests/fuzz/make_fuzz_seeds" "$build/seeds"

mapfile -t targets <"$build/tests/fuzz/targets.txt"
if (($# > 0)); then
  targets=("${@/#/fuzz_}")
fi

# add_others NAME: files of other programs, small ones: large ones make every trial slow.
add_others() {
  local name=$1 file number=0
  [[ -d ${TCM_ICP_FORMATS:-} ]] || return 0
  while IFS= read -r -d '' file; do
    number=$((number + 1))
    cp "$file" "$build/seeds/$name/other_$number"
  done < <(find "$TCM_ICP_FORMATS" -name "*.$name" -size -128k -print0 | sort -z)
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# run NAME: leaves its exit status in the work folder.
run() {
  local name=$1 status=0
  mkdir -p "$work/$name"
  # No single allocation beyond 512 MiB: a file of some kilobytes has no reason to ask for one. Leaks are looked for at
  # the end only: readers remember each file, which would start a search after every one.
  TMPDIR=$work/$name "$build/tests/fuzz/fuzz_$name" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 \
    -malloc_limit_mb=512 -max_len=65536 -detect_leaks=0 -print_final_stats=1 -artifact_prefix="$build/crashes/$name-" \
    "$build/corpus/$name" "$build/seeds/$name" >"$build/logs/$name.log" 2>&1 || status=$?
  echo "$status" >"$work/$name.status"
}

for target in "${targets[@]}"; do
  name=${target#fuzz_}
  mkdir -p "$build/corpus/$name" "$build/seeds/$name"
  add_others "$name"
  while (($(jobs -rp | wc -l) >= $(nproc))); do wait -n; done
  run "$name" &
done
wait

failures=0
summary=()
for target in "${targets[@]}"; do
  name=${target#fuzz_}
  log=$build/logs/$name.log
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  verdict=passed
  if (($(cat "$work/$name.status") != 0)); then
    verdict="BROKE ($log)"
    failures=$((failures + 1))
  fi
  summary+=("$(printf '%-10s %12s  %s' "$name" "${executions:-?}" "$verdict")")
done

echo
printf '%-10s %12s\n' target executions
printf '%s\n' "${summary[@]}"
echo "${#targets[@]} targets, $failures broke"
((failures == 0))
