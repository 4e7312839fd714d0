#!/usr/bin/env bash
# Makes the manual as a site in build/site: the pages of docs/ by mkdocs, the reference of the library by Doxygen. A public
# name without a docstring is an error.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$repository"

# Pages link to files outside docs/ as they do in the repository: the site has the same folders.
collect() {
  rm -rf build/site-source
  mkdir -p build/site-source/lib
  cp -r README.md CONTRIBUTING.md CHANGELOG.md LICENSE docs third_party_notes examples scripts build/site-source/
  cp -r lib/include build/site-source/lib/
  mkdir -p build/site-source/datasets/town
  cp datasets/README.md datasets/manifest.json build/site-source/datasets/
  printf '# Reference of the C++ interface\n\nBy Doxygen: [namespace tcm_icp](reference/index.html).\n' >build/site-source/reference.md
  mkdir build/site-source/reference
  touch build/site-source/reference/index.html  # Doxygen writes over it
}

quiet_step install scripts/install_dependencies.sh --site || fail "dependencies cannot be installed"
quiet_step collect collect || fail "the pages cannot be copied"
quiet_step pages mkdocs build --quiet --clean --strict || fail "the pages cannot be made"
quiet_step reference doxygen Doxyfile || fail "a public name lacks its docstring"
echo "Look: build/site/index.html, build/site/reference/index.html"
