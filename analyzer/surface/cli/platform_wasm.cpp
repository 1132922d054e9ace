// The platform in WebAssembly: the page, where a program is run once, on files that are gone behind it; and Node.js
// (editors/vscode/src/server.ts), which says which build this is, so that what is kept on disk is known again.
#include "surface/cli/platform.h"

#include <emscripten.h>

#include <array>

namespace feedhold {

namespace {

EM_JS(void, copyBuildId, (char *to, int most), { stringToUTF8(Module.buildId || "", to, most); });

} // namespace

std::vector<std::string> beginProgram(int argc, char **argv) { return {argv + (argc > 0 ? 1 : 0), argv + argc}; }

bool isTerminal(Stream) { return false; }

std::uint64_t processId() { return 1; }

std::string buildId() {
  std::array<char, 128> id{};
  copyBuildId(id.data(), static_cast<int>(id.size()));
  return id.data();
}

} // namespace feedhold
