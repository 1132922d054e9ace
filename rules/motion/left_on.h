// What a program leaves in force when it ends: the common part of the rules about it.
#pragma once

#include "rules/motion/motion_view.h"

#include <string>

namespace feedhold::rules {

struct LeftOn {
  ModalKind kind;
  std::initializer_list<CodeAction> actions; // in force: left on
  std::optional<Severity> atProgramEnd;      // of M30; absent: only what is left to a caller counts
  std::string_view consequence;              // what happens on the machine
  std::string_view remedy;                   // "cancel it by G40 before the end"
  /// Of what is kept in no modal group: the word that puts it on, whether a node takes it away, whether it is on.
  struct Special {
    const Word *(*switchedBy)(const MotionView &, NodeId);
    bool (*putsRight)(const MotionView &, NodeId);
    bool (*isOn)(const AbstractState &);
  };
  std::optional<Special> special = std::nullopt;
  /// A remark about the end is a warning where programs of the folder cancel the mode: this one forgot to.
  bool followsHabit = false;
};

/// The word of the node that puts the mode on.
const Word *switchedBy(const LeftOn &mode, const MotionView &view, NodeId node);
/// The node puts the mode on, or right.
bool decides(const LeftOn &mode, const MotionView &view, NodeId node);

/// What is left to a caller is a warning where a caller in the run goes on moving with it up to its end, and else a
/// remark.  Where all callers stand in the same file, they know what they call: it is reported if they leave it on.
///
/// Reports each code that puts it on and from which an end can be reached with it still on; for each end the last such
/// code in the text.
void reportLeftOn(const LeftOn &mode, const FlowFacts &facts, const FileContext &context, const Reporter &reporter);

} // namespace feedhold::rules
