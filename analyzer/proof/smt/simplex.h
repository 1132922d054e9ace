// Simplex: are these linear constraints satisfiable over the rationals?  Exact, incremental, with undo; the answer no
// comes with its Farkas multipliers.  After Dutertre and de Moura, "A fast linear-arithmetic solver for DPLL(T)" (CAV
// 2006).
#pragma once

#include "proof/smt/number.h"

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace feedhold::smt {

/// real + infinitesimal * delta for a delta that is positive and as small as need be: how `>` becomes `>=`.
struct DeltaNumber {
  Number real;
  Number infinitesimal;

  DeltaNumber &operator+=(const DeltaNumber &other) {
    real += other.real;
    infinitesimal += other.infinitesimal;
    return *this;
  }
  friend DeltaNumber operator+(DeltaNumber left, const DeltaNumber &right) { return left += right; }
  friend DeltaNumber operator-(const DeltaNumber &left, const DeltaNumber &right) {
    return {left.real - right.real, left.infinitesimal - right.infinitesimal};
  }
  friend DeltaNumber operator*(const DeltaNumber &value, const Number &factor) {
    return {value.real * factor, value.infinitesimal * factor};
  }
  friend bool operator==(const DeltaNumber &, const DeltaNumber &) = default;
  friend std::strong_ordering operator<=>(const DeltaNumber &left, const DeltaNumber &right) {
    auto byReal = left.real <=> right.real;
    return byReal != 0 ? byReal : left.infinitesimal <=> right.infinitesimal;
  }
};

enum class LinearRelation : std::uint8_t { NonNegative, Positive, Zero };

class Simplex {
public:
  using Column = std::uint32_t;
  using Form = std::vector<std::pair<Column, Number>>; ///< columns ascend and differ; no factor is 0
  /// Multipliers of constraints, by the caller's number: the sum is a constant below 0, or 0 where a constraint with a
  /// positive multiplier is strict.  Those of equalities may be negative.
  using Conflict = std::map<std::uint32_t, Number>;
  enum class Status : std::uint8_t { Feasible, Infeasible, OutOfBudget };

  /// A free unknown; where it stands is a wish.
  Column addColumn(const Number &start = Number());
  /// form + constant >= 0 (> 0, = 0); `reason` is what a conflict will name.
  void require(std::uint32_t reason, const Form &form, const Number &constant, LinearRelation relation);
  /// Once infeasible, it stays so until an undo.
  Status check(std::uint64_t workLimit);
  const Conflict &conflict() const { return conflict_; }

  /// After Feasible: where the columns stand.
  const DeltaNumber &value(Column column) const { return variables_[column].value; }
  /// A delta that is small enough for all constraints.
  Number smallDelta() const;

  using Mark = std::size_t;
  Mark mark() const { return trail_.size(); }
  /// Forgets all constraints after the mark.
  void undo(Mark mark);

  /// Coefficients touched so far.
  std::uint64_t work() const { return work_; }

private:
  using Index = std::uint32_t;
  enum class Place : std::uint8_t { Nonbasic, Basic, Detached };
  struct Bound {
    DeltaNumber limit;
    std::uint32_t reason;
    Number multiplier; ///< times the constraint of the reason, gives the distance from the limit
  };
  struct Variable {
    DeltaNumber value;
    Place place = Place::Nonbasic;
    std::optional<Bound> lower, upper;
    Form definition;             ///< of a row, over the first columns
    std::map<Index, Number> row; ///< while basic: over nonbasic variables
  };
  struct Change {
    Index variable;
    enum class Side : std::uint8_t { Lower, Upper, Conflict } side;
    std::optional<Bound> before;
  };

  Index variableOf(const Form &normalized);
  void attach(Index index);
  void bound(Index index, Change::Side side, Bound bound);
  void shift(Index index, const DeltaNumber &step);
  void pivot(Index basic, Index nonbasic);
  std::optional<Index> violated() const;
  std::optional<Index> entering(const Variable &leaving, Change::Side side) const;
  void remember();
  void restore();
  void explain(const Variable &basic, Change::Side side);
  void addTo(Conflict &conflict, const Bound &bound, const Number &factor) const;

  std::vector<Variable> variables_;
  std::map<Form, Index> rows_;
  std::vector<Change> trail_;
  Conflict conflict_;
  std::vector<std::pair<Column, DeltaNumber>> feasible_; ///< where the columns stood at the last Feasible
  Mark feasibleMark_ = 0;                                ///< and of which bounds that is known
  bool infeasible_ = false;
  std::uint64_t work_ = 0;
};

} // namespace feedhold::smt
