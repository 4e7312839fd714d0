#!/usr/bin/env bash
# Installs the packages of scripts/make_packages.sh in a bare Debian 12 and uses each: registers the example with the
# program and with Python, compiles programs against the library by CMake and by pkg-config. Needs root, the network and
# debootstrap; takes some minutes. TCM_ICP_DEBIAN_MIRROR names another mirror, TCM_ICP_ROOT where the root folder is made.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$repository"

mirror=${TCM_ICP_DEBIAN_MIRROR:-http://deb.debian.org/debian}
root=${TCM_ICP_ROOT:-$repository/build/bare-debian}
packages=build/packages/packages
(($(id -u) == 0)) || fail "needs root: debootstrap and chroot do"
command -v debootstrap >/dev/null || fail "debootstrap is missing; apt-get install debootstrap"
compgen -G "$packages/*.deb" >/dev/null || fail "there are no packages; run scripts/make_packages.sh"

bootstrap() {
  rm -rf "$root"
  debootstrap --variant=minbase bookworm "$root" "$mirror"
  rm -rf "$root.base"
  cp -a "$root" "$root.base"
}
fresh() {
  rm -rf "$root"
  cp -a "$root.base" "$root"
  mkdir -p "$root/packages" "$root/work"
  cp "$packages"/*.deb "$root/packages/"
  cp -r tests/install/consumer "$root/work/consumer"
}
inside() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
# Steps are chained: within quiet_step a failing one would not end the function.
# Names of packages; their files are in /packages, what they need comes from Debian.
install_packages() {
  local names=()
  local name
  for name in "$@"; do names+=("/packages/${name}_"*.deb); done
  inside sh -c "apt-get -q update && apt-get -q install --yes --no-install-recommends ${names[*]}"
}
tools() { inside apt-get -q install --yes --no-install-recommends g++ cmake make pkg-config; }

program() {
  install_packages libtcm-icp0.1 tcm-icp tcm-icp-doc && inside tcm-icp --version &&
    inside tcm-icp register /usr/share/doc/tcm_icp/datasets/town --out /work/town &&
    test -s "$root/work/town/report.html"
}
python() {
  install_packages libtcm-icp0.1 python3-tcm-icp &&
    inside sh -c 'cd /work && python3 /usr/share/doc/tcm_icp/examples/register_arrays.py /usr/share/doc/tcm_icp/datasets/town/*.ply'
}
find_package() {
  install_packages libtcm-icp0.1 libtcm-icp-dev && tools &&
    inside sh -c 'cd /work && cmake -S consumer -B by-cmake -DCMAKE_BUILD_TYPE=Release && cmake --build by-cmake && by-cmake/consumer'
}
pkg_config() {
  # shellcheck disable=SC2016  # the root's own shell asks pkg-config
  inside sh -c 'cd /work && g++ -std=c++20 -O1 consumer/main.cpp $(pkg-config --cflags --libs tcm_icp) -o by-pkg-config && ./by-pkg-config'
}
removal() {
  inside sh -c 'apt-get -q remove --yes --purge tcm-icp python3-tcm-icp libtcm-icp-dev tcm-icp-doc libtcm-icp0.1 && ! ls /usr/bin/tcm-icp'
}

[[ -d $root.base ]] || quiet_step debootstrap bootstrap || fail "no bare Debian"
quiet_step fresh fresh || fail "the root cannot be made"
quiet_step program program || fail "the program does not work where it is installed"
quiet_step python python || fail "the Python module does not work where it is installed"
quiet_step find-package find_package || fail "the library cannot be used by find_package"
quiet_step pkg-config pkg_config || fail "the library cannot be used by pkg-config"
quiet_step removal removal || fail "the packages cannot be removed"
echo "The packages work in a bare Debian 12."
