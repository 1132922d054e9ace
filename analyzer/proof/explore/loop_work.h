// LoopSummarizer::Work: what is being found out about one loop.  For loops.cpp and loop_invariants.cpp alone.
#pragma once

#include "proof/explore/loops.h"

namespace feedhold::prove {

/// Of trials, until nothing new is found.
constexpr int kMostLoopRounds = 12;

/// The terms of the state, then whether an axis has moved.
std::vector<smt::TermId> termsOf(const SymbolicState &state, smt::TermId moved);

struct LoopSummarizer::Work {
  Path arrival;
  std::size_t instance;
  smt::TermId iterations;
  LoopShape shape = {};
  smt::TermId moved{0};
  std::vector<smt::TermId> facts = {};
  bool isTried = false;   // `found` and `left` are what these parts and facts allow
  std::size_t before = 0; // conditions of the last trial's start
  std::vector<Path> found = {};
  std::vector<Path> exits = {};                    // of the same trial
  std::vector<std::vector<smt::TermId>> left = {}; // by iteration: its parts

  std::vector<LoopPart> &parts() { return shape.parts; }
  const std::vector<LoopPart> &parts() const { return shape.parts; }
};

} // namespace feedhold::prove
