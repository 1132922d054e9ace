// Plain values: what terms are about, in doubles.
//
// For guesses: what is not so here is hardly worth a search for a proof.  Nothing is proved or refuted by it.
#pragma once

#include "proof/smt/model.h"

namespace feedhold::smt {

class PlainValues {
public:
  /// Of the variables that the model names.
  PlainValues(const TermStore &store, const Model &model);

  /// Of a variable that has none.
  void set(TermId variable, TermId value) { known_.insert_or_assign(variable.index(), of(value)); }
  /// Of a condition: it clearly is so, or clearly is not.
  bool is(TermId condition, bool truth) {
    const Plain value = of(condition);
    return value && (*value != 0) == truth;
  }

private:
  /// Of a condition 1 or 0; absent: not known, or a little more or less would change it.
  using Plain = std::optional<double>;

  Plain of(TermId whole);
  Plain found(const Term &term) const;
  Plain junction(const Term &term) const;
  Plain ofNumbers(const Term &term) const;
  Plain known(TermId term) const { return known_.at(term.index()); }

  const TermStore &store_;
  std::map<std::string, double, std::less<>> named_;
  std::unordered_map<std::uint32_t, Plain> known_; // by term
};

} // namespace feedhold::smt
