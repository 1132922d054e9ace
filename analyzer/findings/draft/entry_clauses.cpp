// See the header.
#include "findings/draft/entry_clauses.h"
#include "findings/draft/guard_promises.h"
#include "findings/draft/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace feedhold::draft {

namespace {

constexpr std::size_t kMostSettings = 12;

/// What the guards ask of one variable.
struct Asked {
  std::optional<Decimal> low = {}; // both ends belong to it
  std::optional<Decimal> high = {};
  std::vector<Decimal> values = {}; // one of these; empty: any
  std::vector<const Guard *> guards = {};
  bool isGiven = false;   // a guard says that it is not vacant
  bool mayMiss = false;   // a guard lets a vacant one pass
  bool isWhole = false;   // a guard says so
  bool allowsZero = true; // as a vacant one counts in comparisons
  std::optional<Default> value = {};
};

/// What conditions ask of one variable that no range can say: the ends do not belong to it.
struct Beyond {
  std::optional<Decimal> low = {};
  std::optional<Decimal> high = {};
  bool allowsZero = true; // as a vacant one counts
};

bool isVacant(const Comparison &comparison) {
  return comparison.isVacancy && comparison.relation == OperatorKind::Equal;
}

Decimal zero() { return {}; }

/// Of an end that belongs to the range.
bool holdsOf(const Comparison &comparison, const Decimal &value) {
  return comparison.relation == OperatorKind::GreaterOrEqual ? value >= *comparison.constant
                                                             : value <= *comparison.constant;
}

/// `FIX[#11] EQ #11`, `[#11-FIX[#11]] EQ 0`: the variable that is a whole number.
std::optional<std::uint32_t> wholeIn(const Comparison &comparison) {
  if (comparison.relation != OperatorKind::Equal || comparison.reads.empty())
    return std::nullopt;
  const std::uint32_t variable = comparison.reads.front();
  for (const std::string_view function : {"FIX", "FUP", "ROUND"}) {
    const std::string rounded = fmt::format("{}[#{}]", function, variable);
    const std::string itself = fmt::format("#{}", variable);
    const bool isZero = comparison.constant && comparison.constant->isZero();
    if ((comparison.left == itself && comparison.right == rounded) ||
        (isZero && (comparison.left == fmt::format("[{}-{}]", itself, rounded) ||
                    comparison.left == fmt::format("[{}-{}]", rounded, itself))))
      return variable;
  }
  return std::nullopt;
}

class EntryClauses {
public:
  EntryClauses(const Project &project, const FlowFacts &facts, const GuardTable &table)
      : project_(project), facts_(facts), table_(table), notes_(argumentNotes(project, facts.program)) {
    for (const Setting &setting : settingsOf(project, facts.program))
      settings_.emplace(setting.variable, setting);
  }

  DraftClauses make() {
    for (const Default &value : table_.defaults)
      asked_[value.variable].value = value;
    for (const Guard &guard : table_.guards)
      take(guard);
    nameBounded();
    for (const auto &[variable, asked] : asked_)
      writeEntry(variable, asked);
    for (const Guard *guard : conditions_)
      if (!isWithinRange(*guard))
        writeRequirement(*guard);
    writeSettings();
    return std::move(clauses_);
  }

private:
  // ---- what the guards ask ----

  bool isInput(std::uint32_t variable) const { return draft::isInput(*facts_.file.dialect, variable); }

  void take(const Guard &guard) {
    if (takeWhole(guard) || takeOfOne(guard))
      return;
    conditions_.push_back(&guard);
    noteBeyond(guard);
  }

  /// `#7 GT 0`: the end does not belong to the range, so that no range says it.
  void noteBeyond(const Guard &guard) {
    const Comparison &only = guard.needs.front();
    const bool isBelow = only.relation == OperatorKind::LessThan;
    if (guard.needs.size() != 1 || !only.variable || !only.constant || !isInput(*only.variable) ||
        (!isBelow && only.relation != OperatorKind::GreaterThan))
      return;
    Beyond &beyond = beyond_[*only.variable];
    (isBelow ? beyond.high : beyond.low) = only.constant;
    const bool allowsZero = isBelow ? zero() < *only.constant : zero() > *only.constant;
    beyond.allowsZero = beyond.allowsZero && (allowsZero || table_.defaultOf(*only.variable));
  }

  /// `#400 GT 0` beside `#400 1..`
  bool isWithinRange(const Guard &guard) const {
    const Comparison &only = guard.needs.front();
    const auto asked = only.variable ? asked_.find(*only.variable) : asked_.end();
    if (guard.needs.size() != 1 || !only.constant || asked == asked_.end())
      return false;
    return (only.relation == OperatorKind::GreaterThan && asked->second.low && *asked->second.low > *only.constant) ||
           (only.relation == OperatorKind::LessThan && asked->second.high && *asked->second.high < *only.constant);
  }

  /// A condition has no place for a name: `@PARAM #7 DEPTH` beside `@REQUIRE #7 GT 0`, which a vacant one fails.
  void nameBounded() {
    for (const auto &[variable, beyond] : beyond_)
      if (variable <= kLocalVariables && !beyond.allowsZero && notes_.contains(variable))
        asked_[variable].isGiven = true;
  }

  bool takeWhole(const Guard &guard) {
    Alternatives given = guard.needs;
    const bool mayMiss = std::erase_if(given, isVacant) != 0;
    const auto whole = given.size() == 1 ? wholeIn(given.front()) : std::nullopt;
    if (!whole || !isInput(*whole) || (mayMiss && guard.needs.front().variable != whole))
      return false;
    Asked &asked = asked_[*whole];
    asked.isWhole = true;
    asked.mayMiss = asked.mayMiss || mayMiss;
    asked.allowsZero = asked.allowsZero && mayMiss; // a vacant variable is not equal to 0
    asked.guards.push_back(&guard);
    return true;
  }

  /// All alternatives speak of one variable, and a range or a list says them.
  bool takeOfOne(const Guard &guard) {
    const auto variable = guard.needs.front().variable;
    if (!variable || !isInput(*variable) ||
        !std::ranges::all_of(guard.needs, [&](const Comparison &each) { return each.variable == variable; }))
      return false;
    Alternatives given = guard.needs;
    const bool mayMiss = std::erase_if(given, isVacant) != 0;
    const auto known = asked_.find(*variable);
    Asked next = known == asked_.end() ? Asked{} : known->second;
    next.mayMiss = next.mayMiss || mayMiss;
    if (!given.empty() && !narrow(next, given, mayMiss))
      return false;
    if (given.empty())
      return false; // it must be vacant
    next.guards.push_back(&guard);
    asked_[*variable] = std::move(next);
    return true;
  }
  static bool narrow(Asked &asked, const Alternatives &given, bool mayMiss) {
    const auto isEqual = [](const Comparison &each) {
      return each.relation == OperatorKind::Equal && each.constant.has_value();
    };
    if (std::ranges::all_of(given, isEqual)) {
      if (!asked.values.empty())
        return false;
      for (const Comparison &each : given)
        asked.values.push_back(*each.constant);
      asked.allowsZero = false; // 0 is not vacant
      return true;
    }
    const Comparison &only = given.front();
    if (given.size() > 1)
      return false;
    if (only.isVacancy) {
      asked.isGiven = true;
      return only.relation == OperatorKind::NotEqual;
    }
    return bound(asked, only, mayMiss);
  }
  static bool bound(Asked &asked, const Comparison &only, bool mayMiss) {
    if (!only.constant)
      return false;
    if (only.relation == OperatorKind::GreaterOrEqual)
      asked.low = asked.low ? std::max(*asked.low, *only.constant) : *only.constant;
    else if (only.relation == OperatorKind::LessOrEqual)
      asked.high = asked.high ? std::min(*asked.high, *only.constant) : *only.constant;
    else
      return false;
    asked.allowsZero = asked.allowsZero && (mayMiss || holdsOf(only, zero()));
    return true;
  }

  // ---- as clauses ----

  std::uint32_t lineOf(BlockId block) const {
    return facts_.file.source->lineOf(facts_.file.tree->blocks[block].begin);
  }
  std::string alarmTold(const std::vector<const Guard *> &guards) const {
    std::set<std::uint32_t> alarms;
    std::set<std::uint32_t> lines;
    for (const Guard *guard : guards) {
      if (guard->alarm)
        alarms.insert(*guard->alarm);
      lines.insert(lineOf(guard->test));
    }
    return fmt::format("otherwise {} (line{} {})",
                       alarms.empty() ? "an alarm" : fmt::format("alarm {}", fmt::join(alarms, " or ")),
                       lines.size() == 1 ? "" : "s", fmt::join(lines, ", "));
  }

  /// A vacant variable passes all guards; 0 in their comparisons.
  bool mayBeVacant(std::uint32_t variable, const Asked &asked) const {
    if (!facts_.file.dialect->behaviour.variablesMayBeVacant || asked.isGiven || !beyondOf(variable).allowsZero)
      return false;
    return asked.value.has_value() || asked.mayMiss || asked.allowsZero;
  }

  const Beyond &beyondOf(std::uint32_t variable) const {
    static const Beyond kNone;
    const auto found = beyond_.find(variable);
    return found == beyond_.end() ? kNone : found->second;
  }

  /// Without an end that a condition says more of.
  std::string rangeOf(std::uint32_t variable, Asked asked) const {
    const Beyond &beyond = beyondOf(variable);
    if (asked.low && beyond.low && *beyond.low >= *asked.low)
      asked.low.reset();
    if (asked.high && beyond.high && *beyond.high <= *asked.high)
      asked.high.reset();
    if (!asked.values.empty()) {
      std::vector<std::string> values;
      for (const Decimal &value : asked.values)
        values.push_back(value.toString());
      return fmt::format(" IN {}", fmt::join(values, ","));
    }
    if (!asked.low && !asked.high)
      return {};
    return fmt::format(" {}..{}", asked.low ? asked.low->toString() : "", asked.high ? asked.high->toString() : "");
  }

  const ArgumentNote &noteOf(std::uint32_t variable) const {
    const auto note = notes_.find(variable);
    return note == notes_.end() ? kNoNote : note->second;
  }
  /// `@PARAM #24 LENGTH 5..400 MM`
  std::string entryText(std::uint32_t variable, const std::string &range, const std::string &unit) const {
    const std::string &name = noteOf(variable).name;
    std::string text = fmt::format("{} #{}", variable <= kLocalVariables ? "@PARAM" : "@GLOBAL", variable);
    text += name.empty() ? "" : " " + name;
    text += range.empty() && name.empty() && !unit.empty() ? " VALUE" : ""; // a unit would be taken for a name
    return text + range + (unit.empty() ? "" : " " + unit);
  }

  void writeEntry(std::uint32_t variable, const Asked &asked) {
    const std::string range = rangeOf(variable, asked);
    const std::string unit = asked.isWhole ? "INT" : noteOf(variable).unit;
    const bool isOptional = mayBeVacant(variable, asked);
    const std::string text = entryText(variable, range, unit) + (isOptional ? " OPTIONAL" : "");
    // A condition that a vacant one fails says as much; an argument is named in any case.
    if (text == fmt::format("@GLOBAL #{}", variable) && excludesZero(text.substr(text.find('#'))))
      return;
    clauses_.push_back(
        {text, reasonOf(variable, asked), asked.guards.empty() && !asked.isGiven ? Ground::Notes : Ground::Guard});
  }

  /// No guard asks for anything of them.
  void writeSettings() {
    std::size_t count = 0;
    for (const auto &[variable, setting] : settings_) {
      const bool isAsked = asked_.contains(variable) || beyond_.contains(variable) ||
                           std::ranges::any_of(conditions_, [&, number = variable](const Guard *guard) {
                             return std::ranges::any_of(guard->needs, [&](const Comparison &each) {
                               return std::ranges::find(each.reads, number) != each.reads.end();
                             });
                           });
      if (isAsked || ++count > kMostSettings)
        continue;
      const std::string &unit = noteOf(variable).unit;
      clauses_.push_back({.text = entryText(variable, fmt::format(" IN {}", setting.value.toString()), unit),
                          .reason = fmt::format("{} sets it (line {})", setting.program, setting.line),
                          .ground = Ground::Hint,
                          .weaker = entryText(variable, {}, unit)});
    }
  }

  std::string reasonOf(std::uint32_t variable, const Asked &asked) const {
    std::string reason;
    const auto add = [&](const std::string &part) { reason += (reason.empty() || part.empty() ? "" : "; ") + part; };
    if (variable <= kLocalVariables)
      if (const auto letter = letterOf(*facts_.file.dialect, variable))
        add(std::string(1, *letter));
    if (!asked.guards.empty())
      add(alarmTold(asked.guards));
    if (asked.value)
      add(fmt::format("{} if it is not {} (line {})", asked.value->value,
                      variable <= kLocalVariables ? "passed" : "set", lineOf(asked.value->block)));
    if (variable <= kLocalVariables)
      add(toldOf(passedIn(project_, facts_.program, variable)));
    if (const auto setting = settings_.find(variable); setting != settings_.end())
      add(toldOf(setting->second));
    return reason;
  }

  /// Some guard compares it with a number, and a vacant one, which counts as 0, fails.
  bool excludesZero(const std::string &left) const {
    return std::ranges::any_of(table_.guards, [&](const Guard &guard) {
      const Comparison &only = guard.needs.front();
      if (guard.needs.size() != 1 || only.left != left || !only.constant)
        return false;
      const auto order = zero() <=> *only.constant;
      return (only.relation == OperatorKind::GreaterThan && order <= 0) ||
             (only.relation == OperatorKind::GreaterOrEqual && order < 0) ||
             (only.relation == OperatorKind::LessThan && order >= 0) ||
             (only.relation == OperatorKind::LessOrEqual && order > 0);
    });
  }

  void writeRequirement(const Guard &guard) {
    const Comparison &first = guard.needs.front();
    const bool isGiven = guard.needs.size() == 1 && first.isVacancy && first.relation == OperatorKind::NotEqual;
    if (!isGiven || !excludesZero(first.left))
      clauses_.push_back({"@REQUIRE " + textOf(needsOf(table_, guard)), alarmTold({&guard}), Ground::Guard});
  }

  inline static const ArgumentNote kNoNote{};

  const Project &project_;
  const FlowFacts &facts_;
  const GuardTable &table_;
  const ArgumentNotes notes_;
  std::map<std::uint32_t, Setting> settings_;
  std::map<std::uint32_t, Asked> asked_;
  std::map<std::uint32_t, Beyond> beyond_;
  std::vector<const Guard *> conditions_;
  DraftClauses clauses_;
};

} // namespace

DraftClauses entryClauses(const Project &project, const FlowFacts &facts, const GuardTable &table) {
  return EntryClauses(project, facts, table).make();
}

} // namespace feedhold::draft
