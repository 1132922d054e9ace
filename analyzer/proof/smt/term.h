// TermStore: a small typed expression language, hash-consed and folded.  Equal terms have equal ids.
#pragma once

#include "base/support/id.h"
#include "base/support/store.h"
#include "proof/smt/number.h"
#include "proof/smt/term_table.h"

#include <deque>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace feedhold::smt {

enum class Sort : std::uint8_t { Bool, Int, Real };

/// Mathematical functions over the reals; angles are in degrees.  They are names here: what is known of them is said
/// in purify.h, and every fact there holds only where the function is defined.
enum class Function : std::uint8_t {
  Floor, ///< the largest integer that is not above; sort Int
  Sqrt,  ///< of x >= 0
  Sin,
  Cos,
  Tan,   ///< where the cosine is not 0
  Asin,  ///< of -1..1, in -90..90
  Acos,  ///< of -1..1, in 0..180
  Atan2, ///< (y, x): the direction of the point (x, y), above -180 up to 180; not of (0, 0)
  Ln,    ///< of x > 0
  Exp,
  Power, ///< (base, exponent), where it is a real number
  BitAnd,
  BitOr,
  BitXor,
  Nearest, ///< the double that is nearest to x, of two the even one; without overflow and underflow
  Near,    ///< (x, h): some number at most h away from x, for equal arguments the same; h is a number and positive
};
constexpr Function kLastFunction = Function::Near;

enum class TermKind : std::uint8_t {
  True,
  False,
  Number,      ///< sort Int when it is an integer
  Variable,    ///< named, of any sort
  Add,         ///< two or more; at most one constant, last; each other argument once, perhaps with a factor
  Multiply,    ///< (constant, a term that is no sum), or two or more terms without a constant
  Divide,      ///< (dividend, divisor); says nothing where the divisor is 0
  Less,        ///< of two numbers; one side is a constant
  LessOrEqual, ///< of two numbers; one side is a constant
  Equal,       ///< of two numbers; the right side is a constant
  And,         ///< two or more
  Or,          ///< two or more
  Not,         ///< never of a Not, a Less or a LessOrEqual
  Ite,         ///< (condition, then, else), of numbers
  Apply,       ///< of a Function
};

struct TermTag;
using TermId = Id<TermTag>;

struct Term {
  TermKind kind;
  Sort sort;
  Function function = Function::Floor; ///< of an Apply
  std::vector<TermId> arguments;
  Number number;    ///< of a Number
  std::string name; ///< of a Variable
};

/// How large a number becomes when it is written out as a polynomial over variables, quotients and functions.
struct TermShape {
  std::uint32_t monomials; ///< at most so many; a million stands for more
  std::uint32_t degree;
  std::uint32_t depth;       ///< of quotients, functions and choices within one another
  std::uint32_t words;       ///< of the largest number in it
  std::uint32_t size;        ///< terms in it, those that occur twice counted twice; a million stands for more
  bool hasFunctions = false; ///< quotients or functions
  bool hasRounding = false;  ///< Nearest or Near
  bool hasSquares = false;   ///< of sums
};

/// constant + the sum of factor * term; the terms are no sums, differ, and ascend; no factor is 0.
struct LinearSum {
  Number constant;
  std::vector<std::pair<TermId, Number>> terms;
};

/// Makes terms and owns them.  Each factory folds: constants, neutral elements, sums and comparisons in one linear
/// normal form (so that `x < x + 1` is true and `2*x <= 4` is `x <= 2`), double negation, repeated and opposite
/// operands, conditions that are decided.  The arguments of a term have lower ids than the term.
class TermStore {
public:
  TermStore();
  TermStore(const TermStore &) = delete;
  TermStore &operator=(const TermStore &) = delete;

  TermId yes() const { return TermId(1); }
  TermId no() const { return TermId(0); }
  TermId number(const Number &value);
  /// One name has one sort in one store.
  TermId variable(std::string_view name, Sort sort);
  /// The variable stands for a number that the control holds: a double.
  void markAsDouble(TermId variable) { doubles_.insert(variable); }
  bool isMarkedAsDouble(TermId term) const { return doubles_.contains(term); }
  /// Of a variable that exists.
  TermId variableNamed(std::string_view name) const;

  TermId add(std::span<const TermId> terms);
  TermId add(TermId left, TermId right);
  TermId subtract(TermId left, TermId right);
  TermId negate(TermId term) { return scale(Number(-1), term); }
  TermId scale(const Number &factor, TermId term);
  TermId multiply(std::span<const TermId> factors);
  TermId multiply(TermId left, TermId right);
  TermId divide(TermId dividend, TermId divisor);

  TermId less(TermId left, TermId right);
  TermId lessOrEqual(TermId left, TermId right);
  TermId greater(TermId left, TermId right) { return less(right, left); }
  TermId greaterOrEqual(TermId left, TermId right) { return lessOrEqual(right, left); }
  /// Of two numbers or two Bools.
  TermId equal(TermId left, TermId right);
  TermId notEqual(TermId left, TermId right) { return logicalNot(equal(left, right)); }

  TermId logicalAnd(std::span<const TermId> terms);
  TermId logicalAnd(TermId left, TermId right);
  TermId logicalOr(std::span<const TermId> terms);
  TermId logicalOr(TermId left, TermId right);
  TermId logicalNot(TermId term);
  TermId implies(TermId left, TermId right) { return logicalOr(logicalNot(left), right); }
  /// Of two Bools or two numbers.
  TermId ite(TermId condition, TermId thenTerm, TermId elseTerm);

  TermId apply(Function function, std::span<const TermId> arguments);
  TermId apply(Function function, TermId argument);
  TermId floor(TermId term) { return apply(Function::Floor, term); }
  TermId ceiling(TermId term) { return negate(floor(negate(term))); }
  /// The integer part: towards zero.
  TermId truncate(TermId term);
  TermId absolute(TermId term);

  const Term &operator[](TermId id) const { return terms_[id]; }
  Sort sort(TermId id) const { return terms_[id].sort; }
  const TermShape &shape(TermId id) const { return shapes_[id.index()]; }
  std::size_t size() const { return terms_.size(); }
  bool isNumber(TermId id) const { return terms_[id].kind == TermKind::Number; }

  /// The Variables below a term, ascending; found once.
  const std::vector<TermId> &variablesOf(TermId term) const;

  /// Any number as a sum; a term that is no sum is one term with factor 1.
  LinearSum linear(TermId term) const;
  TermId fromLinear(const LinearSum &sum);

private:
  TermId intern(Term term);
  TermShape shapeOf(const Term &term) const;
  LinearSum difference(TermId left, TermId right) const;
  TermId compare(TermKind kind, TermId left, TermId right);
  TermId negation(TermId id);
  std::optional<TermId> roundedBy(TermId term) const;
  TermId junction(TermKind kind, std::span<const TermId> terms);
  std::optional<TermId> foldedFloor(TermId argument);
  std::optional<TermId> foldedNearest(TermId argument);
  bool isRootOfNumber(TermId term) const;
  Number joinRoots(std::vector<TermId> &factors);
  std::optional<TermId> spreadRoot(const std::vector<TermId> &factors);
  std::optional<TermId> folded(Function function, std::span<const TermId> arguments);
  bool isWhole(const LinearSum &sum) const;

  Store<Term, TermId> terms_;
  std::vector<TermShape> shapes_; // by term
  std::vector<TermId> negations_; // by term: itself where it is not known
  TermTable known_;
  std::map<std::string, TermId, std::less<>> variables_;
  std::set<TermId> doubles_;
  mutable std::vector<const std::vector<TermId> *> variablesOf_; // by term; null: not asked for yet
  mutable std::deque<std::vector<TermId>> variableLists_;
};

/// All terms below some terms, and these: each once, arguments before their users.
std::vector<TermId> reachable(const TermStore &store, std::span<const TermId> terms);
/// The Variables below a term, ascending.
std::vector<TermId> variablesOf(const TermStore &store, std::span<const TermId> terms);
const std::vector<TermId> &variablesOf(const TermStore &store, TermId term);

/// The same kind of term (and function) over other arguments, folded.
TermId withArguments(TermStore &store, TermId term, const std::vector<TermId> &arguments);

using Substitution = std::map<TermId, TermId>;
/// Each key (any term, mostly a Variable) replaced by its value, all at once; then folded again.
TermId substitute(TermStore &store, TermId term, const Substitution &substitution);

/// Nearest or Near.
bool isRounding(const Term &term);
/// Of a sum with itself.
bool isSquareOfSum(const TermStore &store, const Term &term);
/// Each rounded number in the term replaced by what it was rounded from.
TermId withoutRounding(TermStore &store, TermId term);

std::string_view nameOf(Function function);
std::size_t arity(Function function);

} // namespace feedhold::smt
