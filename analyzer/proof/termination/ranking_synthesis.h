// Ranking synthesis: linear ranking functions of a loop, found by linear programming.
//
// What an iteration takes for granted is read as linear constraints over its numbers; products, and what is known of a
// function by its facts alone, count as numbers of their own.  By Farkas' lemma a linear ranking function falls in an
// iteration, and is bounded there, exactly when multipliers of these constraints say so, and the coefficients of the
// ranking function and the multipliers are one linear program (Podelski, Rybalchenko, "A complete method for the
// synthesis of linear ranking functions", 2004).  A ranking function that is found is a guess: whoever asked has to
// prove of it what it is meant for.
#pragma once

#include "proof/explore/exploration.h"

#include "proof/decide/entails.h"
#include <map>
#include <optional>

#include <span>
#include <vector>

namespace feedhold::prove {

class RankingSynthesis {
public:
  /// `facts`: the index of those of the interpretation.  `more`: holds before each of the iterations, and behind it.
  RankingSynthesis(const SymbolicInterpretation &interpretation, const FactIndex &facts, smt::TermStore &store,
                   const LoopInstance &loop, std::span<const std::size_t> iterations,
                   std::span<const smt::TermId> more);

  /// Lowered by the iteration, before which it is not negative; raised by none; lowered by as many others as can be.
  std::optional<smt::TermId> loweredBy(std::size_t iteration);
  /// Ranking functions of which every iteration lowers the first, and each other as soon as the one before it is
  /// negative; before no iteration is the last of them negative (Leike, Heizmann, "Ranking templates for linear loops",
  /// 2015: nested).
  std::optional<std::vector<smt::TermId>> nested(std::size_t depth);
  /// Lowered by every iteration, without a bound.
  std::optional<smt::TermId> decreasing();

  std::uint64_t work() const { return work_; }

private:
  using Atom = smt::TermId;
  /// constant + sum of factor * atom; >= 0, or = 0.
  struct Row {
    std::map<Atom, smt::Number> factors;
    smt::Number constant;
    bool isEquality = false;
  };
  /// One path through an iteration, without choices.
  struct Case {
    std::size_t iteration;
    std::vector<Row> rows;
    std::map<Atom, Row> next; // from a variable of the loop to its value behind the iteration
  };
  struct Draft;
  class Program;

  void nameConstants(std::vector<smt::TermId> &formulas);
  void addCases(std::size_t iteration, std::vector<smt::TermId> formulas, std::vector<smt::TermId> next);
  bool split(const Draft &draft, std::vector<Draft> &parts);
  bool splitFormula(const Draft &draft, std::vector<Draft> &parts, smt::TermKind kind);
  Case caseOf(std::size_t iteration, const Draft &draft);
  void addProducts(Case &path);
  Row times(const Row &left, const Row &right) const;
  Row expanded(smt::TermId term) const;
  std::optional<Row> rowOf(smt::TermId literal) const;
  bool isPossible(const Case &path);
  bool isSteady(Atom atom);
  smt::TermId ranking(const Program &program, std::size_t component);
  void makePlain(Program &program, std::size_t components);

  const SymbolicInterpretation &interpretation_;
  smt::TermStore &store_;
  const LoopInstance &loop_;
  std::vector<std::size_t> iterations_;
  std::vector<Atom> variables_;              // numbers that iterations change
  std::map<Atom, smt::TermId> applications_; // that count as numbers
  std::map<smt::TermId, bool> steady_;       // isSteady(), where it was asked
  std::vector<Case> cases_;
  std::vector<Atom> products_; // of variables
  std::vector<Atom> atoms_;    // that a ranking function may speak of
  std::uint64_t work_ = 0;
};

} // namespace feedhold::prove
