// PathCutter: cutter compensation over terms: the host of CutterPath on one path of a proof.
//
// A truth that the conditions of the path decide is taken; another is not known, and the compensation of the path is
// then lost (its moves are not those of the tool).  Where the control may stop, the path goes on: that it does not stop
// is a claim (CutterClaim), and what the moves behind it rest on.
//
// A direction is known where it is the same for all arguments: along an axis, or by the numbers of a slope.  Crossings
// with arcs that are no tangents are not computed.
#pragma once

#include "meaning/semantics/cutter_path.h"
#include "proof/explore/exploration.h"
#include "proof/geometry/slope.h"

#include <functional>
#include <map>

namespace feedhold::prove {

/// A number that is added and multiplied like one; by itself it is 0.
class TermLength {
public:
  TermLength() = default;
  TermLength(smt::TermStore &store, smt::TermId term) : store_(&store), term_(term) {}
  /// In the store.
  smt::TermId in(smt::TermStore &store) const { return store_ ? term_ : store.number(smt::Number(0)); }
  friend TermLength operator+(TermLength a, TermLength b) { return a.with(b, &TermLength::sum); }
  friend TermLength operator-(TermLength a, TermLength b) { return a + -b; }
  friend TermLength operator*(TermLength a, TermLength b) { return a.with(b, &TermLength::product); }
  TermLength operator-() const { return store_ ? TermLength(*store_, store_->negate(term_)) : *this; }
  friend bool operator==(const TermLength &a, const TermLength &b) {
    smt::TermStore *store = a.store_ ? a.store_ : b.store_;
    return !store || a.in(*store) == b.in(*store);
  }

private:
  using Operation = smt::TermId (*)(smt::TermStore &, smt::TermId, smt::TermId);
  static smt::TermId sum(smt::TermStore &store, smt::TermId a, smt::TermId b) { return store.add(a, b); }
  static smt::TermId product(smt::TermStore &store, smt::TermId a, smt::TermId b) { return store.multiply(a, b); }
  TermLength with(const TermLength &other, Operation operation) const {
    smt::TermStore *store = store_ ? store_ : other.store_;
    return store ? TermLength(*store, operation(*store, in(*store), other.in(*store))) : TermLength();
  }

  smt::TermStore *store_ = nullptr;
  smt::TermId term_{0};
};

struct CutterTrack;

class PathCutter {
public:
  using Interpretation = SymbolicInterpretation;
  using Value = SymbolicValue;
  using Length = TermLength;
  using Truth = Condition;
  using Vector = PlaneVector<TermLength>;
  using Element = CutterElement<TermLength>;
  using Context = StepContext<SymbolicInterpretation>;

  /// What the explorer does for a path.
  struct Explored {
    std::function<bool(smt::TermId)> proves;
    std::function<std::optional<PathOffset>(const Value &number)> offsetOf;
    std::function<void(MoveInstance)> record;
    std::function<void(CutterClaim)> claim;
  };
  PathCutter(smt::TermStore &store, CutterTrack &track, Explored explored)
      : store_(store), track_(track), explored_(std::move(explored)) {}

  static constexpr std::string_view kNoOffset = "cutter compensation by an offset that is not known; `@OFFSET` tells "
                                                "it for a D whose offset the program does not "
                                                "write, in the units of the start, which `@MODAL` tells";
  static constexpr std::string_view kNoNose =
      "tool nose radius compensation by an offset that is not known; `@TOOL TIP` tells it where the program does not "
      "write tool offsets, in the units of the start, which `@MODAL` tells";

  // ---- truths and lengths ----
  bool holds(Truth truth);
  std::string_view takeUndecided() { return std::exchange(undecided_, {}); }
  bool knowsReadAhead(const Dialect &dialect) const { return dialect.behaviour.cutterBlocks == 0; }
  bool isOn(Switch setting);
  Truth none(Length length, double) { return {store_.equal(term(length), zero())}; }
  Truth positive(Length length, double) { return {store_.less(zero(), term(length))}; }
  Truth notPositive(Length length, double) { return {store_.lessOrEqual(term(length), zero())}; }
  Truth negative(Length length, double) { return {store_.less(term(length), zero())}; }
  Truth standing(Vector v, double) { return {store_.logicalAnd(none(v.first, 0).term, none(v.second, 0).term)}; }
  Truth apart(Vector a, Vector b, double) { return {store_.logicalNot(standing(a - b, 0).term)}; }
  std::optional<int> signOf(Length offset);
  void cannotTell(std::string_view why) { undecided(why); }
  Length number(double value) { return {store_, store_.number(smt::Number::fromDouble(value))}; }
  Length lengthOf(const Value &value) { return {store_, value.number}; }
  Length magnitude(Vector v);
  Vector unit(Vector v);
  Vector direction(Vector v) { return v; }
  Vector crossing(Vector n, Vector m, Length radius);
  Length quotient(Length dividend, Length divisor) { return {store_, store_.divide(term(dividend), term(divisor))}; }
  Length least(Length a, Length b);

  // ---- angles and crossings ----
  double sweepOf(const Element &, std::uint32_t) const { return 0; }
  CornerTurn turnByAngle(const Element &, const Element &, int);
  std::optional<Vector> innerCrossing(const Element &, const Element &, const CutterSide<TermLength> &);
  Truth arcReversed(const Element &arc, Vector from, Vector to, Length radius);
  Move<Value> centreArc(Move<Value> move, const Element &, Vector, Vector, Length) const { return move; }

  // ---- offsets ----
  std::string_view whyNoOffset() const { return whyNoOffset_; }
  std::optional<CutterOffset<TermLength>> offsetOf(Context &context, const Value &number);

  // ---- moves ----
  const Move<Value> &moveOf(std::size_t index) const;
  /// Recorded are the moves of the point that is programmed without compensation: of the tip, on a lathe.
  void follow(std::size_t index, const std::vector<Move<Value>> &centre, const std::array<TermLength, 3> &tip);
  void leave(std::size_t index, std::string_view why);
  bool areInOneSpace(std::size_t a, std::size_t b) const;
  void shift(Value &value, Length length) { value.number = store_.add(value.number, term(length)); }
  bool refuses(Truth truth, AlarmKind kind, Place began);

private:
  smt::TermId zero() { return store_.number(smt::Number(0)); }
  smt::TermId term(Length length) { return length.in(store_); }
  bool proves(smt::TermId truth);
  bool isZero(Length length);
  /// 1 above 0, -1 below; 0: neither is known.
  int strictSignOf(Length length);
  /// Present where its `times` is above 0.
  std::optional<geometry::Slope> slopeOf(Vector v);
  Length lengthOf(const geometry::Slope &slope) { return {store_, geometry::lengthOf(store_, slope)}; }
  bool undecided(std::string_view why);

  smt::TermStore &store_;
  CutterTrack &track_;
  Explored explored_;
  std::string_view undecided_; // empty: nothing is
  std::string_view whyNoOffset_ = kNoOffset;
};

/// The compensation of a path, from the block with G41 or G42 to the move that ends it.
struct CutterTrack {
  CutterPath<PathCutter> walk;
  std::map<std::size_t, MoveInstance> open; // moves by number: what the tool's centre makes of them comes later
  std::size_t next = 0;                     // number of the next move
  smt::TermId rests;                        // what all of it rests on: the tool stood on the path before, and so on
  std::optional<std::array<smt::TermId, 2>> end = {}; // X and Y where the last move ended; of a lathe, X and Z
};

} // namespace feedhold::prove
