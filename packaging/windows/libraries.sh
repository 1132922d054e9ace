#!/usr/bin/env bash
# The libraries of the program for Windows: `libraries.sh FOLDER` leaves include/ and lib/ there.  Debian's headers are
# linked; GMP is cross-built from Debian's source package.
set -euo pipefail
mkdir -p "$1"
folder=$(cd "$1" && pwd)
mkdir -p "$folder/include"
for library in CLI fmt nlohmann toml++; do
  ln -sfn "/usr/include/$library" "$folder/include/$library"
done
[ -e "$folder/lib/libgmpxx.a" ] && exit 0
# Lists of its own: those of the machine stay as they are.
mkdir -p "$folder/apt/lists/partial" "$folder/source"
sed 's/^Types: deb$/Types: deb-src/' /etc/apt/sources.list.d/debian.sources >"$folder/apt/debian.sources"
options=(-qq -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$folder/apt" -o "Dir::State::Lists=$folder/apt/lists"
  -o APT::Sandbox::User=root)
cd "$folder/source"
apt-get "${options[@]}" update
apt-get "${options[@]}" source gmp >/dev/null
cd gmp-*/
mkdir -p doc # which Debian leaves out
printf 'all install:\n' >doc/Makefile.in
./configure --quiet --host=x86_64-w64-mingw32 --enable-cxx --disable-shared --prefix="$folder" \
  CXX=x86_64-w64-mingw32-g++-posix CC=x86_64-w64-mingw32-gcc-posix >/dev/null
make -s -j"$(nproc)" >/dev/null 2>&1
make -s install >/dev/null
