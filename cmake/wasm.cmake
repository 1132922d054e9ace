# Toolchain: from Debian to WebAssembly, by Debian's emscripten.  No threads and no processes.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)

# Where Debian has the packages of Node.js that emscripten links with; a Node.js from elsewhere does not look there.
set(ENV{NODE_PATH} /usr/share/nodejs)
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")

set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions")
set(FEEDHOLD_SHIMS ${CMAKE_CURRENT_LIST_DIR}/wasm)
