#!/usr/bin/env bash
# Installs what is missing, builds the release preset with its tests, and runs every test. The last line is
# "N passed, M failed" (and ", K skipped" where some were); each GoogleTest case counts as one. With
# TCM_ICP_WARNINGS_AS_ERRORS=ON in the environment a warning of the compiler fails the build.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$repository"

junit=build/release/ctest-junit.xml

# Counts of the JUnit file ctest wrote. A test that could not be run (its executable is missing) has failed: only a test
# that says itself that it skips is skipped.
closing_line() {
  awk '
    /^[ \t]*<testcase / {
      ++total
      if (/ status="fail"/) ++failed
      if (/ status="disabled"/) ++skipped
      if (/ status="notrun"/) ++not_run
    }
    /^[ \t]*<skipped message="SKIP_/ { ++skipped; --not_run }
    END {
      failed += not_run
      printf "%d passed, %d failed", total - failed - skipped, failed
      if (skipped > 0) printf ", %d skipped", skipped
      printf "\n"
    }' "$1"
}

quiet_step install scripts/install_dependencies.sh --tests --conventional || fail "dependencies cannot be installed"
quiet_step configure cmake --preset release -DTCM_ICP_BUILD_TESTS=ON \
  -DTCM_ICP_WARNINGS_AS_ERRORS="${TCM_ICP_WARNINGS_AS_ERRORS:-OFF}" || fail "configuring failed"
quiet_step build cmake --build build/release --parallel "$(nproc)" || fail "the build failed"

rm -f "$junit"
status=0
ctest --test-dir build/release --output-on-failure --no-tests=error --parallel "$(nproc)" \
  --output-junit "$repository/$junit" </dev/null || status=$?
[[ -s $junit ]] || fail "ctest wrote no results (exit status $status)"
echo
closing_line "$junit"
exit "$status"
