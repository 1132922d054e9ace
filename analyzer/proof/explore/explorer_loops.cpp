// Loops on the paths of an exploration: opened where a path comes to their head, closed where it leaves them.
#include "proof/explore/explorer.h"
#include "proof/smt/steps.h"

namespace feedhold::prove {

/// A loop is left when the path leaves its program, or stands outside of its nodes.
bool Explorer::closeLeftLoops(Path &path, Trial *trial) {
  while (!path.loops.empty()) {
    const OpenLoop &loop = path.loops.back();
    if (path.frames.size() > loop.depth)
      return true;
    if (path.frames.size() == loop.depth) {
      const Wto &wto = wtoOf(path.frames.back().callee);
      const std::uint32_t at = wto.positionOf(path.at.node);
      if (wto.positionOf(loop.head) <= at && at < wto.endOf(loop.head))
        return true;
    }
    const bool isTried = trial && trial->instance == loop.instance;
    path.loops.pop_back();
    if (isTried) {
      trial->exits.push_back(std::move(path));
      return false;
    }
  }
  return true;
}

bool Explorer::arrive(Path &path, Purpose purpose, Trial *trial, Worklist &work) {
  if (path.atOpenedHead) {
    path.atOpenedHead = false;
    return true;
  }
  if (!closeLeftLoops(path, trial))
    return false;
  if (!wtoOf(path.frames.back().callee).isHead(path.at.node))
    return true;
  if (options_.loops == LoopTreatment::AnyIteration)
    loseCutter(path, "cutter compensation through the head of a loop");
  if (options_.loops == LoopTreatment::EachIteration)
    return !comesBack(path);
  const bool isOpen =
      !path.loops.empty() && path.loops.back().head == path.at.node && path.loops.back().depth == path.frames.size();
  if (isOpen) {
    if (trial && trial->instance == path.loops.back().instance)
      trial->iterations.push_back(std::move(path));
    else if (purpose == Purpose::Record)
      recordIteration(path);
    return false;
  }
  if (purpose == Purpose::Record)
    return LoopSummarizer(*this).open(path);
  for (Path &exit : LoopSummarizer(*this).tryAll(path))
    wait(work, std::move(exit));
  return false;
}

/// In the state of an earlier visit: whatever comes has been followed from there.
bool Explorer::comesBack(Path &path) {
  smt::spend(stepsOf(path));
  result_.heads.insert(path.at);
  if (path.cutter) // no part of the state
    return false;
  const auto &known = path.landmark;
  if (known && known->at == path.at && known->moved == path.moved && known->frames == path.frames &&
      known->state == path.state) {
    result_.repeats.push_back(path.at);
    return true;
  }
  if (!known || ++path.visits >= path.mostVisits) {
    path.landmark = std::make_shared<const Landmark>(Landmark{path.at, path.state, path.frames, path.moved});
    path.visits = 0;
    path.mostVisits *= 2;
  }
  return false;
}

void Explorer::recordIteration(const Path &path) {
  const std::size_t instance = path.loops.back().instance;
  if (!LoopSummarizer(*this).record(instance, path))
    giveUp("no loop invariant was found: what a loop leaves unchanged is unknown");
}

} // namespace feedhold::prove
