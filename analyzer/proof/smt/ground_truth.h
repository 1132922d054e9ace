// GroundTruth: what a condition or a number without variables is, by enclosing numbers.
#pragma once

#include "inference/domain/interval.h"
#include "proof/smt/term.h"

#include <optional>
#include <unordered_map>

namespace feedhold::smt {

/// Of the terms of one store.  Bounds are rounded outwards (inference/domain/interval.h), so that an answer is right
/// for the exact numbers; there is none where a bound is too near, or where something may not be defined.
class GroundTruth {
public:
  explicit GroundTruth(const TermStore &store) : store_(store) {}

  std::optional<bool> of(TermId condition) { return truth(condition, 0); }
  std::optional<Interval> ofNumber(TermId number) { return enclose(number, 0); }

private:
  std::optional<bool> truth(TermId condition, int depth);
  std::optional<bool> comparison(const Term &term, int depth);
  std::optional<Interval> enclose(TermId term, int depth);
  std::optional<Interval> found(const Term &term, int depth);
  std::optional<Interval> ofFunction(const Term &term, int depth);

  const TermStore &store_;
  std::unordered_map<std::uint32_t, std::optional<Interval>> known_; // of numbers, by term
};

} // namespace feedhold::smt
