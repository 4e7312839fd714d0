#!/usr/bin/env bash
# Installs what is missing, builds the benchmarks, runs them all and writes their JSON and one readable table to
# out/benchmarks/. Takes about five minutes after the build; keep the machine quiet meanwhile.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'TEXT'
Usage: benchmarks.sh [--pair TARGET SOURCE TRUTH.json]...
  --pair  also registers these two scans; TRUTH.json holds their poses. The made-up street and datasets/town always run.
TEXT
}

pairs=()
while (($# > 0)); do
  case $1 in
    --pair)
      (($# >= 4)) || { usage >&2; exit 1; }
      pairs+=(--pair "$(realpath "$2")" "$(realpath "$3")" "$(realpath "$4")")
      shift 4
      ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 1 ;;
  esac
done
cd "$repository"
town=datasets/town
if [[ -f $town/truth.json ]]; then
  pairs+=(--pair "$town/000.ply" "$town/001.ply" "$town/truth.json")
fi

quiet_step install scripts/install_dependencies.sh --benchmarks || fail "dependencies cannot be installed"
quiet_step configure cmake --preset release -B build/bench -DTCM_ICP_BUILD_BENCHMARKS=ON -DTCM_ICP_BUILD_TESTS=OFF \
  -DTCM_ICP_BUILD_APP=OFF || fail "configuring failed"
quiet_step build cmake --build build/bench --parallel "$(nproc)" --target all_benchmarks || fail "the build failed"

mkdir -p out/benchmarks
# run NAME OPTION...: one executable, its results in out/benchmarks/NAME.json.
run() {
  local name=$1
  shift
  quiet_step "$name" "build/bench/benchmarks/tcm_icp_benchmark_$name" --benchmark_out_format=json \
    --benchmark_out="out/benchmarks/$name.json" "$@" || fail "the $name benchmark failed"
}
run neighbor --benchmark_repetitions=5 --benchmark_min_time=0.2 --benchmark_report_aggregates_only=true \
  --benchmark_enable_random_interleaving=true
run lp --benchmark_min_time=0.2
run registration ${pairs[@]+"${pairs[@]}"}

python3 scripts/benchmark_tables.py out/benchmarks >out/benchmarks/tables.md || fail "no tables from out/benchmarks"
cat out/benchmarks/tables.md
