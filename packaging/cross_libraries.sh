#!/usr/bin/env bash
# The libraries of a program for another system: `cross_libraries.sh windows|wasm FOLDER` leaves include/ and lib/ there.
# Debian's headers are linked; GMP is cross-built from Debian's source package.  Exit code 3: that cannot be fetched.
set -euo pipefail
system=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
mkdir -p "$folder/include"
for library in CLI fmt nlohmann toml++; do
  ln -sfn "/usr/include/$library" "$folder/include/$library"
done
[ -e "$folder/lib/libgmpxx.a" ] && exit 0

# GMP has no assembly for WebAssembly, and its configure script does not know the name.  NODE_PATH: where Debian has the
# packages of emscripten, which a Node.js from elsewhere does not find.
configure_gmp() {
  local options=(--quiet --enable-cxx --disable-shared --prefix="$folder")
  case $system in
  windows) ./configure "${options[@]}" --host=x86_64-w64-mingw32 CXX=x86_64-w64-mingw32-g++-posix CC=x86_64-w64-mingw32-gcc-posix ;;
  wasm) NODE_PATH=/usr/share/nodejs emconfigure ./configure "${options[@]}" --host=none --disable-assembly CC_FOR_BUILD=gcc CFLAGS=-O2 ;;
  *) echo "cross_libraries.sh: no system $system" >&2; return 2 ;;
  esac
}

# Lists of its own: those of the machine stay as they are.
mkdir -p "$folder/apt/lists/partial" "$folder/source"
sed 's/^Types: deb$/Types: deb-src/' /etc/apt/sources.list.d/debian.sources >"$folder/apt/debian.sources" || exit 3
options=(-qq -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$folder/apt" -o "Dir::State::Lists=$folder/apt/lists"
  -o APT::Sandbox::User=root)
cd "$folder/source"
apt-get "${options[@]}" update && apt-get "${options[@]}" source gmp >/dev/null ||
  { echo "cross_libraries.sh: the source package of GMP cannot be fetched" >&2; exit 3; }
cd gmp-*/
mkdir -p doc # which Debian leaves out
printf 'all install:\n' >doc/Makefile.in
configure_gmp >/dev/null
make -s -j"$(nproc)" >/dev/null 2>&1
make -s install >/dev/null
