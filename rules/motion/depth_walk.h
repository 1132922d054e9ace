// DepthWalk: what rules have in common that follow the depth of a mill's tool through blocks which stand one behind the
// other.
#pragma once

#include "rules/motion/motion_view.h"

namespace feedhold::rules {

/// A movement of a block at rapid or at feed, in absolute coordinates.
struct DepthMove {
  NodeId node;
  const Word *level; // its Z, a number; null: it has none
  bool feeds;        // else it is rapid
  bool isAlone;      // no other axis moves
};

class DepthWalk : public FlowRule {
public:
  DepthWalk(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(context.dialect.machine == MachineKind::Milling) {}

  void after(NodeId node, const AbstractState &state) final;

protected:
  /// What comes next is not known to follow what came before.
  virtual void forget() = 0;
  virtual void follow(const DepthMove &move) = 0;
  /// A Z behind the block is not comparable with one before.
  virtual bool changesDepths(NodeId node) const = 0;
  /// Whether the block takes the tool away; then its movement is not followed.
  virtual bool takesAway(NodeId) { return false; }

  const MotionView &view() const { return view_; }
  bool stands(NodeId node) const { return asked_ && node == next_; } // behind the last one

private:
  MotionView view_;
  bool asked_;
  NodeId next_{0};
};

} // namespace feedhold::rules
