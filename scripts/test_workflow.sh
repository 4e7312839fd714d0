#!/usr/bin/env bash
# test_workflow.sh TCM_ICP [--slurm] [SCAN...]: the steps by hand, by workflow/Snakefile on this machine, and with --slurm
# on a Slurm of one node with two workers, all give the bits of 'tcm-icp register', and a scan that is added costs its
# own pairs. The Slurm is started for the test (as root; Debian's slurmctld, slurmd and munge) and ended with it.
# Exits with 77 where snakemake or, with --slurm, Slurm is not installed.
set -euo pipefail
exe=$(realpath "$1") && shift
with_slurm=""
[[ ${1:-} == --slurm ]] && with_slurm=yes && shift
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
scans=("$@")
[[ ${#scans[@]} -gt 0 ]] || scans=("$repository"/datasets/town/*.ply)
needed=(snakemake)
[[ -n $with_slurm ]] && needed+=(slurmctld slurmd munged sbatch)
for program in "${needed[@]}"; do
  command -v "$program" >/dev/null && continue
  echo "SKIPPED: $program is not installed (apt-get install snakemake slurmctld slurmd munge)"
  exit 77
done

folder=$(mktemp -d)
slurm_pids() { cat "$folder"/slurm/*.pid 2>/dev/null || true; }
clean_up() {
  local pid
  for pid in $(slurm_pids); do kill "$pid" 2>/dev/null || true; done
  [[ -z $(slurm_pids) ]] || sleep 1
  rm -rf "$folder"
}
trap clean_up EXIT
cd "$folder"

# Small samples: a town in a second. Real scans are taken as they are.
: >options.cfg
if [[ $# -eq 0 ]]; then
  printf 'sampling.working-points = 20000\nsampling.coarse-voxels = 4000\nsampling.fine-voxels = 10000\n' >options.cfg
fi
expect_same() { # FOLDER FILE...
  local result=$1 file
  shift
  for file in "$@"; do
    cmp "plain/$file" "$result/$file" || { echo "FAILED: $result/$file is not that of register" && exit 1; }
  done
}
num_done() { cat "$1"/log/*.tsv | wc -l; }
each=()
for scan in "${scans[@]}"; do each+=("scans/$(basename "$scan")"); done
"$exe" register "${scans[@]}" --config options.cfg --each --out plain --quiet

# By hand, blocks in any order, one of them twice at once.
"$exe" sample "${scans[@]}" --config options.cfg --work hand --quiet
"$exe" plan "${scans[@]}" --config options.cfg --work hand --quiet
for block in 3 1 2; do "$exe" match --work hand --block $block/3 --config options.cfg --quiet; done
"$exe" match --work hand --block 2/2 --config options.cfg --quiet &
"$exe" match --work hand --block 2/2 --config options.cfg --quiet
wait $!
before=$(num_done hand)
"$exe" solve "${scans[@]}" --config options.cfg --work hand --out by-hand --quiet
solved=$(num_done hand)
"$exe" write "${scans[@]}" --config options.cfg --work hand --out by-hand --quiet
expect_same by-hand poses.json "${each[@]}"
[[ $(num_done hand) == "$solved" ]] || { echo "FAILED: write did a step again" && exit 1; }
[[ $(cut -f3 hand/log/*.tsv | sort | uniq -d | wc -l) == 0 ]] || { echo "FAILED: a step was done twice" && exit 1; }
"$exe" register "${scans[@]}" --config options.cfg --work hand --out merged --quiet
expect_same merged poses.json registered.ply
echo "by hand: the same bits; $before steps by sample, plan and match, $((solved - before)) by solve"

# A scan that is added to a finished set: what is done is its own.
last=$((${#scans[@]} - 1))
"$exe" register "${scans[@]:0:last}" --config options.cfg --work grown --out fewer --quiet
before=$(cut -f2 grown/log/*.tsv | sort | uniq -c | tr '\n' ' ')
sum=$(num_done grown)
"$exe" register "${scans[@]}" --config options.cfg --work grown --out grown-result --quiet || [[ $? -eq 3 ]]
[[ $(cut -f3 grown/log/*.tsv | sort | uniq -d | wc -l) == 0 ]] || { echo "FAILED: a step was done twice" && exit 1; }
for kind in samples viewpoints; do
  number=$(cut -f2 grown/log/*.tsv | grep -c "^$kind$")
  [[ $number == "${#scans[@]}" ]] || { echo "FAILED: $number $kind of ${#scans[@]} scans" && exit 1; }
done
# Pairs are named by both scans: none was searched on two grids.
number=$(cut -f2 grown/log/*.tsv | grep -c "^height-maps$")
((number <= ${#scans[@]} * last / 2)) || { echo "FAILED: $number pairs of ${#scans[@]} scans" && exit 1; }
echo "one scan more: $(($(num_done grown) - sum)) steps, after $sum ($before)"

cat >project.yaml <<EOF
scans: [$(printf '"%s", ' "${scans[@]}")]
out: made
blocks: 3
options: options.cfg
program: $exe
EOF
make() { # WORK OUT SNAKEMAKE_OPTION...
  local work=$1 out=$2
  shift 2
  snakemake -s "$repository/workflow/Snakefile" --configfile project.yaml --config "work=$work" "out=$out" \
    "$@" >"$out.log" 2>&1 || { cat "$out.log" && exit 1; }
}
make work2 made --profile "$repository/workflow/profiles/local" --cores 2
expect_same made poses.json "${each[@]}"
make work2 again --profile "$repository/workflow/profiles/local" --cores 2 --config merged=True work=work2 out=again --forcerun solve
expect_same again poses.json registered.ply "${each[@]}"
echo "snakemake --cores 2: the same bits"
[[ -n $with_slurm ]] || exit 0

mkdir -p slurm/state slurm/spool
cat >slurm/slurm.conf <<EOF
ClusterName=test
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/slurm/munge.socket
StateSaveLocation=$folder/slurm/state
SlurmdSpoolDir=$folder/slurm/spool
SlurmctldPidFile=$folder/slurm/slurmctld.pid
SlurmdPidFile=$folder/slurm/slurmd.pid
SlurmctldLogFile=$folder/slurm/slurmctld.log
SlurmdLogFile=$folder/slurm/slurmd.log
SlurmctldPort=26827
SlurmdPort=26828
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0
MpiDefault=none
MailProg=/bin/true
NodeName=$(hostname) NodeAddr=127.0.0.1 CPUs=2 RealMemory=100000 State=UNKNOWN
PartitionName=all Nodes=$(hostname) Default=YES State=UP
SlurmdParameters=config_overrides
EOF
head -c 1024 /dev/urandom >slurm/munge.key
chmod 400 slurm/munge.key
chmod 755 "$folder" slurm
munged --force --key-file="$folder/slurm/munge.key" --socket="$folder/slurm/munge.socket" \
  --pid-file="$folder/slurm/munged.pid" --log-file="$folder/slurm/munged.log" --seed-file="$folder/slurm/munge.seed"
export SLURM_CONF=$folder/slurm/slurm.conf
slurmctld -f "$SLURM_CONF" -c && slurmd -f "$SLURM_CONF"
for _ in {1..30}; do
  [[ $(sinfo --noheader --format %T 2>/dev/null) == idle ]] && break
  sleep 1
done
make work3 by-slurm --profile "$repository/workflow/profiles/slurm" --max-threads 1 --latency-wait 10
expect_same by-slurm poses.json "${each[@]}"
jobs=$(find . -maxdepth 1 -name 'slurm-tcm-icp-*.log' | wc -l)
echo "Slurm, one node, two workers: the same bits by $jobs jobs"
