#include "surface/cli/command_words.h"

#include <algorithm>

namespace feedhold {

namespace {

constexpr std::string_view kPathsFollow = "--";

std::string nameOf(const CLI::Option &option) {
  return option.get_lnames().empty() ? "-" + option.get_snames().front() : "--" + option.get_lnames().front();
}

/// `--format` of `--format=json`
std::string_view nameIn(std::string_view word) { return word.substr(0, word.find('=')); }

/// An empty value is none: it would take the next word in its place.
void addValues(std::vector<std::string> &words, const std::string &name, const std::vector<std::string> &values) {
  for (const std::string &value : values)
    if (!value.empty())
      words.push_back(name + "=" + value);
}

} // namespace

std::vector<std::string> wordsOf(const CLI::App &command, const std::vector<std::string> &without) {
  std::vector<std::string> words;
  std::vector<std::string> paths;
  for (const CLI::Option *option : command.get_options()) {
    const std::string name = option->get_positional() ? "" : nameOf(*option);
    if (option->count() == 0 || std::find(without.begin(), without.end(), name) != without.end())
      continue;
    if (option->get_positional())
      paths = option->results();
    else if (option->get_items_expected_max() > 0)
      addValues(words, name, option->results());
    else if (option->as<bool>()) // `--quiet=false` is no `--quiet`
      words.push_back(name);
  }
  words.emplace_back(kPathsFollow);
  words.insert(words.end(), paths.begin(), paths.end());
  return words;
}

std::vector<std::string> replaced(std::vector<std::string> words, const std::vector<std::string> &instead) {
  const auto optionsEnd = [](auto &of) { return std::find(of.begin(), of.end(), kPathsFollow); };
  const std::vector<std::string> options(instead.begin(), optionsEnd(instead));
  const auto isReplaced = [&](const std::string &word) {
    return std::any_of(options.begin(), options.end(),
                       [&](const std::string &other) { return nameIn(other) == nameIn(word); });
  };
  words.erase(std::remove_if(words.begin(), optionsEnd(words), isReplaced), optionsEnd(words));
  words.insert(words.begin(), options.begin(), options.end());
  return words;
}

} // namespace feedhold
