#!/usr/bin/env bash
# completion_test.sh TCM_ICP COMPLETIONS: what bash offers, and that the choices of options, written down in three files,
# are those that the program takes.
set -u
PATH="$(dirname "$1"):$PATH"
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# shellcheck source=/dev/null
source "$2/tcm-icp.bash"
offered() { # WORD...: what is offered for the last word
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _tcm_icp
  echo "${COMPREPLY[*]}"
}
expect() { # RESULT WORD...
  local wanted=$1 got
  shift
  got=$(offered "$@")
  [[ $got == "$wanted" ]] || fail "$* offers '$got', not '$wanted'"
}
expect "register" tcm-icp reg
expect "--sampling.coarse-voxels" tcm-icp register --sampling.c
expect "--reference" tcm-icp register --refe
expect "--json" tcm-icp inspect --js
expect "--help --help-all" tcm-icp register --help
expect "paper" tcm-icp register --profile p
expect "" tcm-icp register scan

# The error about a value that is none lists those that there are.
while read -r option words; do
  command=register
  [[ $option == --scene || $option == --sensor ]] && command=simulate
  out=$(tcm-icp "$command" a.xyz b.xyz --out /nonexistent/new "$option" '?' 2>&1)
  [[ $command == simulate ]] && out=$(tcm-icp "$command" --out /nonexistent/new "$option" '?' 2>&1)
  known=$(sed -nE 's/.*(choose one of|there are:) //p' <<<"$out" | tr -d ,)
  [[ $known == "$words" ]] || fail "$option: completions offer '$words', the program takes '$known'"
  grep -qF -e "$option) choices=($words)" "$2/_tcm-icp" || fail "_tcm-icp: $option"
  grep -qF "value ${option#--}' -f -a '$words'" "$2/tcm-icp.fish" || fail "tcm-icp.fish: $option"
done < <(sed -nE 's/^ +(--[a-z.-]+)\) words="(.*)" ;;/\1 \2/p' "$2/tcm-icp.bash" | grep -vE -e '--(bin|unit) ')

for shell in zsh fish; do
  file=$2/_tcm-icp
  [[ $shell == fish ]] && file=$2/tcm-icp.fish
  command -v "$shell" >/dev/null || continue
  "$shell" -n "$file" || fail "$file: $shell does not take it"
done
exit $((failures > 0))
