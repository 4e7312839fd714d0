#!/usr/bin/env bash
# Fails where clang-format (Debian 12 has 14) would change a C++ file. With --fix it changes them.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$repository"

mode=(--dry-run -Werror)
case ${1-} in
  "") ;;
  --fix) mode=(-i) ;;
  *) fail "usage: check_format.sh [--fix]" ;;
esac
command -v clang-format >/dev/null || fail "clang-format is missing; scripts/install_dependencies.sh --checks installs it"

mapfile -d '' files < <(find app lib tests benchmarks python examples \( -name '*.hpp' -o -name '*.cpp' \) -print0 | sort -z)
((${#files[@]} > 0)) || fail "no C++ files were found"
clang-format "${mode[@]}" "${files[@]}"
echo "${#files[@]} files are formatted"
