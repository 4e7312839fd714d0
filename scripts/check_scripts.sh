#!/usr/bin/env bash
# Runs shellcheck over every shell script of the repository.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$repository"

command -v shellcheck >/dev/null || fail "shellcheck is missing; scripts/install_dependencies.sh --checks installs it"
scripts=(.ci/run scripts/*.sh)
shellcheck --external-sources "${scripts[@]}"
echo "${#scripts[@]} scripts are clean"
