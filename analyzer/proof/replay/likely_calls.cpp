#include "proof/replay/likely_calls.h"

#include "meaning/cfg/program_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace feedhold::prove {

namespace {

constexpr unsigned kMissing = 40;    // an argument that the program needs
constexpr unsigned kNotGiven = 5;    // one that it reads, and may need
constexpr unsigned kRefused = 20;    // by a guard of the program
constexpr unsigned kOtherStart = 10; // each code, word and coordinate
constexpr unsigned kReading = 2;     // each input of the control, and each of its readings
constexpr unsigned kCommon = 3;      // a variable that no letter passes
constexpr unsigned kOfControl = 8;   // a system variable
constexpr std::size_t kMostCalls = 6;
constexpr std::size_t kMostChanged = 8; // arguments
constexpr std::size_t kMostGuards = 80;
constexpr int kIdleTries = 150; // for a call that guards let pass, before the search stops

/// What people choose.
constexpr std::array kRound = {1.0, 10.0, 5.0, 2.0, 0.5, 100.0, 0.1, 50.0, 20.0};

bool isRound(double value) { return std::ranges::find(kRound, std::fabs(value)) != kRound.end(); }

/// Without the zeros at both ends; of at most six places behind the point.
unsigned significantDigits(double size) {
  double rest = std::round(size * 1e6);
  while (rest >= 10 && std::fmod(rest, 10) == 0)
    rest /= 10;
  unsigned digits = 0;
  for (; rest >= 1; rest = std::floor(rest / 10))
    ++digits;
  return digits;
}

/// 0 for the plainest number; more for each digit, for a sign, and for large ones.
unsigned oddnessOf(double value) {
  const double size = std::fabs(value);
  const unsigned sign = value < 0 ? 1 : 0;
  if (value == 0)
    return 3; // arguments are seldom there to be 0
  if (isRound(value))
    return sign + (size == 1 ? 0 : 1);
  const unsigned fraction = size == std::floor(size) ? 0 : 1;
  return sign + fraction + 1 + significantDigits(size) + (size > 100'000 ? 6 : size > 1000 ? 3 : size > 100 ? 1 : 0);
}

/// What a condition compares: a number, vacancy, or nothing that is known.
using ValueOf = std::function<std::optional<ConcreteValue>(std::uint32_t)>;

std::optional<double> resultOf(OperatorKind operation, double a, double b) {
  if (operation == OperatorKind::Add)
    return a + b;
  if (operation == OperatorKind::Subtract)
    return a - b;
  if (operation == OperatorKind::Multiply)
    return a * b;
  return operation == OperatorKind::Divide && b != 0 ? std::optional(a / b) : std::nullopt;
}

std::optional<ConcreteValue> valueIn(const SyntaxTree &tree, ExpressionId expression, const ValueOf &valueOf) {
  if (const auto literal = literalValue(tree, expression))
    return ConcreteValue::of(literal->toDouble());
  const ExpressionId inside = unwrapped(tree, expression);
  if (const auto *operation = std::get_if<BinaryOperation>(&tree.expressions[inside].node)) {
    const auto left = valueIn(tree, operation->left, valueOf), right = valueIn(tree, operation->right, valueOf);
    const auto result =
        left && right ? resultOf(operation->op, left->vacant ? 0 : left->number, right->vacant ? 0 : right->number)
                      : std::nullopt;
    return result ? std::optional(ConcreteValue::of(*result)) : std::nullopt;
  }
  const auto variable = variableNumber(tree, unwrapped(tree, expression));
  if (!variable)
    return std::nullopt;
  return *variable == kVacantVariable ? std::optional(ConcreteValue()) : valueOf(*variable);
}

std::optional<bool> relationHolds(OperatorKind relation, const ConcreteValue &a, const ConcreteValue &b) {
  const bool isEqual = a.vacant == b.vacant && (a.vacant || a.number == b.number);
  const double left = a.vacant ? 0 : a.number, right = b.vacant ? 0 : b.number;
  switch (relation) {
  case OperatorKind::Equal: return isEqual;
  case OperatorKind::NotEqual: return !isEqual;
  case OperatorKind::GreaterThan: return left > right;
  case OperatorKind::GreaterOrEqual: return left >= right;
  case OperatorKind::LessThan: return left < right;
  case OperatorKind::LessOrEqual: return left <= right;
  case OperatorKind::Add:
  case OperatorKind::Subtract:
  case OperatorKind::Multiply:
  case OperatorKind::Divide:
  case OperatorKind::Modulo:
  case OperatorKind::Power:
  case OperatorKind::And:
  case OperatorKind::Or:
  case OperatorKind::Xor: return std::nullopt;
  }
  return std::nullopt;
}

/// Absent: it depends on more than these values.
std::optional<bool> holdsFor(const SyntaxTree &tree, ExpressionId condition, const ValueOf &valueOf) {
  const auto *operation = std::get_if<BinaryOperation>(&tree.expressions[unwrapped(tree, condition)].node);
  if (!operation)
    return std::nullopt;
  if (operation->op == OperatorKind::And || operation->op == OperatorKind::Or) {
    const bool decides = operation->op == OperatorKind::Or;
    const auto left = holdsFor(tree, operation->left, valueOf);
    const auto right = holdsFor(tree, operation->right, valueOf);
    if (left == decides || right == decides)
      return decides;
    return left && right ? std::optional(!decides) : std::nullopt;
  }
  const auto left = valueIn(tree, operation->left, valueOf);
  const auto right = valueIn(tree, operation->right, valueOf);
  return left && right ? relationHolds(operation->op, *left, *right) : std::nullopt;
}

/// `#9` of `#9 EQ #0`; absent: it asks something else.
std::optional<std::uint32_t> askedForVacancy(const SyntaxTree &tree, ExpressionId comparison) {
  const auto *operation = std::get_if<BinaryOperation>(&tree.expressions[comparison].node);
  if (!operation || (operation->op != OperatorKind::Equal && operation->op != OperatorKind::NotEqual))
    return std::nullopt;
  const auto left = variableNumber(tree, unwrapped(tree, operation->left));
  const auto right = variableNumber(tree, unwrapped(tree, operation->right));
  if (!left || !right || (*left == kVacantVariable) == (*right == kVacantVariable))
    return std::nullopt;
  return *left == kVacantVariable ? right : left;
}

ExpressionId conditionOf(const ProgramFile &file, NodeId test) {
  return *std::get<Test>(file.cfg.nodes[test].instruction).condition;
}

/// Those with a condition.
std::vector<NodeId> testsOf(const ProgramFile &file, ProgramId program) {
  std::vector<NodeId> tests;
  const std::size_t count = nodesOf(file, program);
  NodeId node = file.cfg.entryOf(program);
  for (std::size_t i = 0; i < count; ++i, node = node.next())
    if (const auto *test = std::get_if<Test>(&file.cfg.nodes[node].instruction); test && test->condition)
      tests.push_back(node);
  return tests;
}

/// It takes arguments of its own: M98 passes none.
bool passesArguments(CallKind kind) {
  switch (kind) {
  case CallKind::Macro:
  case CallKind::Modal:
  case CallKind::ModalEach:
  case CallKind::Code:
  case CallKind::OWord: return true;
  case CallKind::ModalCancel:
  case CallKind::MacroA:
  case CallKind::Subprogram:
  case CallKind::Local:
  case CallKind::External: return false;
  }
  return false;
}

/// What a call passes: no number where it is computed.
std::map<std::uint32_t, std::optional<double>> passedBy(const ProgramFile &file, const Call &call) {
  std::map<std::uint32_t, std::optional<double>> passed;
  for (const Argument &argument : call.arguments)
    if (argument.role == ArgumentRole::Passed && argument.variable != 0) {
      const Word &word = file.tree->words[argument.word];
      passed[argument.variable] = word.isNumber() ? std::optional(word.number().toDouble()) : std::nullopt;
    }
  for (std::size_t i = 0; i < call.values.size(); ++i) {
    const auto literal = literalValue(*file.tree, call.values[i]);
    passed[static_cast<std::uint32_t>(i + 1)] = literal ? std::optional(literal->toDouble()) : std::nullopt;
  }
  return passed;
}

} // namespace

LikelyCalls::LikelyCalls(const ProgramSet &programs, Callee program)
    : programs_(programs), program_(program), file_(programs.file(program.file)) {
  const std::vector<NodeId> tests = testsOf(file_, program_.program);
  std::set<ExpressionId> compared;
  for (const NodeId test : tests)
    for (const ExpressionId each : subexpressions(*file_.tree, conditionOf(file_, test)))
      compared.insert(each);
  readUses(compared);
  for (const NodeId test : tests)
    readTest(test);
  readCalls();
  readGuards();
  for (auto &[variable, input] : inputs_)
    if (input.preset)
      input.values.push_back(*input.preset);
}

/// A local variable that is read before it is written holds an argument, if anybody calls the program.  What is only
/// compared chooses between ways, and may be missing.
void LikelyCalls::readUses(const std::set<ExpressionId> &compared) {
  if (!file_.model->programs[program_.program].returns)
    return;
  std::map<std::uint32_t, std::pair<std::optional<BlockId>, std::optional<BlockId>>> first; // read, written
  for (const VariableUse &use : file_.model->variables) {
    if (!use.number || !mayBePassed(*use.number) || file_.model->programOf(use.block) != program_.program)
      continue;
    if (!use.write && compared.contains(use.expression))
      continue;
    auto &[read, written] = first[*use.number];
    std::optional<BlockId> &at = use.write ? written : read;
    at = at ? std::min(*at, use.block) : use.block;
  }
  for (const auto &[variable, blocks] : first)
    if (blocks.first && (!blocks.second || *blocks.first <= *blocks.second))
      inputs_[variable].need = Need::Read;
}

bool LikelyCalls::mayBePassed(std::uint32_t variable) const {
  return variable != kVacantVariable &&
         std::ranges::find(file_.dialect->argumentVariables, variable) != file_.dialect->argumentVariables.end();
}

/// As a number that the control keeps: an argument, or a common variable.
bool LikelyCalls::mayBeGiven(std::uint32_t variable) const {
  const VariableRange *range = findVariable(*file_.dialect, variable);
  return variable != kVacantVariable && range != nullptr && range->role == VariableRole::Plain;
}

/// What the program tests for vacancy may be missing.
void LikelyCalls::readTest(NodeId test) {
  for (const ExpressionId each : subexpressions(*file_.tree, conditionOf(file_, test)))
    if (const auto variable = askedForVacancy(*file_.tree, each)) {
      inputs_[*variable].need = Need::None;
      readDefault(test, *variable);
    }
}

/// `IF[#9EQ#0]THEN#9=100`
void LikelyCalls::readDefault(NodeId node, std::uint32_t variable) {
  const auto &test = std::get<Test>(file_.cfg.nodes[node].instruction);
  const auto isVacant = holdsFor(*file_.tree, conditionOf(file_, node), [&](std::uint32_t each) {
    return each == variable ? std::optional(ConcreteValue()) : std::nullopt;
  });
  if (!isVacant)
    return;
  const Node &side = file_.cfg.nodes[*isVacant ? test.taken : file_.cfg.nodes[node].next];
  const auto *assign = std::get_if<Assign>(&side.instruction);
  const auto *assignment = assign ? std::get_if<Assignment>(&file_.tree->statements[assign->first].node) : nullptr;
  const auto value = assignment && variableNumber(*file_.tree, assignment->target) == variable
                         ? literalValue(*file_.tree, assignment->value)
                         : std::nullopt;
  if (value)
    inputs_[variable].preset = value->toDouble();
}

void LikelyCalls::readCalls() {
  std::size_t calls = 0;
  bool isCalledOtherwise = false;
  std::map<std::uint32_t, std::size_t> passing;
  std::map<std::uint32_t, std::map<double, std::size_t>> times;
  for (const CallGraph::Caller &caller : programs_.callGraph().callers({program_.file, program_.program})) {
    const ProgramFile &from = programs_.file(caller.file);
    const Call &call = from.model->calls[caller.call];
    isCalledOtherwise = isCalledOtherwise || !passesArguments(call.kind);
    if (!passesArguments(call.kind))
      continue;
    ++calls;
    GivenVariables given;
    bool isWritten = true;
    for (const auto &[variable, value] : passedBy(from, call)) {
      ++passing[variable];
      isWritten = isWritten && value;
      if (value) {
        ++times[variable][*value];
        given.set(variable, ConcreteValue::of(*value));
      }
    }
    if (isWritten && ofFolder_.size() < kMostCalls && std::ranges::find(ofFolder_, given) == ofFolder_.end())
      ofFolder_.push_back(std::move(given));
  }
  if (calls == 0 && !isCalledOtherwise)
    return;
  for (auto &[variable, input] : inputs_)
    if (!passing.contains(variable))
      input.need = Need::None;
  for (const auto &[variable, count] : passing) {
    Input &input = inputs_[variable];
    input.need = count == calls ? Need::Passed : Need::None;
    std::vector<std::pair<double, std::size_t>> values(times[variable].begin(), times[variable].end());
    std::ranges::stable_sort(values, std::greater(), [](const auto &each) { return each.second; });
    for (std::size_t i = values.size(); i-- > 0;)
      input.values.insert(input.values.begin(), values[i].first);
  }
}

void LikelyCalls::readGuards() {
  const SyntaxTree &tree = *file_.tree;
  std::set<double> numbers;
  for (const GuardTest &guard : guardTestsOf(file_, program_.program)) {
    if (guards_.size() == kMostGuards)
      break;
    const ExpressionId condition = conditionOf(file_, guard.test);
    guards_.push_back({condition, guard.refuses});
    for (const ExpressionId each : subexpressions(tree, condition)) {
      if (const auto literal = literalValue(tree, each))
        numbers.insert(literal->toDouble());
      const auto variable = variableNumber(tree, each).value_or(kVacantVariable);
      if (mayBePassed(variable) && isRefusedAlone(variable, {}))
        inputs_[variable].need = Need::Asked;
    }
  }
  guardNumbers_.assign(numbers.begin(), numbers.end());
}

ConcreteValue LikelyCalls::whereMissing(std::uint32_t variable) const {
  const auto known = inputs_.find(variable);
  return known != inputs_.end() && known->second.preset ? ConcreteValue::of(*known->second.preset) : ConcreteValue();
}

std::vector<ExpressionId> LikelyCalls::refusing(const GivenVariables &given) const {
  const ValueOf valueOf = [&](std::uint32_t variable) -> std::optional<ConcreteValue> {
    const ConcreteValue *held = given.find(variable);
    return held && !held->vacant ? *held : whereMissing(variable);
  };
  std::vector<ExpressionId> conditions;
  for (const Guard &guard : guards_)
    if (holdsFor(*file_.tree, guard.condition, valueOf) == guard.refuses)
      conditions.push_back(guard.condition);
  return conditions;
}

/// A walk that never adds to the guards that refuse (Selman, Levesque and Mitchell, "A new method for solving hard
/// satisfiability problems", 1992): one of their variables is moved to what the condition compares it with, or near it.
GivenVariables LikelyCalls::accepted(std::mt19937 &random) const {
  const SyntaxTree &tree = *file_.tree;
  GivenVariables given = completed(ofFolder_.empty() ? GivenVariables() : ofFolder_.front());
  std::vector<ExpressionId> open = refusing(given);
  const auto anyOf = [&](const auto &values) { return values[random() % values.size()]; };
  for (int idle = 0; idle < kIdleTries && !open.empty(); ++idle) {
    std::vector<std::uint32_t> variables;
    std::vector<double> numbers(kRound.begin(), kRound.end());
    for (const ExpressionId each : subexpressions(tree, anyOf(open))) {
      if (const auto literal = literalValue(tree, each))
        numbers.insert(numbers.end(), 4, literal->toDouble());
      if (const auto variable = variableNumber(tree, each); variable && mayBeGiven(*variable)) {
        variables.push_back(*variable);
        if (const ConcreteValue *held = given.find(*variable))
          numbers.insert(numbers.end(), 4, held->number);
      }
    }
    if (variables.empty())
      continue;
    constexpr std::array kFactors = {1.0, 1.0, 0.5, 2.0, 4.0, 0.25};
    constexpr std::array kAdded = {0.0, 0.0, 1.0, -1.0, 0.1, 10.0};
    GivenVariables other = given;
    other.set(anyOf(variables), ConcreteValue::of(anyOf(numbers) * anyOf(kFactors) + anyOf(kAdded)));
    std::vector<ExpressionId> left = refusing(other);
    if (left.size() > open.size())
      continue;
    if (left.size() < open.size())
      idle = 0;
    given = std::move(other);
    open = std::move(left);
  }
  return given;
}

bool LikelyCalls::isRefusedAlone(std::uint32_t variable, const ConcreteValue &value) const {
  const ConcreteValue held = value.vacant ? whereMissing(variable) : value;
  const ValueOf valueOf = [&](std::uint32_t each) { return each == variable ? std::optional(held) : std::nullopt; };
  return std::ranges::any_of(
      guards_, [&](const Guard &guard) { return holdsFor(*file_.tree, guard.condition, valueOf) == guard.refuses; });
}

double LikelyCalls::likeliest(std::uint32_t variable) const {
  if (const auto known = inputs_.find(variable); known != inputs_.end() && !known->second.values.empty())
    return known->second.values.front();
  std::vector<double> numbers(kRound.begin(), kRound.end());
  for (const double number : guardNumbers_)
    numbers.insert(numbers.end(), {number, number + 1, number - 1});
  numbers.insert(numbers.end(), {0, -1, -10});
  const auto passes = [&](double value) { return !isRefusedAlone(variable, ConcreteValue::of(value)); };
  const auto found = std::ranges::find_if(numbers, passes);
  return found == numbers.end() ? kRound.front() : *found;
}

std::vector<double> LikelyCalls::valuesOf(std::uint32_t variable) const {
  constexpr std::size_t kMostValues = 3;
  const auto known = inputs_.find(variable);
  if (known == inputs_.end() || (known->second.need == Need::None && known->second.values.empty()))
    return {};
  std::vector<double> values = known->second.values;
  values.resize(std::min(values.size(), kMostValues));
  if (values.empty())
    values.push_back(likeliest(variable));
  return values;
}

unsigned LikelyCalls::distanceOf(std::uint32_t variable, double value) const {
  const auto known = inputs_.find(variable);
  const bool isNeeded = known != inputs_.end() && known->second.need != Need::None;
  const unsigned more = isNeeded ? 0 : 2;
  if (known != inputs_.end() && std::ranges::find(known->second.values, value) != known->second.values.end())
    return more;
  const unsigned place = mayBePassed(variable)                                                 ? 0
                         : findVariable(*file_.dialect, variable) == nullptr                   ? kOfControl
                         : findVariable(*file_.dialect, variable)->role == VariableRole::Plain ? kCommon
                                                                                               : kOfControl;
  return more + place + 1 + oddnessOf(value);
}

unsigned LikelyCalls::distanceOf(const GivenVariables &given) const {
  unsigned distance = refusing(given).empty() ? 0 : kRefused;
  for (const auto &[variable, input] : inputs_) {
    const ConcreteValue *held = given.find(variable);
    if (input.need != Need::None && (!held || held->vacant))
      distance += input.need == Need::Read ? kNotGiven : kMissing;
  }
  for (const auto &[variable, value] : given.entries())
    distance += value.vacant ? 0 : distanceOf(variable, value.number);
  for (const auto &[variable, script] : given.readings.entries())
    distance += kReading * static_cast<unsigned>(1 + script.size());
  const GivenStart &start = given.start;
  return distance + kOtherStart * static_cast<unsigned>(start.codes.size() + start.words.size() + start.place.size() +
                                                        start.settings.size());
}

GivenVariables LikelyCalls::completed(GivenVariables given) const {
  for (const auto &[variable, input] : inputs_)
    if (const ConcreteValue *held = given.find(variable); input.need != Need::None && (!held || held->vacant))
      given.set(variable, ConcreteValue::of(likeliest(variable)));
  return given;
}

std::vector<GivenVariables> LikelyCalls::calls() const {
  std::vector<GivenVariables> calls = ofFolder_;
  const GivenVariables likely = completed(ofFolder_.empty() ? GivenVariables() : ofFolder_.front());
  if (likely.entries().empty())
    return calls;
  calls.push_back(likely);
  std::size_t changed = 0;
  for (const auto &[variable, value] : likely.entries()) {
    if (++changed > kMostChanged)
      break;
    calls.push_back(likely);
    calls.back().erase(variable);
    for (const double other : {0.0, 0.0 - value.number}) {
      calls.push_back(likely);
      calls.back().set(variable, ConcreteValue::of(other));
    }
  }
  return calls;
}

} // namespace feedhold::prove
