#!/usr/bin/env bash
# status.sh JOB: "success", "failed" or "running", as Snakemake asks for it. Jobs that Slurm has forgotten are looked up in
# its accounting, where there is one.
set -u
state=$(scontrol --oneliner show job "$1" 2>/dev/null | sed -nE 's/.* JobState=([A-Z_]+).*/\1/p')
[[ -n $state ]] || state=$(sacct --jobs="$1" --format=State --noheader --parsable2 2>/dev/null | head -n 1)
case $state in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | "") echo running ;;
  *) echo failed ;;
esac
