// Entailment on a path: a question to discharge, with what has to do with it.
#pragma once

#include "proof/prove/discharge.h"

#include <span>

namespace feedhold::prove {

/// The facts and conditions that speak of a variable of the goal, or of one that such a condition speaks of, and so on.
/// Leaving others out loses proofs and never makes one.
Query relevantQuery(const smt::TermStore &store, std::span<const smt::TermId> facts,
                    std::span<const smt::TermId> conditions, smt::TermId goal);

bool entails(smt::TermStore &store, std::span<const smt::TermId> facts, std::span<const smt::TermId> conditions,
             smt::TermId goal, const Budget &budget);

} // namespace feedhold::prove
