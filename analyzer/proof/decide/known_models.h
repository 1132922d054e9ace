// KnownModels: counterexamples of earlier questions.  Most questions of one place have one: an invariant that is only
// guessed, a branch that may be taken.  A value of each variable that makes all assumptions true and the goal false
// answers the next question, too, and to try it costs little beside a search (Cadar, Dunbar, Engler, "KLEE", 2008).
#pragma once

#include "proof/decide/discharge.h"
#include "proof/smt/model.h"

#include <list>

namespace feedhold::prove {

class KnownModels {
public:
  explicit KnownModels(const smt::TermStore &store) : store_(store) {}

  /// One of them makes all assumptions true and the goal false: it does not follow.
  bool refute(const Query &query);
  /// A counterexample of a question; variables that it does not name are 0.
  void add(const smt::Model &model);

private:
  struct Known {
    Known(const smt::TermStore &store, const smt::Model &found)
        : model(found), values(store, model, smt::OtherVariables::Zero) {}
    Known(const Known &) = delete;

    smt::Model model;
    smt::Evaluation values;
  };

  const smt::TermStore &store_;
  std::list<Known> models_; // the one that refuted last first
};

} // namespace feedhold::prove
