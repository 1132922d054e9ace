// What the command line asks the operating system, beside files and child processes.  One .cpp for each system.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace feedhold {

/// The words of the command line in UTF-8, without the name of the program; streams are as bytes from now on.
std::vector<std::string> beginProgram(int argc, char **argv);

enum class Stream : std::uint8_t { Output, Error };
/// A terminal that shows colours and takes its last line back.
bool isTerminal(Stream stream);

std::uint64_t processId();

/// Changes with every other build of the program.  Empty: unknown.
std::string buildId();

/// Where programs keep for this user what they can make again.
std::optional<std::filesystem::path> userCache();

} // namespace feedhold
