// Reads `feedhold.toml` with toml++.  Every key and value is checked against what exists, so that a slip of the
// pen is an error with its place and not a setting that silently does nothing.
#include "findings/project/config.h"

#include "base/support/text.h"
#include "language/dialect/switch_names.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <set>

namespace feedhold {

namespace {

std::string withSuggestion(const std::string &message, std::string_view word,
                           std::span<const std::string_view> candidates) {
  if (const auto nearest = nearestWord(word, candidates))
    return message + fmt::format("; did you mean `{}`?", *nearest);
  return message + fmt::format("; one of: {}", fmt::join(candidates, ", "));
}

/// Walks the tables of one file and collects what it reads and what is wrong with it.
class Reader {
public:
  Reader(const std::filesystem::path &folder, const KnownNames &known) : known_(known) {
    result_.config.folder = folder;
  }

  ConfigText read(std::string_view text) {
    try {
      const toml::table root = toml::parse(text);
      readRoot(root);
    } catch (const toml::parse_error &error) {
      addError(error.source(), fmt::format("not valid TOML: {}", error.description()));
    }
    std::stable_sort(result_.errors.begin(), result_.errors.end(), [](const ConfigError &a, const ConfigError &b) {
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    return std::move(result_);
  }

private:
  void readRoot(const toml::table &root) {
    static constexpr std::array<std::string_view, 15> kKeys = {"dialect",
                                                               "increment-system",
                                                               "g-code-system",
                                                               "select",
                                                               "ignore",
                                                               "min-severity",
                                                               "error-on",
                                                               "include",
                                                               "exclude",
                                                               "files",
                                                               "switches",
                                                               "code-calls",
                                                               "builders-variables",
                                                               "builders-codes",
                                                               "severity"};
    Config &config = result_.config;
    for (const auto &[key, node] : root) {
      if (key == "dialect")
        config.dialect = dialect(node);
      else if (key == "increment-system")
        config.incrementSystem = incrementSystem(node);
      else if (key == "g-code-system")
        config.gCodeSystem = gCodeSystem(node);
      else if (key == "select")
        config.select = ruleNames(node);
      else if (key == "ignore")
        config.ignore = ruleNames(node);
      else if (key == "error-on")
        config.errorOn = severity(node);
      else if (key == "min-severity")
        config.minSeverity = severity(node);
      else if (key == "include")
        config.include = strings(node);
      else if (key == "exclude")
        config.exclude = strings(node);
      else if (key == "files")
        config.files = tables<FilePattern>(node, [this](const toml::table &table) { return filePattern(table); });
      else if (key == "switches")
        config.switches = switches(node);
      else if (key == "code-calls")
        config.codeCalls = tables<CodeCall>(node, [this](const toml::table &table) { return codeCall(table); });
      else if (key == "builders-variables")
        config.buildersVariables = variables(node);
      else if (key == "builders-codes")
        config.buildersCodes = buildersCodes(node);
      else if (key == "severity")
        config.severities = severities(node);
      else
        unknownKey(key, kKeys);
    }
  }

  FilePattern filePattern(const toml::table &table) {
    static constexpr std::array<std::string_view, 7> kKeys = {"path",   "dialect", "increment-system", "g-code-system",
                                                              "select", "ignore",  "switches"};
    FilePattern pattern;
    for (const auto &[key, node] : table) {
      if (key == "path")
        pattern.path = string(node);
      else if (key == "dialect")
        pattern.dialect = dialect(node);
      else if (key == "increment-system")
        pattern.incrementSystem = incrementSystem(node);
      else if (key == "g-code-system")
        pattern.gCodeSystem = gCodeSystem(node);
      else if (key == "select")
        pattern.select = ruleNames(node);
      else if (key == "ignore")
        pattern.ignore = ruleNames(node);
      else if (key == "switches")
        pattern.switches = switches(node);
      else
        unknownKey(key, kKeys);
    }
    require(table, "path", "[[files]] needs a `path`: the pattern of the files it is for");
    return pattern;
  }

  CodeCall codeCall(const toml::table &table) {
    static constexpr std::array<std::string_view, 3> kKeys = {"code", "program", "macro"};
    CodeCall call{.address = 'G', .tenths = 0, .program = 0, .isMacro = true};
    for (const auto &[key, node] : table) {
      if (key == "code")
        readCode(node, call);
      else if (key == "program")
        call.program = programNumber(node);
      else if (key == "macro")
        call.isMacro = boolean(node);
      else
        unknownKey(key, kKeys);
    }
    require(table, "code", "[[code-calls]] needs a `code`: the G, M or T code that calls, such as \"G100\"");
    require(table, "program", "[[code-calls]] needs a `program`: the number of the program that is called");
    return call;
  }

  /// "G100", "G54.1", "M06"
  void readCode(const toml::node &node, CodeCall &call) {
    const std::optional<CodeName> name = codeNamed(string(node), "GMT");
    if (name) {
      call.address = name->address;
      call.tenths = name->tenths;
    } else {
      addError(node.source(), "`code` must be a G, M or T code, such as \"G100\" or \"M6\"");
    }
  }

  std::uint32_t programNumber(const toml::node &node) {
    constexpr std::int64_t kLast = 99999999; // eight digits: the largest program number of any control
    const std::optional<std::int64_t> value = node.value_exact<std::int64_t>();
    if (value && *value >= 1 && *value <= kLast)
      return static_cast<std::uint32_t>(*value);
    addError(node.source(), "`program` must be a program number, such as 9010");
    return 0;
  }

  /// Sorted, without overlap: one row for each number.
  std::vector<VariableRange> variables(const toml::node &node) {
    constexpr std::int64_t kLast = 99999;
    std::set<std::uint32_t> numbers;
    const toml::array *array = node.as_array();
    if (!array)
      addError(node.source(), "`builders-variables` must be a list of variable numbers, such as [3939, 8570]");
    for (std::size_t i = 0; array && i < array->size(); ++i) {
      const std::optional<std::int64_t> value = array->get(i)->value_exact<std::int64_t>();
      if (value && *value >= 1 && *value <= kLast)
        numbers.insert(static_cast<std::uint32_t>(*value));
      else
        addError(array->get(i)->source(), "a variable number is a whole number from 1 to 99999");
    }
    std::vector<VariableRange> rows;
    rows.reserve(numbers.size());
    for (const std::uint32_t number : numbers)
      rows.push_back(buildersVariable(number, number));
    return rows;
  }

  /// Sorted, each once.
  std::vector<CodeName> buildersCodes(const toml::node &node) {
    const toml::array *array = node.as_array();
    if (!array)
      addError(node.source(),
               "`builders-codes` must be a list of G and M codes in quotes, such as [\"G229\", \"M462\"]");
    std::set<CodeName> codes;
    for (std::size_t i = 0; array && i < array->size(); ++i) {
      const toml::node &element = *array->get(i);
      if (const std::optional<CodeName> code = codeNamed(element.value_exact<std::string>().value_or(""), "GM"))
        codes.insert(*code);
      else
        addError(element.source(), "a code of the machine builder is a G or M code in quotes, such as \"G68.2\"");
    }
    return {codes.begin(), codes.end()};
  }

  std::vector<SwitchSetting> switches(const toml::node &node) {
    std::vector<std::string_view> names;
    for (const SwitchName &entry : switchNames())
      names.push_back(entry.name);
    std::vector<SwitchSetting> settings;
    for (const auto &[key, value] : table(node)) {
      const auto found = std::find(names.begin(), names.end(), key.str());
      if (found == names.end())
        unknownKey(key, names);
      else
        settings.push_back({switchNames()[static_cast<std::size_t>(found - names.begin())].which, switchValue(value)});
    }
    return settings;
  }

  Switch switchValue(const toml::node &node) {
    if (const auto value = node.value_exact<bool>())
      return *value ? Switch::On : Switch::Off;
    if (node.value_exact<std::string>() == "unknown")
      return Switch::Unknown;
    addError(node.source(), "expected true, false or \"unknown\"");
    return Switch::Unknown;
  }

  std::vector<SeveritySetting> severities(const toml::node &node) {
    std::vector<SeveritySetting> settings;
    for (const auto &[key, value] : table(node)) {
      if (findRule(known_.rules, key.str()) == nullptr)
        addError(key.source(), *complaintAboutRuleName(key.str(), known_.rules));
      else if (const auto level = severity(value))
        settings.push_back({std::string(key.str()), *level});
    }
    return settings;
  }

  std::optional<Severity> severity(const toml::node &node) {
    static constexpr std::array<std::string_view, 3> kNames = {"info", "warning", "error"};
    const std::string name = string(node);
    const std::optional<Severity> found = severityFromName(name);
    if (!found && !name.empty())
      addError(node.source(), withSuggestion(fmt::format("`{}` is not a severity", name), name, kNames));
    return found;
  }

  std::optional<IncrementSystem> incrementSystem(const toml::node &node) {
    const std::string name = string(node);
    const auto found = incrementSystemNamed(name);
    if (!found && !name.empty())
      addError(node.source(), fmt::format("`{}` is not an increment system; one of: {}", name,
                                          fmt::join(incrementSystemNames(), ", ")));
    return found;
  }

  std::optional<GCodeSystem> gCodeSystem(const toml::node &node) {
    const std::string name = string(node);
    const auto found = gCodeSystemNamed(name);
    if (!found && !name.empty())
      addError(node.source(),
               fmt::format("`{}` is not a G code system; one of: {}", name, fmt::join(gCodeSystemNames(), ", ")));
    return found;
  }

  std::optional<std::string> dialect(const toml::node &node) {
    const std::string id = string(node);
    if (id.empty())
      return std::nullopt;
    if (const auto complaint = complaintAboutDialect(id, known_.dialects))
      addError(node.source(), *complaint);
    return id;
  }

  std::vector<std::string> ruleNames(const toml::node &node) {
    std::vector<std::string> names;
    forEachString(node, [&](const toml::node &element, std::string name) {
      if (const auto complaint = complaintAboutRuleName(name, known_.rules))
        addError(element.source(), *complaint);
      names.push_back(std::move(name));
    });
    return names;
  }

  std::vector<std::string> strings(const toml::node &node) {
    std::vector<std::string> values;
    forEachString(node, [&](const toml::node &, std::string value) { values.push_back(std::move(value)); });
    return values;
  }

  template <typename Visit> void forEachString(const toml::node &node, Visit visit) {
    const toml::array *array = node.as_array();
    if (array == nullptr) {
      addError(node.source(), "expected a list of strings: [\"..\", \"..\"]");
      return;
    }
    for (const toml::node &element : *array)
      if (std::string value = string(element); !value.empty())
        visit(element, std::move(value));
  }

  template <typename Row, typename Read> std::vector<Row> tables(const toml::node &node, Read read) {
    std::vector<Row> rows;
    const toml::array *array = node.as_array();
    if (array == nullptr || !array->is_array_of_tables()) {
      addError(node.source(), "expected a list of tables: write the header with two brackets, [[..]]");
      return rows;
    }
    for (const toml::node &element : *array)
      rows.push_back(read(*element.as_table()));
    return rows;
  }

  const toml::table &table(const toml::node &node) {
    static const toml::table kNone;
    if (const toml::table *found = node.as_table())
      return *found;
    addError(node.source(), "expected a table");
    return kNone;
  }

  /// A text that is not empty; otherwise an error and an empty one.
  std::string string(const toml::node &node) {
    std::string value = node.value_exact<std::string>().value_or("");
    if (value.empty())
      addError(node.source(), "expected a string in quotes");
    return value;
  }

  bool boolean(const toml::node &node) {
    const std::optional<bool> value = node.value_exact<bool>();
    if (!value)
      addError(node.source(), "expected true or false");
    return value.value_or(false);
  }

  void require(const toml::table &table, std::string_view key, std::string_view message) {
    if (!table.contains(key))
      addError(table.source(), std::string(message));
  }

  void unknownKey(const toml::key &key, std::span<const std::string_view> known) {
    addError(key.source(), withSuggestion(fmt::format("unknown setting `{}`", key.str()), key.str(), known));
  }

  void addError(const toml::source_region &where, std::string message) {
    result_.errors.push_back({where.begin.line, where.begin.column, std::move(message)});
  }

  const KnownNames &known_;
  ConfigText result_;
};

} // namespace

ConfigText readConfig(std::string_view text, const std::filesystem::path &folder, const KnownNames &known) {
  return Reader(folder, known).read(text);
}

std::string textOf(const Switches &switches) {
  std::string text;
  for (const SwitchName &entry : switchNames())
    text += fmt::format("{}={} ", entry.name, static_cast<int>(switches.*entry.which));
  for (const CodeCall &call : switches.codeCalls)
    text += fmt::format("{}{}={}{} ", call.address, call.tenths, call.isMacro ? "macro " : "", call.program);
  for (const VariableRange &range : switches.buildersVariables)
    text += fmt::format("builders-variables={}-{} ", range.first, range.last);
  for (const CodeName &code : switches.buildersCodes)
    text += fmt::format("builders-codes={} ", textOf(code));
  text += fmt::format("increment-system={} ", nameOf(switches.incrementSystem));
  if (switches.gCodeSystem != GCodeSystem::A) // most controls have but one
    text += fmt::format("g-code-system={} ", nameOf(switches.gCodeSystem));
  return text;
}

} // namespace feedhold
