# Completion of tcm-icp for bash. Options are asked of the program itself, so that they are those of its version.

_tcm_icp_options() {
  local help=--help
  [[ $2 == register ]] && help=--help-all
  "$1" "$2" "$help" 2>/dev/null | grep -oE '^ +(-[a-z] \[ )?--[a-z][a-z.-]*' | grep -oE -e '--[a-z.-]+'
}

_tcm_icp() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} words=""
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "register evaluate degrade inspect render simulate sample plan match solve write --help --version" -- "$cur")
    return
  fi
  case $prev in
    --method) words="tcm icp features" ;;
    --profile) words="robust paper" ;;
    --solver) words="glpk cgal" ;;
    --outliers) words="kmeans distance lof none" ;;
    --refinement) words="auto none descent annealing both" ;;
    --merge-order) words="tcm paper-tcm robust-tcm overlap file random" ;;
    --without) words="nothing features slides implied free-space twins constant" ;;
    --lp.formulation) words="plane point entries squares" ;;
    --paper.matches) words="nearest threshold mutual" ;;
    --paper.slack) words="both above below between" ;;
    --paper.unknowns) words="entries twist" ;;
    --paper.points) words="sample all" ;;
    --paper.end) words="motion slack" ;;
    --paper.descent) words="scans matches" ;;
    --bin) words="kitti nuscenes" ;;
    --unit) words="m mm ft us-ft" ;;
    --scene) words="town block street urban canopy orchard tunnel motorway interior plaza bays storeys town-grid" ;;
    --sensor) words="terrestrial spinning aerial" ;;
    *) [[ $cur == -* ]] && words=$(_tcm_icp_options "${COMP_WORDS[0]}" "${COMP_WORDS[1]}") ;;
  esac
  # Without words: files, which readline completes by itself.
  [[ -n $words ]] && mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
}

complete -o default -o bashdefault -F _tcm_icp tcm-icp
