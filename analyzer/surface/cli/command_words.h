// The words of a command line, made again from the options that were read.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace feedhold {

/// The options that were given, each as `--name` or `--name=value`, in the order in which the command lists them, then
/// `--` and the paths.  Different spellings of the same options give the same words.
std::vector<std::string> wordsOf(const CLI::App &command, const std::vector<std::string> &without);

/// `words` with the options of `instead` in place of those of the same names.
std::vector<std::string> replaced(std::vector<std::string> words, const std::vector<std::string> &instead);

} // namespace feedhold
