// See the header.
#include "rules/motion/arc_ends.h"

#include "rules/flow/loop_view.h"
#include "rules/flow/straight_path.h"

#include <algorithm>
#include <cmath>

namespace feedhold::rules {
namespace {

bool isOfRole(const Code &code) {
  return code.role == CodeRole::Plain || code.role == CodeRole::Motion || code.role == CodeRole::Arc ||
         code.role == CodeRole::ProgramStop;
}

/// Words before the block of the code may name other points, or ended otherwise.
bool beginsAnew(const Code &code) {
  constexpr std::array kBegin = {CodeAction::Inch, CodeAction::Metric, CodeAction::WorkOffset, CodeAction::CycleOff,
                                 CodeAction::LengthOff};
  return isOfRole(code) && std::ranges::find(kBegin, code.action) != kBegin.end();
}

/// The code changes neither coordinates nor what a word of an axis means, but for the modes that are asked for.
bool isCalmCode(const Code &code) {
  constexpr std::array kCalm = {CodeAction::Rapid,
                                CodeAction::Linear,
                                CodeAction::ArcClockwise,
                                CodeAction::ArcCounterclockwise,
                                CodeAction::PlaneXY,
                                CodeAction::PlaneZX,
                                CodeAction::PlaneYZ,
                                CodeAction::Absolute,
                                CodeAction::Incremental,
                                CodeAction::ArcIncremental,
                                CodeAction::FeedInverse,
                                CodeAction::FeedPerMinute,
                                CodeAction::FeedPerRevolution,
                                CodeAction::CompensationOff,
                                CodeAction::CompensationLeft,
                                CodeAction::CompensationRight,
                                CodeAction::ConstantSurface,
                                CodeAction::ConstantSpeed,
                                CodeAction::SpindleClockwise,
                                CodeAction::SpindleCounterclockwise,
                                CodeAction::SpindleStop,
                                CodeAction::CoolantOn,
                                CodeAction::CoolantOff};
  return isOfRole(code) && (changesNothing(code.action) || std::ranges::find(kCalm, code.action) != kCalm.end());
}

class ArcEnds {
public:
  ArcEnds(const MotionView &view, const FlowFacts &facts, NodeId arc, const ArcBlock &block)
      : view_(view), facts_(facts), block_(block), dialect_(view.context().dialect),
        isTurning_(dialect_.machine == MachineKind::Turning),
        incrementsByLetter_(isTurning_ && !view.modes().groupOf(ModalKind::Distance)),
        path_(facts, arc, [this](NodeId node) { return keepsVariables(node); }) {}

  std::optional<ApartRadii> compare() {
    const Plane &plane = block_.plane;
    if (!isCalm(path_.node(0)) || hasOtherWords() || !(mayMove(0, plane.first) || mayMove(0, plane.second)))
      return std::nullopt;
    const auto a = distanceWord(plane.firstCentre);
    const auto b = distanceWord(plane.secondCentre);
    const auto x = chord(plane.first, 0);
    const auto y = chord(plane.second, 1);
    if (!a || !b || !x || !y)
      return std::nullopt;
    const Vector start{*a, *b};
    const Vector end{sum(*x, -1, *a), sum(*y, -1, *b)};
    const auto apartAlways = apart(start, end);
    return apartAlways ? apartAlways : shifted(start, {*x, *y});
  }

private:
  using Vector = std::array<LinearForm, 2>;

  // ---- which nodes are followed ----

  /// All that the node changes of the variables is what its text says.
  bool keepsVariables(NodeId id) const {
    const Instruction &instruction = view_.node(id).instruction;
    if (std::holds_alternative<ExecuteWords>(instruction)) {
      const auto words = view_.wordsOf(id);
      return std::ranges::all_of(words, [&](const Word *word) {
        return word->address() != 'G' || codeOf(*word, dialect_); // another G may be a call
      });
    }
    if (!std::holds_alternative<Assign>(instruction))
      return std::holds_alternative<Pass>(instruction) || std::holds_alternative<Test>(instruction) ||
             std::holds_alternative<BlockSkip>(instruction) || std::holds_alternative<CountDown>(instruction);
    return std::ranges::all_of(assignmentsOf(facts_, id), [&](const Assignment &assignment) {
      const auto target = variableOf(facts_, assignment.target);
      return target && (*target >= kFirstNamedVariable || isPlain(facts_.file, *target));
    });
  }
  /// The tool stays where it is, or goes where the words say.
  bool isCalm(NodeId id) const {
    if (!std::holds_alternative<ExecuteWords>(view_.node(id).instruction))
      return true;
    const auto words = view_.wordsOf(id);
    return std::ranges::all_of(words, [&](const Word *word) { return isCalm(*word); }) &&
           (!isTurning_ || isArc(words) || !hasCorner(words));
  }
  bool isCalm(const Word &word) const {
    if (word.has(Word::kComma) || word.address() < 'A' || word.address() > 'Z')
      return false;
    if (word.isCode()) {
      const Code *code = codeOf(word, dialect_);
      return code ? isCalmCode(*code) || beginsAnew(*code) : word.address() == 'M' && word.isNumber();
    }
    if (word.address() == 'U' || word.address() == 'V' || word.address() == 'W')
      return incrementsByLetter_ && word.address() != 'V';
    return word.address() != 'T' || !isTurning_; // T0101 takes another offset
  }
  bool beginsAnewAt(NodeId id) const {
    const auto words = view_.wordsOf(id);
    return std::ranges::any_of(words, [&](const Word *word) {
      const Code *code = word->isCode() ? codeOf(*word, dialect_) : nullptr;
      return code && beginsAnew(*code);
    });
  }
  bool isArc(const std::vector<const Word *> &words) const {
    return std::ranges::any_of(words, [&](const Word *word) {
      const Code *code = word->isCode() ? codeOf(*word, dialect_) : nullptr;
      return code && code->role == CodeRole::Arc;
    });
  }
  /// Words of a lathe for corners and angles beside a line.
  static bool hasCorner(const std::vector<const Word *> &words) {
    return std::ranges::any_of(words, [](const Word *word) {
      return std::string_view("RIKAC").find(word->address()) != std::string_view::npos;
    });
  }
  /// By R, or with turns or a pitch.
  bool hasOtherWords() const {
    return std::ranges::any_of(std::string_view("RPLQ"), [&](char letter) {
      return view_.mayHave(path_.node(0), letter) && find(0, letter).size() != 0;
    });
  }

  // ---- modes ----

  std::optional<CodeAction> codeIn(std::size_t at, ModalKind kind) const {
    const auto group = view_.modes().groupOf(kind);
    std::optional<CodeAction> action;
    for (const Word *word : view_.wordsOf(path_.node(at)))
      if (const Code *code = word->isCode() ? codeOf(*word, dialect_) : nullptr; code && code->group == group)
        action = code->action;
    return action;
  }
  std::optional<bool> isAbsolute(std::size_t at) const {
    if (at == 0 || incrementsByLetter_)
      return incrementsByLetter_ || block_.isAbsolute;
    for (std::size_t before = at; before < path_.size() && isCalm(path_.node(before)); ++before)
      if (const auto action = codeIn(before, ModalKind::Distance))
        return *action == CodeAction::Absolute;
    for (std::size_t behind = 1; behind < at; ++behind)
      if (codeIn(behind, ModalKind::Distance))
        return std::nullopt;
    return block_.wasAbsolute;
  }
  /// The code of the last movement is one of G00 to G03, which ended any cycle.
  bool movesFreely(std::size_t at) const {
    for (std::size_t before = at; before < path_.size() && isCalm(path_.node(before)); ++before)
      if (codeIn(before, ModalKind::Motion))
        return true;
    return false;
  }

  // ---- coordinates ----

  std::vector<const Word *> find(std::size_t at, char letter) const {
    std::vector<const Word *> found;
    if (view_.mayHave(path_.node(at), letter))
      for (const Word *word : view_.wordsOf(path_.node(at)))
        if (word->address() == letter)
          found.push_back(word);
    return found;
  }
  std::optional<char> incrementOf(Axis axis) const {
    for (const auto &[letter, its] : kTurningIncrements)
      if (incrementsByLetter_ && its == axis)
        return letter;
    return std::nullopt;
  }
  bool mayMove(std::size_t at, Axis axis) const {
    const auto letter = incrementOf(axis);
    return view_.mayHave(path_.node(at), letterOf(axis)) || (letter && view_.mayHave(path_.node(at), *letter));
  }
  std::optional<LinearForm> formOf(const Word &word, std::size_t at) {
    if (word.form() == WordForm::Expression)
      return path_.formOf(word.expression(), at);
    const bool isPlainNumber = word.has(Word::kPoint) || dialect_.switches.dpi == Switch::On;
    if (!word.isNumber() || !(isPlainNumber || word.number().isZero()))
      return std::nullopt;
    return LinearForm{word.number().toDouble()};
  }
  /// A word of the arc's block; none is 0.
  std::optional<LinearForm> distanceWord(char letter) {
    const auto words = find(0, letter);
    if (words.size() > 1)
      return std::nullopt;
    return words.empty() ? LinearForm{} : formOf(*words.front(), 0);
  }
  struct Step {
    bool isPlace; // else a distance
    LinearForm form;
  };
  /// What the words of a node do with an axis; nothing is a distance of 0.
  std::optional<Step> stepOf(Axis axis, std::size_t at) {
    const auto words = find(at, letterOf(axis));
    const auto letter = incrementOf(axis);
    const auto increments = letter ? find(at, *letter) : std::vector<const Word *>{};
    if (words.empty() && increments.empty())
      return Step{false, {}};
    const auto absolute = isAbsolute(at);
    if (words.size() + increments.size() > 1 || !absolute)
      return std::nullopt;
    const auto form = formOf(words.empty() ? *increments.front() : *words.front(), at);
    return form ? std::optional(Step{!words.empty() && *absolute, *form}) : std::nullopt;
  }
  /// From the start point to the end point, as radii are counted.
  std::optional<LinearForm> chord(Axis axis, std::size_t index) {
    const auto step = stepOf(axis, 0);
    if (!step)
      return std::nullopt;
    const double share = axis == Axis::X && isTurning_ ? .5 : 1;
    if (!step->isPlace)
      return sum({}, share, step->form);
    const auto start = startOf(axis, index);
    return start ? std::optional(sum({}, share, sum(step->form, -1, *start))) : std::nullopt;
  }
  std::optional<LinearForm> startOf(Axis axis, std::size_t index) {
    if (beginsAnewAt(path_.node(0)))
      return std::nullopt;
    if (block_.start[index])
      return LinearForm{*block_.start[index]};
    LinearForm moved;
    for (std::size_t at = 1; at < path_.size() && isCalm(path_.node(at)); ++at) {
      const auto step = !mayMove(at, axis) || movesFreely(at) ? stepOf(axis, at) : std::nullopt;
      if (!step)
        return std::nullopt;
      moved = sum(std::move(moved), 1, step->form);
      if (step->isPlace)
        return moved;
      if (beginsAnewAt(path_.node(at)))
        return std::nullopt;
    }
    return std::nullopt;
  }

  // ---- radii ----

  std::optional<ApartRadii> apart(const Vector &start, const Vector &end) const {
    const Interval first = lengthOf(start);
    const Interval second = lengthOf(end);
    const double distance = std::max(first.lo - second.hi, second.lo - first.hi);
    if (std::max(distance, distanceOfMultiples(start, end)) <= tolerance())
      return std::nullopt;
    const auto words = view_.wordsOf(path_.node(0));
    const bool depends = std::ranges::any_of(
        words, [](const Word *word) { return word->form() == WordForm::Expression && !word->isCode(); });
    return ApartRadii{first, second, depends};
  }
  /// `X[#102+.1] I[-#102]` from `X#102`: both points and the centre are on a line, and the end is the start moved by a
  /// number.  The end names the variable of the centre, so that a half circle of this width is not what is meant.
  std::optional<ApartRadii> shifted(const Vector &start, const Vector &between) {
    for (const std::size_t along : {0U, 1U}) {
      const std::size_t across = 1 - along;
      const bool isOnLine = start[across].isConstant() && start[across].constant == 0 && between[across].isConstant() &&
                            between[across].constant == 0;
      const double shift = std::abs(between[along].constant);
      if (!isOnLine || !between[along].isConstant() || shift <= tolerance() || start[along].isConstant())
        continue;
      const auto step = stepOf(along == 0 ? block_.plane.first : block_.plane.second, 0);
      const bool namesCentre = step && std::ranges::any_of(start[along].factors, [&](const auto &factor) {
                                 return step->form.factors.contains(factor.first);
                               });
      if (namesCentre)
        return ApartRadii{Interval::all(), Interval::all(), true, shift};
    }
    return std::nullopt;
  }
  Interval lengthOf(const Vector &vector) const {
    const auto square = [&](const LinearForm &form) {
      const Interval size = absolute(path_.rangeOf(form));
      return multiply(size, size);
    };
    return sqrt(add(square(vector[0]), square(vector[1]))).value_or(Interval::all());
  }
  /// All four are multiples of one number: the radii differ by a multiple of its size.
  double distanceOfMultiples(const Vector &start, const Vector &end) const {
    std::optional<UnknownNumber> number;
    std::array<double, 4> factors{};
    std::size_t next = 0;
    for (const LinearForm &form : {start[0], start[1], end[0], end[1]}) {
      double &factor = factors[next++];
      if (form.constant != 0 || form.factors.size() > 1)
        return 0;
      if (form.isConstant())
        continue;
      const auto &[its, share] = *form.factors.begin();
      if (number && *number != its)
        return 0;
      number = its;
      factor = share;
    }
    if (!number)
      return 0;
    const double smallest = absolute(path_.rangeOf({0, {{*number, 1}}})).lo;
    return smallest * std::abs(std::hypot(factors[0], factors[1]) - std::hypot(factors[2], factors[3]));
  }
  /// The control's, and what the rounding of the words to increments may add.
  double tolerance() const {
    constexpr double kInch = 25.4;
    constexpr double kRoundings = 4; // half an increment for each of the words, and along two axes
    const LeastIncrements increments = leastIncrementsOf(dialect_);
    const double rounding = block_.isInch ? increments.inch.toDouble() : increments.metric.toDouble();
    return dialect_.behaviour.arcTolerance / (block_.isInch ? kInch : 1) + kRoundings * rounding;
  }

  const MotionView &view_;
  const FlowFacts &facts_;
  const ArcBlock &block_;
  const Dialect &dialect_;
  bool isTurning_;
  bool incrementsByLetter_;
  StraightPath path_;
};

} // namespace

std::optional<ApartRadii> apartRadii(const MotionView &view, const FlowFacts &facts, NodeId arc,
                                     const ArcBlock &block) {
  return isTooLarge(facts) ? std::nullopt : ArcEnds(view, facts, arc, block).compare();
}

} // namespace feedhold::rules
