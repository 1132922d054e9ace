#include "surface/cli/command_words.h"

#include <algorithm>

namespace feedhold {

namespace {

std::string nameOf(const CLI::Option &option) {
  return option.get_lnames().empty() ? "-" + option.get_snames().front() : "--" + option.get_lnames().front();
}

/// `--format` of `--format=json`
std::string_view nameIn(std::string_view word) { return word.substr(0, word.find('=')); }

} // namespace

std::vector<std::string> wordsOf(const CLI::App &command, const std::vector<std::string> &without) {
  std::vector<std::string> words;
  std::vector<std::string> paths;
  for (const CLI::Option *option : command.get_options()) {
    if (option->count() == 0)
      continue;
    if (option->get_positional()) {
      paths = option->results();
      continue;
    }
    const std::string name = nameOf(*option);
    if (std::find(without.begin(), without.end(), name) != without.end())
      continue;
    if (option->get_items_expected_max() == 0)
      words.push_back(name);
    else
      for (const std::string &value : option->results())
        words.push_back(name + "=" + value);
  }
  words.insert(words.end(), paths.begin(), paths.end());
  return words;
}

std::vector<std::string> replaced(std::vector<std::string> words, const std::vector<std::string> &instead) {
  std::erase_if(words, [&](const std::string &word) {
    return word.starts_with('-') && std::any_of(instead.begin(), instead.end(), [&](const std::string &other) {
             return nameIn(other) == nameIn(word);
           });
  });
  words.insert(words.begin(), instead.begin(), instead.end());
  return words;
}

} // namespace feedhold
