// See the header.
#include "findings/draft/entry_clauses.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace feedhold::draft {

namespace {

constexpr std::size_t kMostParts = 24; // of one promise

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
      : project_(project), facts_(facts), table_(table), notes_(argumentNotes(project, facts.program)) {}

  DraftClauses make() {
    for (const Default &value : table_.defaults)
      if (isOnlyDefault(value))
        asked_[value.variable].value = value;
    for (const Guard &guard : table_.guards)
      take(guard);
    for (const auto &[variable, asked] : asked_)
      writeEntry(variable, asked);
    for (const Guard *guard : conditions_)
      writeRequirement(*guard);
    return std::move(clauses_);
  }

private:
  // ---- what the guards ask ----

  bool isInput(std::uint32_t variable) const {
    const VariableRange *row = findVariable(*facts_.file.dialect, variable);
    return row && (row->kind == VariableKind::Local || row->kind == VariableKind::Common ||
                   row->kind == VariableKind::Retentive);
  }
  bool isOnlyDefault(const Default &value) const {
    return isInput(value.variable) && onlyAssignment(facts_, value.variable) != nullptr;
  }

  void take(const Guard &guard) {
    if (!takeWhole(guard) && !takeOfOne(guard))
      conditions_.push_back(&guard);
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
  std::string refusalOf(const std::vector<const Guard *> &guards) const {
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
  /// Where a variable has a default, the guard asks of a given one alone.
  Alternatives needsOf(const Guard &guard) const {
    Alternatives needs = guard.needs;
    for (const Comparison &each : guard.needs)
      for (const std::uint32_t variable : each.reads) {
        const auto known = asked_.find(variable);
        const Comparison vacant{
            fmt::format("#{}", variable), OperatorKind::Equal, "#0", variable, std::nullopt, true, {variable}};
        if (known != asked_.end() && known->second.value && std::ranges::find(needs, vacant) == needs.end())
          needs.insert(needs.begin(), vacant);
      }
    return needs;
  }
  /// What shows that other calls are refused: with this alarm, where no earlier guard raises another one.
  std::vector<std::string> shownBy(const std::vector<const Guard *> &guards) const {
    std::vector<std::string> promises;
    for (const Guard *guard : guards) {
      if (!guard->alarm)
        continue;
      std::vector<std::string> conditions;
      for (const Comparison &each : needsOf(*guard))
        conditions.push_back(fmt::format("[{}]", textOf(opposite(each))));
      for (const Guard &earlier : table_.guards) {
        if (&earlier == guard)
          break;
        if (earlier.alarm != guard->alarm)
          conditions.push_back(fmt::format("[{}]", textOf(needsOf(earlier))));
      }
      if (conditions.size() <= kMostParts)
        promises.push_back(fmt::format("@ALARM {} IF {}", *guard->alarm, fmt::join(conditions, " AND ")));
    }
    return promises;
  }

  /// A vacant variable passes all guards; 0 in their comparisons.
  bool mayBeVacant(const Asked &asked) const {
    if (!facts_.file.dialect->behaviour.variablesMayBeVacant || asked.isGiven)
      return false;
    return asked.value.has_value() || asked.mayMiss || asked.allowsZero;
  }

  std::string rangeOf(const Asked &asked) const {
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

  void writeEntry(std::uint32_t variable, const Asked &asked) {
    const bool isLocal = variable <= kLocalVariables;
    const auto note = notes_.find(variable);
    const ArgumentNote &told = note == notes_.end() ? kNoNote : note->second;
    std::string text = fmt::format("{} #{}", isLocal ? "@PARAM" : "@GLOBAL", variable);
    const std::string range = rangeOf(asked);
    const std::string unit = asked.isWhole ? "INT" : told.unit;
    text += told.name.empty() ? "" : " " + told.name;
    text += range.empty() && told.name.empty() && !unit.empty() ? " VALUE" : ""; // a unit would be taken for a name
    text += range + (unit.empty() ? "" : " " + unit);
    text += mayBeVacant(asked) ? " OPTIONAL" : "";
    clauses_.push_back({std::move(text), reasonOf(variable, asked),
                        asked.guards.empty() ? Ground::Notes : Ground::Guard, shownBy(asked.guards)});
  }
  std::string reasonOf(std::uint32_t variable, const Asked &asked) const {
    std::string reason;
    const auto add = [&](const std::string &part) { reason += (reason.empty() || part.empty() ? "" : "; ") + part; };
    if (variable <= kLocalVariables)
      if (const auto letter = letterOf(*facts_.file.dialect, variable))
        add(std::string(1, *letter));
    if (!asked.guards.empty())
      add(refusalOf(asked.guards));
    if (asked.value)
      add(fmt::format("{} if it is not {} (line {})", asked.value->value,
                      variable <= kLocalVariables ? "passed" : "set", lineOf(asked.value->block)));
    if (variable <= kLocalVariables)
      add(toldOf(passedIn(project_, facts_.program, variable)));
    return reason;
  }

  void writeRequirement(const Guard &guard) {
    clauses_.push_back({"@REQUIRE " + textOf(needsOf(guard)), refusalOf({&guard}), Ground::Guard, shownBy({&guard})});
  }

  inline static const ArgumentNote kNoNote{};

  const Project &project_;
  const FlowFacts &facts_;
  const GuardTable &table_;
  const ArgumentNotes notes_;
  std::map<std::uint32_t, Asked> asked_;
  std::vector<const Guard *> conditions_;
  DraftClauses clauses_;
};

} // namespace

DraftClauses entryClauses(const Project &project, const FlowFacts &facts, const GuardTable &table) {
  return EntryClauses(project, facts, table).make();
}

} // namespace feedhold::draft
