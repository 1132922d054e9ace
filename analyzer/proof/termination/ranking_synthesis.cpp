#include "proof/termination/ranking_synthesis.h"

#include "proof/decide/entails.h"
#include "proof/smt/purify.h"
#include "proof/smt/simplex.h"

#include <algorithm>
#include <set>

namespace feedhold::prove {

using smt::LinearRelation;
using smt::Number;
using smt::Simplex;
using smt::Sort;
using smt::TermId;
using smt::TermKind;

namespace {

constexpr std::size_t kMostCases = 10; // of an iteration
constexpr std::size_t kMostRankingAtoms = 40;
constexpr std::size_t kMostFactors = 3;
constexpr std::uint64_t kMostSimplex = 150'000;

} // namespace

/// An iteration some of whose choices have been made.
struct RankingSynthesis::Draft {
  std::vector<TermId> formulas;
  std::vector<TermId> next;
};

/// The linear program: unknown coefficients of ranking functions, and Farkas multipliers.
class RankingSynthesis::Program {
public:
  /// Linear in the unknowns.
  struct Unknown {
    std::map<Simplex::Column, Number> factors;
    Number constant;

    void add(const Unknown &other, const Number &factor) {
      for (const auto &[column, value] : other.factors)
        factors[column] += value * factor;
      constant += other.constant * factor;
    }
  };
  struct Form {
    std::map<Atom, Unknown> atoms;
    Unknown constant;

    void add(const Form &other, const Number &factor) {
      for (const auto &[atom, unknown] : other.atoms)
        atoms[atom].add(unknown, factor);
      constant.add(other.constant, factor);
    }
  };

  Program(const std::vector<Atom> &atoms, std::size_t components) {
    for (std::size_t i = 0; i < components; ++i) {
      rankings_.emplace_back();
      for (const Atom atom : atoms)
        rankings_.back().atoms[atom].factors.emplace(simplex_.addColumn(), Number(1));
      rankings_.back().constant.factors.emplace(simplex_.addColumn(), Number(1));
    }
  }

  const Form &rankingOf(std::size_t component) const { return rankings_[component]; }
  /// By how much an iteration lowers a ranking function.
  Form decreaseOf(std::size_t component, const Case &path) const {
    Form fall;
    for (const auto &[atom, unknown] : rankings_[component].atoms) {
      const auto next = path.next.find(atom);
      if (next == path.next.end())
        continue;
      fall.atoms[atom].add(unknown, Number(1));
      for (const auto &[other, factor] : next->second.factors)
        fall.atoms[other].add(unknown, -factor);
      fall.constant.add(unknown, -next->second.constant);
    }
    return fall;
  }
  static Form minus(Form form, const Number &number) {
    form.constant.constant -= number;
    return form;
  }

  /// The rows of the path make the form not negative.
  void require(const Case &path, const Form &form) {
    std::map<Atom, Unknown> sums;
    Unknown rest = form.constant;
    for (const Row &row : path.rows) {
      const Simplex::Column multiplier = simplex_.addColumn();
      if (!row.isEquality)
        simplex_.require(0, {{multiplier, Number(1)}}, Number(), LinearRelation::NonNegative);
      for (const auto &[atom, factor] : row.factors)
        sums[atom].factors[multiplier] += factor;
      rest.factors[multiplier] -= row.constant;
    }
    for (const auto &[atom, unknown] : form.atoms)
      sums[atom].add(unknown, Number(-1));
    for (const auto &[atom, sum] : sums)
      require(sum, LinearRelation::Zero);
    require(rest, LinearRelation::NonNegative);
  }
  void requireZero(const Unknown &unknown) { require(unknown, LinearRelation::Zero); }

  bool isFeasible() { return simplex_.check(simplex_.work() + kMostSimplex) == Simplex::Status::Feasible; }
  Number value(const Unknown &unknown) const {
    Number sum = unknown.constant;
    for (const auto &[column, factor] : unknown.factors)
      sum += simplex_.value(column).real * factor;
    return sum;
  }
  Simplex::Mark mark() const { return simplex_.mark(); }
  void undo(Simplex::Mark mark) { simplex_.undo(mark); }
  std::uint64_t work() const { return simplex_.work(); }

private:
  void require(const Unknown &unknown, LinearRelation relation) {
    Simplex::Form form;
    for (const auto &[column, factor] : unknown.factors)
      if (!factor.isZero())
        form.emplace_back(column, factor);
    simplex_.require(0, form, unknown.constant, relation);
  }

  Simplex simplex_;
  std::vector<Form> rankings_;
};

RankingSynthesis::RankingSynthesis(const SymbolicInterpretation &interpretation, const FactIndex &facts,
                                   smt::TermStore &store, const LoopInstance &loop,
                                   std::span<const std::size_t> iterations, std::span<const TermId> more)
    : interpretation_(interpretation), store_(store), loop_(loop), iterations_(iterations.begin(), iterations.end()) {
  for (const auto &[variable, next] : loop.transitions.front().next)
    if (store.sort(variable) != Sort::Bool && loop.deciding.contains(variable))
      variables_.push_back(variable);
  const TermId zero = store.number(Number(0));
  std::vector<TermId> formulas; // of all iterations: one number for one application
  std::vector<std::size_t> ends;
  for (const std::size_t iteration : iterations_) {
    const Transition &transition = loop.transitions[iteration];
    std::vector<TermId> conditions = transition.conditions;
    for (const TermId condition : more) {
      conditions.push_back(condition);
      conditions.push_back(smt::substitute(store, condition, transition.next));
    }
    std::vector<TermId> next;
    std::vector<TermId> all;
    for (const TermId variable : variables_) {
      next.push_back(transition.next.at(variable));
      all.insert(all.end(), {variable, next.back()});
    }
    std::vector<TermId> numbers = smt::variablesOf(store, all);
    std::erase_if(numbers, [&](TermId each) { return store.sort(each) == Sort::Bool; });
    const TermId aboutAll = store.lessOrEqual(zero, store.add(numbers));
    const std::vector<TermId> relevant =
        relevantQuery(store, facts, interpretation.facts(), conditions, aboutAll).assumptions;
    formulas.insert(formulas.end(), next.begin(), next.end());
    formulas.insert(formulas.end(), relevant.begin(), relevant.end());
    ends.push_back(formulas.size());
  }
  nameConstants(formulas);
  const smt::Purified pure =
      smt::purify(store, formulas, iterations_.size() == 1 ? smt::Hold::Together : smt::Hold::Apart);
  for (const smt::Definition &definition : pure.definitions)
    applications_.emplace(definition.variable, definition.application);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < iterations_.size(); ++i) {
    const auto first = pure.formulas.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto behindNext = first + static_cast<std::ptrdiff_t>(variables_.size());
    const auto last = pure.formulas.begin() + static_cast<std::ptrdiff_t>(ends[i]);
    std::vector<TermId> known(behindNext, last);
    known.insert(known.end(), pure.facts.begin(), pure.facts.end());
    addCases(iterations_[i], std::move(known), {first, behindNext});
    begin = ends[i];
  }
  std::set<Atom> atoms(variables_.begin(), variables_.end());
  for (const Atom product : products_) // that every iteration is known to change
    if (std::all_of(cases_.begin(), cases_.end(), [&](const Case &path) { return path.next.contains(product); }))
      atoms.insert(product);
  for (const Case &path : cases_)
    for (const Row &row : path.rows)
      for (const auto &[atom, factor] : row.factors)
        if (isSteady(atom) && atoms.size() < kMostRankingAtoms)
          atoms.insert(atom);
  atoms_.assign(atoms.begin(), atoms.end());
}

/// What no iteration changes counts as a number: its own choices and functions do not matter.
void RankingSynthesis::nameConstants(std::vector<TermId> &formulas) {
  smt::Substitution names;
  for (const TermId term : smt::reachable(store_, formulas)) {
    const TermKind kind = store_[term].kind;
    const bool isOpaque = kind == TermKind::Ite || kind == TermKind::Apply || kind == TermKind::Divide ||
                          (kind == TermKind::Multiply && !store_.isNumber(store_[term].arguments[0]));
    if (!isOpaque || !isSteady(term))
      continue;
    const TermId name = store_.variable("constant " + std::to_string(term.index()), store_.sort(term));
    names.emplace(term, name);
    applications_.emplace(name, term);
  }
  for (TermId &formula : formulas)
    formula = smt::substitute(store_, formula, names);
}

/// No iteration changes it.
bool RankingSynthesis::isSteady(Atom atom) {
  if (const auto known = steady_.find(atom); known != steady_.end())
    return known->second;
  const bool is = std::ranges::all_of(smt::variablesOf(store_, atom), [&](TermId variable) {
    const auto named = applications_.find(variable);
    return named == applications_.end() ? loop_.isConstant(interpretation_, store_, variable) : isSteady(named->second);
  });
  steady_.emplace(atom, is);
  return is;
}

// ---- cases ----

void RankingSynthesis::addCases(std::size_t iteration, std::vector<TermId> formulas, std::vector<TermId> next) {
  std::vector<Draft> open{{std::move(formulas), std::move(next)}};
  std::vector<Case> paths;
  while (!open.empty()) {
    const Draft draft = std::move(open.back());
    open.pop_back();
    Case path = caseOf(iteration, draft);
    if (!isPossible(path))
      continue;
    std::vector<Draft> parts;
    if (open.size() + paths.size() < kMostCases && split(draft, parts))
      open.insert(open.end(), parts.begin(), parts.end());
    else
      paths.push_back(std::move(path));
  }
  std::move(paths.begin(), paths.end(), std::back_inserter(cases_));
}

/// By the first condition of a number, difference or disjunction.
bool RankingSynthesis::split(const Draft &draft, std::vector<Draft> &parts) {
  std::vector<TermId> all = draft.formulas;
  all.insert(all.end(), draft.next.begin(), draft.next.end());
  for (const TermId term : smt::reachable(store_, all)) {
    if (store_[term].kind != TermKind::Ite)
      continue;
    const std::vector<TermId> arguments = store_[term].arguments;
    for (const bool holds : {true, false}) {
      Draft part;
      const smt::Substitution chosen{{term, arguments[holds ? 1 : 2]}};
      for (const TermId formula : draft.formulas)
        part.formulas.push_back(smt::substitute(store_, formula, chosen));
      for (const TermId next : draft.next)
        part.next.push_back(smt::substitute(store_, next, chosen));
      part.formulas.push_back(holds ? arguments[0] : store_.logicalNot(arguments[0]));
      parts.push_back(std::move(part));
    }
    return true;
  }
  return splitFormula(draft, parts, TermKind::Equal) || splitFormula(draft, parts, TermKind::Or);
}

/// By a number that is not another, or by a disjunction.
bool RankingSynthesis::splitFormula(const Draft &draft, std::vector<Draft> &parts, TermKind kind) {
  for (std::size_t i = 0; i < draft.formulas.size(); ++i) {
    const smt::Term term = store_[draft.formulas[i]];
    std::vector<TermId> choices;
    if (kind == TermKind::Or && term.kind == TermKind::Or) {
      choices = term.arguments;
    } else if (kind == TermKind::Equal && term.kind == TermKind::Not &&
               store_[term.arguments[0]].kind == TermKind::Equal) {
      const std::vector<TermId> sides = store_[term.arguments[0]].arguments;
      if (store_.sort(sides[0]) != Sort::Bool)
        choices = {store_.less(sides[0], sides[1]), store_.less(sides[1], sides[0])};
    } else if (kind == TermKind::Or && term.kind == TermKind::Not && store_[term.arguments[0]].kind == TermKind::And) {
      for (const TermId part : std::vector<TermId>(store_[term.arguments[0]].arguments))
        choices.push_back(store_.logicalNot(part));
    }
    if (choices.empty())
      continue;
    for (const TermId choice : choices) {
      parts.push_back(draft);
      parts.back().formulas[i] = choice;
    }
    return true;
  }
  return false;
}

RankingSynthesis::Case RankingSynthesis::caseOf(std::size_t iteration, const Draft &draft) {
  Case path{iteration, {}, {}};
  std::vector<TermId> open = draft.formulas;
  while (!open.empty()) {
    const TermId formula = open.back();
    open.pop_back();
    if (store_[formula].kind == TermKind::And)
      open.insert(open.end(), store_[formula].arguments.begin(), store_[formula].arguments.end());
    else if (auto row = rowOf(formula))
      path.rows.push_back(std::move(*row));
    else if (formula == store_.no())
      path.rows.push_back({{}, Number(-1), false});
  }
  for (std::size_t i = 0; i < variables_.size(); ++i)
    path.next.emplace(variables_[i], expanded(draft.next[i]));
  addProducts(path);
  return path;
}

/// Products of what iterations change are changed by them, too.
void RankingSynthesis::addProducts(Case &path) {
  std::set<Atom> products;
  for (const Row &row : path.rows)
    for (const auto &[atom, factor] : row.factors)
      if (store_[atom].kind == TermKind::Multiply)
        products.insert(atom);
  for (const Atom product : products) {
    const std::vector<TermId> factors = store_[product].arguments;
    Row next{{}, Number(1), false};
    bool isKnown = factors.size() <= kMostFactors;
    bool isConstant = true;
    for (std::size_t i = 0; i < factors.size() && isKnown; ++i) {
      const auto known = path.next.find(factors[i]);
      isConstant = isConstant && known == path.next.end();
      isKnown = known != path.next.end() || isSteady(factors[i]);
      next = times(next, known != path.next.end() ? known->second : Row{{{factors[i], Number(1)}}, Number(), false});
    }
    if (!isKnown || isConstant)
      continue;
    path.next.emplace(product, std::move(next));
    if (std::find(products_.begin(), products_.end(), product) == products_.end())
      products_.push_back(product);
  }
}

RankingSynthesis::Row RankingSynthesis::times(const Row &left, const Row &right) const {
  Row product{{}, left.constant * right.constant, false};
  for (const auto &[atom, factor] : left.factors)
    product.factors[atom] += factor * right.constant;
  for (const auto &[atom, factor] : right.factors)
    product.factors[atom] += factor * left.constant;
  for (const auto &[a, factorOfA] : left.factors)
    for (const auto &[b, factorOfB] : right.factors)
      product.factors[store_.multiply(a, b)] += factorOfA * factorOfB;
  return product;
}

/// As a sum of products of atoms.
RankingSynthesis::Row RankingSynthesis::expanded(TermId term) const {
  const smt::LinearSum sum = store_.linear(term);
  Row row{{}, sum.constant, false};
  for (const auto &[atom, factor] : sum.terms) {
    const std::vector<TermId> factors = store_[atom].arguments;
    Row part{{{atom, Number(1)}}, Number(), false};
    if (store_[atom].kind == TermKind::Multiply && factors.size() <= kMostFactors) {
      part = Row{{}, Number(1), false};
      for (const TermId each : factors)
        part = times(part, expanded(each));
    }
    row.constant += part.constant * factor;
    for (const auto &[other, value] : part.factors)
      row.factors[other] += value * factor;
  }
  return row;
}

/// A comparison of numbers; one of integers leaves a whole distance.
std::optional<RankingSynthesis::Row> RankingSynthesis::rowOf(TermId literal) const {
  const TermKind kind = store_[literal].kind;
  const std::vector<TermId> arguments = store_[literal].arguments;
  const bool isEqual = kind == TermKind::Equal;
  if ((!isEqual && kind != TermKind::Less && kind != TermKind::LessOrEqual) || store_.sort(arguments[0]) == Sort::Bool)
    return std::nullopt;
  Row row = expanded(store_.subtract(arguments[1], arguments[0]));
  row.isEquality = isEqual;
  const bool isWhole = std::all_of(row.factors.begin(), row.factors.end(), [&](const auto &part) {
    return store_.sort(part.first) == Sort::Int && part.second.isInteger();
  });
  if (kind == TermKind::Less && isWhole)
    row.constant = smt::ceiling(row.constant) - Number(1);
  return row;
}

bool RankingSynthesis::isPossible(const Case &path) {
  Simplex simplex;
  std::map<Atom, Simplex::Column> columns;
  for (const Row &row : path.rows)
    for (const auto &[atom, factor] : row.factors)
      if (!columns.contains(atom))
        columns.emplace(atom, simplex.addColumn());
  for (const Row &row : path.rows) {
    Simplex::Form form;
    for (const auto &[atom, factor] : row.factors)
      if (!factor.isZero())
        form.emplace_back(columns.at(atom), factor);
    std::sort(form.begin(), form.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    simplex.require(0, form, row.constant, row.isEquality ? LinearRelation::Zero : LinearRelation::NonNegative);
  }
  const bool isPossible = simplex.check(kMostSimplex) != Simplex::Status::Infeasible;
  work_ += simplex.work();
  return isPossible;
}

// ---- ranking functions ----

std::optional<TermId> RankingSynthesis::loweredBy(std::size_t iteration) {
  Program program(atoms_, 1);
  const auto lower = [&](std::size_t lowered) {
    for (const Case &path : cases_)
      if (path.iteration == lowered) {
        program.require(path, Program::minus(program.decreaseOf(0, path), Number(1)));
        program.require(path, program.rankingOf(0));
      }
  };
  for (const Case &path : cases_)
    if (path.iteration != iteration)
      program.require(path, program.decreaseOf(0, path));
  lower(iteration);
  bool found = program.isFeasible();
  if (found) {
    for (const std::size_t other : iterations_) {
      const Simplex::Mark mark = program.mark();
      lower(other);
      if (!program.isFeasible())
        program.undo(mark);
    }
    found = program.isFeasible();
    makePlain(program, 1);
  }
  work_ += program.work();
  return found ? std::optional(ranking(program, 0)) : std::nullopt;
}

std::optional<std::vector<TermId>> RankingSynthesis::nested(std::size_t depth) {
  Program program(atoms_, depth);
  for (const Case &path : cases_) {
    for (std::size_t i = 0; i < depth; ++i) {
      Program::Form fall = Program::minus(program.decreaseOf(i, path), Number(1));
      if (i > 0)
        fall.add(program.rankingOf(i - 1), Number(1));
      program.require(path, fall);
    }
    program.require(path, program.rankingOf(depth - 1));
  }
  std::optional<std::vector<TermId>> rankings;
  if (program.isFeasible()) {
    makePlain(program, depth);
    rankings.emplace();
    for (std::size_t i = 0; i < depth; ++i)
      rankings->push_back(ranking(program, i));
  }
  work_ += program.work();
  return rankings;
}

std::optional<TermId> RankingSynthesis::decreasing() {
  Program program(variables_, 1);
  for (const Case &path : cases_)
    program.require(path, Program::minus(program.decreaseOf(0, path), Number(1)));
  const bool found = program.isFeasible();
  if (found)
    makePlain(program, 1);
  work_ += program.work();
  return found ? std::optional(ranking(program, 0)) : std::nullopt;
}

/// Coefficients that need not be there are 0.
void RankingSynthesis::makePlain(Program &program, std::size_t components) {
  for (std::size_t i = 0; i < components; ++i) {
    std::vector<Program::Unknown> unknowns{program.rankingOf(i).constant};
    for (const auto &[atom, unknown] : program.rankingOf(i).atoms)
      unknowns.push_back(unknown);
    for (const Program::Unknown &unknown : unknowns) {
      const Simplex::Mark mark = program.mark();
      program.requireZero(unknown);
      if (!program.isFeasible())
        program.undo(mark);
    }
  }
  program.isFeasible();
}

/// With whole factors that have no divisor in common; over the terms of the loop.
TermId RankingSynthesis::ranking(const Program &program, std::size_t component) {
  const Program::Form &form = program.rankingOf(component);
  smt::LinearSum sum{program.value(form.constant), {}};
  Number denominators(1);
  Number divisor(0);
  for (const auto &[atom, unknown] : form.atoms)
    if (const Number value = program.value(unknown); !value.isZero()) {
      sum.terms.emplace_back(atom, value);
      denominators = smt::lcm(denominators, value.denominator());
    }
  for (const auto &[atom, factor] : sum.terms)
    divisor = smt::gcd(divisor, factor * denominators);
  const Number scale = divisor.isZero() ? Number(1) : denominators / divisor;
  std::vector<TermId> parts{store_.number(sum.constant * scale)};
  for (const auto &[atom, factor] : sum.terms)
    parts.push_back(store_.scale(factor * scale, atom));
  TermId term = store_.add(parts);
  for (auto known = applications_.rbegin(); known != applications_.rend(); ++known)
    term = smt::substitute(store_, term, {{known->first, known->second}});
  return term;
}

} // namespace feedhold::prove
