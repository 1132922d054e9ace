// Guard search: which conditions to try next, by what runs on many inputs have shown.
#pragma once

#include "proof/guards/guard_atoms.h"

#include <optional>
#include <set>
#include <vector>

namespace feedhold::prove {

/// Indices of atoms, ascending; all of them together.
using Conjunction = std::vector<std::size_t>;

enum class SampleKind : std::uint8_t {
  Breaks, // the claim
  Ends,   // as the program should
  Other,  // for instance with another alarm
};

class GuardSearch {
public:
  explicit GuardSearch(std::vector<GuardAtom> atoms) : atoms_(std::move(atoms)) {}

  const std::vector<GuardAtom> &atoms() const { return atoms_; }
  std::vector<GuardAtom> atomsOf(const Conjunction &conjunction) const;
  /// `holds`: by atom.
  void add(SampleKind kind, std::vector<bool> holds);
  /// Of many runs not one ended as it should.
  bool neverEnds() const;
  /// Few atoms before many, likely ones before others; those that let nothing run and those that let a run break the
  /// claim are left out.  Each once.
  std::optional<Conjunction> next();
  /// Weaker ones that may do as well as this one: fewer atoms, a bound that is allowed itself, more runs; the weakest
  /// first.
  std::vector<Conjunction> weaker(const Conjunction &proved) const;
  void tried(const Conjunction &conjunction) { tried_.insert(conjunction); }

private:
  struct Sample {
    SampleKind kind;
    std::vector<bool> holds;
    bool satisfies(const Conjunction &conjunction) const;
  };
  std::size_t kept(const Conjunction &conjunction) const;
  bool fits(const Conjunction &conjunction) const;
  std::vector<Conjunction> ones() const;
  std::optional<Conjunction> pair() const;
  std::optional<Conjunction> cover() const;

  std::vector<GuardAtom> atoms_;
  std::vector<Sample> samples_;
  std::set<Conjunction> tried_;
};

} // namespace feedhold::prove
