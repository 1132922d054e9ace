// The platform in WebAssembly: a program that is run once, on files that are gone behind it.
#include "surface/cli/platform.h"

namespace feedhold {

std::vector<std::string> beginProgram(int argc, char **argv) { return {argv + (argc > 0 ? 1 : 0), argv + argc}; }

bool isTerminal(Stream) { return false; }

std::uint64_t processId() { return 1; }

std::string buildId() { return ""; }

std::optional<std::filesystem::path> userCache() { return std::nullopt; }

} // namespace feedhold
