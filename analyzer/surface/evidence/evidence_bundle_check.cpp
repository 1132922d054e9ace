// Compares a stored evidence bundle with a new proof of the same programs.
#include "surface/evidence/evidence_bundle.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace feedhold {

namespace {

using Json = nlohmann::ordered_json;

/// The rows of a list by the text of one of their members.
std::map<std::string, Json> rowsBy(const Json &rows, const char *member) {
  std::map<std::string, Json> result;
  for (const Json &row : rows)
    result.emplace(row.at(member), row);
  return result;
}

class Comparison {
public:
  std::vector<std::string> run(const Bundle &stored, const Bundle &now) {
    const std::string name(kBundleIndex);
    if (!stored.contains(name)) {
      say("`{}` is missing", name);
      return std::move(problems_);
    }
    try {
      const Json before = Json::parse(stored.at(name));
      const auto files = rowsBy(before.at("files"), "path");
      for (const auto &[path, file] : rowsBy(Json::parse(now.at(name)).at("files"), "path"))
        if (const auto known = files.find(path); known != files.end())
          compareFile(known->second, file);
        else
          say("`{}` is not in the bundle", path);
      if (problems_.empty())
        compareTexts(stored, now);
    } catch (const Json::exception &) {
      say("`{}` has been changed", name);
    }
    return std::move(problems_);
  }

private:
  void compareFile(const Json &before, const Json &now) {
    const auto newSources = rowsBy(now.at("sources"), "path");
    const auto oldSources = rowsBy(before.at("sources"), "path");
    for (const auto &[path, source] : oldSources)
      if (const auto known = newSources.find(path); known == newSources.end())
        say("`{}` was read for the proof but is missing now", path);
      else if (known->second.at("sha256") != source.at("sha256"))
        say("`{}` has changed since it was proved", path);
    for (const auto &[path, source] : newSources)
      if (!oldSources.contains(path))
        say("`{}` is new in the folder of the program", path);
    if (before.at("dialect") != now.at("dialect"))
      say("the dialect was {} and is now {}", std::string(before.at("dialect")), std::string(now.at("dialect")));
    compareObligations(rowsBy(before.at("obligations"), "id"), rowsBy(now.at("obligations"), "id"));
  }
  void compareObligations(const std::map<std::string, Json> &before, const std::map<std::string, Json> &now) {
    for (const auto &[id, row] : before)
      if (!now.contains(id))
        say("{}: this obligation no longer exists", id);
    for (const auto &[id, row] : now) {
      const auto known = before.find(id);
      if (known == before.end())
        say("{}: this obligation is missing from the bundle", id);
      else if (known->second.at("verdict") != row.at("verdict"))
        say("{}: the bundle says {}; it is now {}", id, std::string(known->second.at("verdict")),
            std::string(row.at("verdict")));
      else if (known->second != row)
        say("{}: the entry in the bundle differs from a new proof", id);
    }
  }
  void compareTexts(const Bundle &stored, const Bundle &now) {
    for (const auto &[name, text] : now)
      if (const auto known = stored.find(name); known == stored.end())
        say("`{}` is missing", name);
      else if (known->second != text)
        say("`{}` has been changed", name);
    for (const auto &[name, text] : stored)
      if (!now.contains(name))
        say("`{}` does not belong to the bundle", name);
  }

  template <typename... Arguments> void say(fmt::format_string<Arguments...> format, Arguments &&...arguments) {
    problems_.push_back(fmt::format(format, std::forward<Arguments>(arguments)...));
  }
  std::vector<std::string> problems_;
};

} // namespace

std::vector<std::string> differences(const Bundle &stored, const Bundle &now) { return Comparison().run(stored, now); }

} // namespace feedhold
