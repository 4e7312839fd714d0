#!/usr/bin/env bash
# Makes the .deb packages of the program, the shared library, its headers, the Python module and the manual in
# build/packages/packages. Builds on Debian 12; the first run installs what is missing. Whoever hands the packages on sets
# TCM_ICP_MAINTAINER="Name <address>".
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$repository"

folder=build/packages
quiet_step install scripts/install_dependencies.sh --packages || fail "dependencies cannot be installed"
maintainer=()
[[ -z "${TCM_ICP_MAINTAINER:-}" ]] || maintainer=("-DTCM_ICP_MAINTAINER=$TCM_ICP_MAINTAINER")
quiet_step configure cmake --preset packages "${maintainer[@]}" || fail "configuring failed"
quiet_step build cmake --build "$folder" --parallel "$(nproc)" || fail "the build failed"
rm -rf "$folder/packages"
pack() { (cd "$folder" && cpack -G DEB); }
quiet_step pack pack || fail "the packages cannot be made"
rm -rf "$folder/packages/_CPack_Packages"
for package in "$folder"/packages/*.deb; do
  printf '%8d kB  %s\n' "$(($(stat -c %s "$package") / 1000))" "$package"
done
