// See the header.
#include "rules/motion/number_left_out.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules {
namespace {

class NumberLeftOut final : public FlowRule {
public:
  NumberLeftOut(const OffsetCode &code, ProgramId program, const FileContext &context)
      : actions_(code.actions), letter_(code.letter), offset_(code.offset), view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!findCode(node) || isWritten(node))
      return;
    const bool never = !isHavocked(state) && isAsAtEntry(state, letter_);
    const auto [at, isNew] = places_.emplace(node, never);
    at->second = at->second && (isNew || never);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, never] : places_) {
      if (!never)
        continue;
      const Word *word = findCode(node);
      reporter.report({.message = fmt::format("{} has no `{}`, and no earlier block sets it",
                                              context.quoted(word->span()), letter_),
                       .span = word->span(),
                       .flow = pathFromEntry(facts, node),
                       .notes = {fmt::format("{} is whatever the previous program left active, or none", offset_),
                                 fmt::format("write {} in this block", letter_)}});
    }
  }

private:
  /// `G43 HO1`: what is wrong with its number, another rule says.
  bool isWritten(NodeId node) const {
    const Word *word = findWord(view_.context().tree, view_.node(node).block, letter_);
    return word && word->form() == WordForm::Missing;
  }
  const Word *findCode(NodeId node) const {
    for (const CodeAction action : actions_)
      if (const Word *word = view_.findAction(node, {action}))
        return word;
    return nullptr;
  }

  std::vector<CodeAction> actions_;
  char letter_;
  std::string_view offset_;
  MotionView view_;
  std::map<NodeId, bool> places_;
};

/// Sees nothing and says nothing.
class Silent final : public FlowRule {
public:
  void report(const FlowFacts &, const FileContext &, const Reporter &) override {}
};

} // namespace

std::unique_ptr<FlowRule> watchForMissingNumber(const OffsetCode &code, ProgramId program, const FileContext &context) {
  // Lathes keep the offset in T; a control with o-words takes that of the tool in the spindle.
  const bool takesWord = context.dialect.machine == MachineKind::Milling && !context.dialect.grammar.oWords;
  if (!takesWord || startedBy(context, program) == StartedBy::Caller)
    return std::make_unique<Silent>();
  return std::make_unique<NumberLeftOut>(code, program, context);
}

} // namespace feedhold::rules
