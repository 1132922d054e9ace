// Contour cycles: G70 to G73 of lathes (G72 to G75 in G code system C).
//
//   G71 U(d) R(e) ; G71 P(ns) Q(nf) U(u) W(w) F_      FANUC, two blocks; d and e in radius, u in diameter
//   G71 P(ns) Q(nf) U(u) W(w) D(d) F_                 one block: Haas, older FANUC
//   G70 P(ns) Q(nf)
//   G73 U(i) W(k) R(n) ; G73 P(ns) Q(nf) U(u) W(w) F_  FANUC; i in radius
//   G73 P(ns) Q(nf) U(u) W(w) I(i) K(k) D(n) F_        Haas
//
// G70 executes the blocks ns to nf once, and goes back to where it started at rapid.
//
// G71 reads them: from the start A to A', a move of X alone (type I), and from there the contour to B.  It goes from A
// to C = A + (u, w), down by d at a time, along Z to the contour + (u, w), e away from it at 45 degrees, and back to
// the Z of C at rapid; at last along the contour + (u, w), and back to A at rapid.  G72 the same with both axes
// exchanged, and W(d) R(e) in its first block.  G73 follows the contour + (u, w) n times, first shifted by (i, k) and
// the last time where it is; before each pass it goes to A + (u, w), shifted as the pass is, at rapid.  Behind the
// cycle the program goes on after nf.  Source: FANUC lathe operator's manual, "multiple repetitive cycle", G70 to G72;
// Haas lathe operator's manual, G70 to G73.
//
// A run draws this where the contour rises from A' to B along both axes.  All else takes boxes: one corner is A or C,
// whichever is further away from the contour along each axis, and e beyond it; each piece of the contour + (u, w) spans
// a box with this corner.  A cut that begins between A or C and the contour lies in the box of the piece at which it
// ends, whatever d is, and so does the way back from there by e.  A control keeps e from the last first block of any
// program, so that without one above it the cycle is not followed.  Of one block a setting says e (Setting 73 of Haas):
// it is taken to be no more than d.  The box of a piece of G73 holds the piece at each shift.  Not followed: type II,
// and contours with anything but straight lines, arcs and F.  Of one with G40 to G42 it is known that the cycle ends
// where it starts, and which modes the contour may leave.
#pragma once

#include "language/model/block_facts.h"
#include "language/model/contours.h"
#include "meaning/semantics/roughing.h"
#include "meaning/semantics/turning_strokes.h"

#include <cmath>
#include <utility>
#include <vector>

namespace feedhold::detail {

template <ValueAlgebra R> class ContourCycle {
public:
  using Value = typename R::Value;
  using Point = std::array<Value, kAxisCount>;
  using Moves = std::vector<Move<Value>>;

  ContourCycle(StepContext<R> &context, const ExecutedWords<R> &words, CodeAction action)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words),
        strokes_(context, words), action_(action) {}

  /// False: not followed.
  bool run() {
    if (action_ != CodeAction::FinishContour && !words_.find('P') && !words_.find('Q'))
      return action_ == CodeAction::RepeatContour ? learnShift() : learnDepth();
    const auto contour = contourOfBlock();
    const auto group = context_.modes.groupOf(ModalKind::Motion);
    if (!contour || !group || !isReadable(*contour, ContourCodes::OfPath)) {
      if (contour && group && isReadable(*contour, ContourCodes::OfCompensation))
        mayTakeModes(*contour, *group);
      else if (!contour || action_ == CodeAction::FinishContour)
        forgetAll();
      return false;
    }
    if (action_ == CodeAction::FinishContour)
      return finish(*contour, *group);
    const bool isFollowed = action_ == CodeAction::RepeatContour ? repeat(*contour) : rough(*contour);
    mayTakeModes(*contour, *group);
    return isFollowed;
  }

private:
  bool learnDepth() {
    endCycle(context_);
    const bool isTurning = action_ == CodeAction::TurnContour;
    const auto *back = words_.find('R');
    if (!context_.dialect().hasFanucParameters || !strokes_.hasOnly(isTurning ? "NGUR" : "NGWR") ||
        (back && strokes_.isNegative(back->value)))
      return false;
    strokes_.learn(action_, strokes_.length(isTurning ? 'U' : 'W'), strokes_.length('R'));
    return true;
  }
  bool learnShift() {
    endCycle(context_);
    if (!context_.dialect().hasFanucParameters || !strokes_.hasOnly("NGUWR"))
      return false;
    strokes_.learn(action_, strokes_.length('U'), strokes_.length('W'));
    if (words_.find('U') || words_.find('W'))
      state_.cycle.peck = count('R').value_or(interpretation_.vacant());
    return true;
  }
  /// The control executes a contour that is not read here, or one that is not known: codes, offsets, calls.
  void forgetAll() {
    if constexpr (!requires { R::kGoesOnBehindMistakes; })
      interpretation_.havoc(state_, "a contour with more than a path", context_.place());
  }

  // ---- the contour ----

  /// A number that stands in several blocks leads a control to the first or to the next of them.
  std::optional<ContourBlocks> contourOfBlock() const {
    const ProgramModel &model = *context_.file.model;
    const bool isKnown = drawsStrokes(context_) || isContourUnambiguous(model, context_.block);
    return isKnown ? contourAt(model, context_.block) : std::nullopt;
  }

  bool isReadable(const ContourBlocks &contour, ContourCodes codes) const {
    const SyntaxTree &tree = context_.tree();
    if (contour.first <= context_.block && context_.block <= contour.last)
      return false;
    if (!isPlainContour(tree, *context_.file.model, context_.dialect(), contour, codes))
      return false;
    for (BlockId block = contour.first; block <= contour.last; block = block.next())
      if (!incrementsByLetter(context_) && (findWord(tree, block, 'U') || findWord(tree, block, 'W')))
        return false;
    return true;
  }
  void execute(const ContourBlocks &contour) {
    for (BlockId block = contour.first; block <= contour.last; block = block.next()) {
      StepContext<R> inner{interpretation_, state_, context_.programs, context_.file, context_.modes, block};
      ExecutedWords<R> words;
      readWords(inner, ExecuteWords{WordChoice::Always}, words);
      applyModes(inner, words);
      applyMotion(inner, words);
    }
  }
  /// Whether the code of motion and F of a contour that has only been read are in force behind the cycle, no manual
  /// says.
  void mayTakeModes(const ContourBlocks &contour, std::uint8_t group) {
    const Code *compensation = nullptr; // the last
    for (BlockId block = contour.first; block <= contour.last; block = block.next())
      for (const Word &word : context_.tree().wordsOf(block)) {
        const Code *code = word.isCode() ? codeOf(word, context_.dialect()) : nullptr;
        if (code && code->group == group)
          mayTake(*code);
        else if (code)
          compensation = code;
        if (word.address() == 'F')
          state_.word('F') = interpretation_.either(state_.word('F'), interpretation_.anyNumber());
      }
    if (compensation)
      mayTake(*compensation);
  }
  void mayTake(const Code &code) {
    if (const auto index = context_.modes.indexOf(code)) {
      auto &now = state_.codes[code.group];
      now = interpretation_.selectCode(context_.maybeNot(), interpretation_.code(*index), now);
    }
  }

  // ---- finishing ----

  bool finish(const ContourBlocks &contour, std::uint8_t group) {
    if (!strokes_.hasOnly("NGPQFSTM") || strokes_.namesAxes()) {
      forgetAll();
      return false;
    }
    if constexpr (!kHasMoves) { // it also executes the contour where it stands
      mayTakeModes(contour, group);
      strokes_.cutInBox(state_.position, state_.position);
      return true;
    }
    const Point start = state_.position;
    const auto code = state_.codes[group];
    const Value feed = state_.word('F');
    execute(contour);
    strokes_.go(MoveKind::Rapid, start[indexOf(Axis::X)], start[indexOf(Axis::Z)]);
    state_.codes[group] = interpretation_.selectCode(context_.maybeNot(), code, state_.codes[group]);
    state_.word('F') = interpretation_.select(context_.maybeNot(), feed, state_.word('F'));
    return true;
  }

  // ---- the contour several times ----

  struct Shift {
    Value x; // in diameter
    Value z;
    std::optional<Value> passes;
  };

  bool repeat(const ContourBlocks &contour) {
    const std::optional<Shift> shift = strokes_.hasOnly("NGPQUWIKDFSTM") ? shiftOfFirstPass() : std::nullopt;
    if (!shift)
      return false;
    readAllowances();
    if constexpr (!kHasMoves) {
      strokes_.cutInBox(state_.position, state_.position);
      return true;
    } else {
      const Moves moves = movesOf(contour);
      return areKnown(moves) && (drawsStrokes(context_) ? drawPasses(moves, *shift) : repeatInBoxes(moves, *shift));
    }
  }
  /// A number that is no length: as it is written.
  std::optional<Value> count(char letter) const {
    for (const Word &word : context_.tree().wordsOf(context_.block))
      if (word.address() == letter && word.isNumber())
        return interpretation_.literal(word.number());
    return strokes_.length(letter);
  }
  /// Absent: FANUC keeps what an earlier program has said.
  std::optional<Shift> shiftOfFirstPass() const {
    const bool isOneBlock = words_.find('I') || words_.find('K') || words_.find('D');
    if (isOneBlock && !context_.behaviour().oneBlockCycles)
      return std::nullopt;
    const auto x = isOneBlock ? strokes_.length('I') : strokes_.learned(state_.cycle.initial);
    const auto z = isOneBlock ? strokes_.length('K') : strokes_.learned(state_.cycle.dwell);
    const auto passes = isOneBlock ? count('D') : strokes_.learned(state_.cycle.peck);
    return x && z ? std::optional(Shift{strokes_.twice(*x), *z, passes}) : std::nullopt;
  }
  void readAllowances() {
    x_ = strokes_.length('U').value_or(context_.zero());
    z_ = strokes_.length('W').value_or(context_.zero());
  }
  bool repeatInBoxes(const Moves &moves, const Shift &shift) {
    for (const Move<Value> &move : moves)
      if (isArc(move.kind) && !isQuarter(move))
        return false;
    const Point start = state_.position;
    cutInShiftedBox(start, allowed(start), shift);
    for (const Move<Value> &move : moves)
      cutInShiftedBox(allowed(move.start), allowed(move.end), shift);
    cutInShiftedBox(allowed(moves.back().end), allowed(start), shift);
    strokes_.cutInBox(start, allowed(moves.back().end));
    return true;
  }
  /// The box of both points, and of where they are shifted by all of the way or a part of it.
  void cutInShiftedBox(const Point &a, const Point &b, const Shift &shift) {
    const auto ends = [&](Axis axis, const Value &way) {
      const Value &p = a[indexOf(axis)], &q = b[indexOf(axis)];
      const auto isRising = interpretation_.compare(Relation::Less, p, q);
      const auto isBack = interpretation_.compare(Relation::Less, way, context_.zero());
      const Value low = interpretation_.select(isRising, p, q), high = interpretation_.select(isRising, q, p);
      return std::pair{interpretation_.select(isBack, interpretation_.add(low, way), low),
                       interpretation_.select(isBack, high, interpretation_.add(high, way))};
    };
    const auto x = ends(Axis::X, shift.x), z = ends(Axis::Z, shift.z);
    strokes_.cutInBox(strokes_.at(x.first, z.first), strokes_.at(x.second, z.second));
  }
  bool drawPasses(const Moves &moves, const Shift &shift) {
    constexpr double kMostPasses = 9999;
    const auto passes = strokes_.constant(shift.passes);
    if (!passes || *passes < 2 || *passes > kMostPasses || *passes != std::floor(*passes))
      return false; // what one pass does, no manual says
    const Point start = state_.position;
    const Value x = x_, z = z_;
    for (double left = *passes - 1; left >= 0; --left) {
      const Value share = interpretation_.number(left / (*passes - 1));
      x_ = interpretation_.add(x, interpretation_.multiply(shift.x, share));
      z_ = interpretation_.add(z, interpretation_.multiply(shift.z, share));
      const Point from = allowed(start);
      strokes_.go(MoveKind::Rapid, from[indexOf(Axis::X)], from[indexOf(Axis::Z)]);
      for (const Move<Value> &move : moves)
        tellAllowed(move);
    }
    strokes_.go(MoveKind::Rapid, start[indexOf(Axis::X)], start[indexOf(Axis::Z)]);
    return true;
  }

  // ---- roughing ----

  bool rough(const ContourBlocks &contour) {
    if (!readRoughing(contour))
      return false;
    if constexpr (!kHasMoves) {
      strokes_.cutInBox(state_.position, state_.position);
      return true;
    } else {
      const Moves moves = movesOf(contour);
      return areKnown(moves) && (drawsStrokes(context_) ? draw(moves) : cutInBoxes(moves));
    }
  }
  /// Those of the contour, without the tool going there.
  Moves movesOf(const ContourBlocks &contour) {
    const auto before = state_;
    const Moves told = interpretation_.takeMoves();
    execute(contour);
    Moves moves = interpretation_.takeMoves();
    state_ = before;
    for (const Move<Value> &move : told)
      interpretation_.move(move);
    return moves;
  }
  static bool areKnown(const Moves &moves) {
    return moves.size() > 1 && !isArc(moves.front().kind) && std::ranges::all_of(moves, [](const Move<Value> &move) {
             return move.kind == MoveKind::Rapid || move.kind == MoveKind::Feed ||
                    (isArc(move.kind) && move.plane.first == Axis::Z && move.turns == 1);
           });
  }
  bool readRoughing(const ContourBlocks &contour) {
    if (!strokes_.hasOnly("NGPQUWDFSTM") || mayBeSecondType(contour.first))
      return false;
    isOneBlock_ = words_.find('D') != nullptr;
    depth_ = isOneBlock_ ? strokes_.lengthInIncrements('D') : strokes_.learned(state_.cycle.initial);
    if (!isOneBlock_)
      retract_ = strokes_.learned(state_.cycle.dwell);
    readAllowances();
    return true;
  }
  /// The first block of a contour of type I moves along one axis alone.
  bool mayBeSecondType(BlockId first) const {
    const std::string_view own = action_ == CodeAction::TurnContour ? "XU" : "ZW";
    const std::string_view other = action_ == CodeAction::TurnContour ? "ZW" : "XU";
    const auto names = [&](std::string_view letters) {
      return std::ranges::any_of(context_.tree().wordsOf(first), [&](const Word &word) {
        return letters.find(word.address()) != std::string_view::npos;
      });
    };
    return !names(own) || names(other);
  }
  Point allowed(Point point) const {
    point[indexOf(Axis::X)] = interpretation_.add(point[indexOf(Axis::X)], x_);
    point[indexOf(Axis::Z)] = interpretation_.add(point[indexOf(Axis::Z)], z_);
    return point;
  }

  bool cutInBoxes(const Moves &moves) {
    const std::optional<Value> &back = isOneBlock_ ? depth_ : retract_;
    if (!back || (isOneBlock_ && context_.dialect().hasFanucParameters))
      return false; // FANUC keeps what an earlier block or program has said
    const auto x = [](const Point &point) { return point[indexOf(Axis::X)]; };
    const auto z = [](const Point &point) { return point[indexOf(Axis::Z)]; };
    const Point start = state_.position, bottom = moves.front().end, last = moves.back().end;
    const bool isTurning = action_ == CodeAction::TurnContour;
    const auto beyond = [&](const Value &target, const Value &from, const Value &allowance, const Value &distance,
                            Relation below) {
      const Value outwards = interpretation_.select(interpretation_.compare(below, from, target),
                                                    interpretation_.negate(allowance), allowance);
      return strokes_.awayFrom(
          target, from, interpretation_.add(strokes_.notNegative(outwards), strokes_.notNegative(distance)), below);
    };
    for (std::size_t i = 1; i < moves.size(); ++i)
      if (isArc(moves[i].kind) && !isQuarter(moves[i]))
        return false;
    strokes_.cutInBox(start, allowed(start));
    // Along the cuts the contour may end where the start is: then the tool may come off to either side.  Across them,
    // there is no cut in that case.
    for (const Relation along : {Relation::Less, Relation::LessOrEqual})
      cutInBoxes(moves, strokes_.at(beyond(x(isTurning ? bottom : last), x(start), x_, strokes_.twice(*back),
                                           isTurning ? Relation::Less : along),
                                    beyond(z(isTurning ? last : bottom), z(start), z_, *back,
                                           isTurning ? along : Relation::Less)));
    strokes_.cutInBox(start, allowed(last)); // and back
    return true;
  }
  /// With this corner.
  void cutInBoxes(const Moves &moves, const Point &from) {
    const auto x = [](const Point &point) { return point[indexOf(Axis::X)]; };
    const auto z = [](const Point &point) { return point[indexOf(Axis::Z)]; };
    for (std::size_t i = 1; i < moves.size(); ++i) {
      const Point a = allowed(moves[i].start), b = allowed(moves[i].end);
      strokes_.cutInBox(from, a);
      if (strokes_.isSame(x(a), x(b)) || strokes_.isSame(z(a), z(b)))
        continue;
      strokes_.cutInBox(from, strokes_.at(x(a), z(b)));
      strokes_.cutInBox(from, strokes_.at(x(b), z(a)));
    }
    strokes_.cutInBox(from, allowed(moves.back().end));
  }
  /// From axis to axis about its centre, the short way: it lies in the box of its ends.
  bool isQuarter(const Move<Value> &move) const {
    const auto from = [&](const Point &point, Axis axis, const Value &centre) {
      return interpretation_.subtract(point[indexOf(axis)], centre);
    };
    const Value startZ = from(move.start, Axis::Z, move.firstCentre),
                startX = from(move.start, Axis::X, move.secondCentre);
    const Value endZ = from(move.end, Axis::Z, move.firstCentre), endX = from(move.end, Axis::X, move.secondCentre);
    // The sign of a turn to the left, from Z to X.
    const auto turnsLeft = [&](const Value &turn) {
      const auto relation = move.kind == MoveKind::ArcCounterclockwise ? Relation::Greater : Relation::Less;
      return context_.certain(interpretation_.compare(relation, turn, context_.zero()));
    };
    if (strokes_.isZero(startZ) && strokes_.isZero(endX))
      return turnsLeft(interpretation_.negate(interpretation_.multiply(startX, endZ)));
    return strokes_.isZero(startX) && strokes_.isZero(endZ) && turnsLeft(interpretation_.multiply(startZ, endX));
  }

  bool draw(const Moves &moves) {
    const Point start = state_.position, corner = allowed(start);
    const auto roughing = inNumbers(moves, corner);
    const auto cuts = roughing ? roughingCuts(*roughing) : std::nullopt;
    if (!cuts)
      return false;
    const double back = strokes_.constant(retract_).value_or(0);
    const RoughingPoint &bottom = roughing->contour.front().start, &last = roughing->contour.back().end;
    const double up = roughing->start.level < bottom.level ? -back : back;
    const double home = last.along < roughing->start.along ? back : -back;
    const double begin = roughing->start.along;
    goTo(MoveKind::Rapid, roughing->start);
    for (const RoughingPoint &cut : *cuts) {
      goTo(moves.front().kind, {cut.level, begin});
      goTo(MoveKind::Feed, cut);
      if (back != 0)
        goTo(MoveKind::Rapid, {cut.level + up, cut.along + home});
      goTo(MoveKind::Rapid, {cut.level + up, begin});
    }
    goTo(moves.front().kind, {bottom.level, begin});
    for (std::size_t i = 1; i < moves.size(); ++i)
      tellAllowed(moves[i]);
    strokes_.go(MoveKind::Rapid, start[indexOf(Axis::X)], start[indexOf(Axis::Z)]);
    return true;
  }
  void tellAllowed(Move<Value> move) {
    move.start = allowed(move.start);
    move.end = allowed(move.end);
    if (isArc(move.kind)) {
      move.firstCentre = interpretation_.add(move.firstCentre, z_);
      move.secondCentre = interpretation_.add(move.secondCentre, x_);
    }
    move.feed = state_.word('F'); // that of the contour is for the finishing cycle
    state_.position = move.end;
    tell(context_, std::move(move));
  }
  void goTo(MoveKind kind, const RoughingPoint &point) {
    const bool isTurning = action_ == CodeAction::TurnContour;
    strokes_.go(kind, interpretation_.number(2 * (isTurning ? point.level : point.along)),
                interpretation_.number(isTurning ? point.along : point.level));
  }
  /// With the allowances.
  std::optional<Roughing> inNumbers(const Moves &moves, const Point &corner) const {
    const bool isTurning = action_ == CodeAction::TurnContour;
    bool isKnown = true;
    const auto number = [&](const Value &value) {
      const std::optional<double> known = strokes_.constant(value);
      isKnown = isKnown && known;
      return known.value_or(0);
    };
    const auto point = [&](const Value &x, const Value &z) {
      const double radius = number(x) / 2, along = number(z);
      return isTurning ? RoughingPoint{radius, along} : RoughingPoint{along, radius};
    };
    const auto placed = [&](const Point &at) { return point(at[indexOf(Axis::X)], at[indexOf(Axis::Z)]); };
    Roughing roughing{placed(corner), strokes_.constant(depth_).value_or(0), {}};
    for (std::size_t i = 1; i < moves.size(); ++i) {
      const Move<Value> &move = moves[i];
      RoughingPiece piece{placed(allowed(move.start)), placed(allowed(move.end)), {}};
      if (isArc(move.kind)) {
        piece.centre = point(interpretation_.add(move.secondCentre, x_), interpretation_.add(move.firstCentre, z_));
        isKnown = isKnown && turnsShortWay(move);
      }
      roughing.contour.push_back(piece);
    }
    return isKnown ? std::optional(roughing) : std::nullopt;
  }
  bool turnsShortWay(const Move<Value> &move) const {
    const auto from = [&](const Point &point, Axis axis, const Value &centre) {
      return strokes_.constant(interpretation_.subtract(point[indexOf(axis)], centre)).value_or(0);
    };
    const double turn = from(move.start, Axis::Z, move.firstCentre) * from(move.end, Axis::X, move.secondCentre) -
                        from(move.start, Axis::X, move.secondCentre) * from(move.end, Axis::Z, move.firstCentre);
    return (move.kind == MoveKind::ArcCounterclockwise) == (turn > 0);
  }

  static constexpr bool kHasMoves = requires(R & interpretation) { interpretation.takeMoves(); };

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
  TurningStrokes<R> strokes_;
  CodeAction action_;
  std::optional<Value> depth_{};
  std::optional<Value> retract_{};
  bool isOneBlock_ = false;
  Value x_{}; // allowances: in diameter, and along Z
  Value z_{};
};

} // namespace feedhold::detail
