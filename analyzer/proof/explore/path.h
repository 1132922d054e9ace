// Path: one path through a program, as far as it has been explored: its place, its conditions, its state.
#pragma once

#include "meaning/semantics/frames.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <memory>
#include <optional>
#include <vector>

namespace feedhold::prove {

using SymbolicFrame = Frame<SymbolicInterpretation>;

/// A loop in which the path is: any of its iterations.
struct OpenLoop {
  NodeId head;
  std::size_t depth;    // how many frames there were at its head
  std::size_t instance; // Exploration::loops

  friend bool operator==(const OpenLoop &, const OpenLoop &) = default;
};

/// A state that the path has been in, to detect that it returns to it (Brent, "An improved Monte Carlo factorization
/// algorithm", 1980).
struct Landmark {
  Place at;
  SymbolicState state;
  std::vector<SymbolicFrame> frames;
  smt::TermId moved;
};

struct CutterTrack;

struct Path {
  Place at;
  SymbolicState state;
  std::vector<smt::TermId> conditions; // all hold on this path
  std::vector<SymbolicFrame> frames;
  std::vector<OpenLoop> loops; // the innermost last
  smt::TermId moved;           // an axis has moved since the start
  std::uint32_t steps = 0;
  std::shared_ptr<const CutterTrack> cutter = {}; // cutter compensation, where it is followed (path_cutter.h)
  // ---- with LoopTreatment::EachIteration ----
  std::shared_ptr<const Landmark> landmark = {};
  std::uint32_t visits = 0;     // to heads of loops, since the landmark
  std::uint32_t mostVisits = 1; // before a new landmark is taken
  bool atOpenedHead = false;    // the loop at whose head the path stands has just been opened

  /// False when the condition contradicts the path at first sight: the path ends.
  bool assume(const smt::TermStore &store, smt::TermId condition);
  /// By a look at the conditions.
  bool says(const smt::TermStore &store, smt::TermId condition) const;
  bool denies(const smt::TermStore &store, smt::TermId condition) const;
};

} // namespace feedhold::prove
