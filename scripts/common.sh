# Sourced by the other scripts: where the repository is, quiet steps with their seconds, and failing with a reason.
# shellcheck shell=bash

repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
readonly repository
readonly log_folder="$repository/build/logs"

# fail REASON...: ends the script; the reason goes to stderr.
fail() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}

# quiet_step NAME COMMAND...: runs the command with its output in build/logs/NAME.log and prints how long it took. Where it
# fails, the end of the log is printed and its exit status returned: a long build shows only what went wrong.
quiet_step() {
  local name=$1 start=$SECONDS status=0
  shift
  mkdir -p "$log_folder"
  local log="$log_folder/$name.log"
  printf '%-22s ' "$name"
  "$@" >"$log" 2>&1 </dev/null || status=$?
  if ((status == 0)); then
    echo "$((SECONDS - start)) s"
    return 0
  fi
  echo "failed after $((SECONDS - start)) s (exit status $status)"
  {
    echo "--- the end of ${log#"$repository"/}; the command was: $*"
    tail -n 60 "$log"
    echo "---"
  } >&2
  return "$status"
}
