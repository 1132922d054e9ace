// mode-saved-too-late: `G91`, then `#3=#4003`, and `G#3` at the end; or `G#4003` there.
#include "rules/motion/saved_mode.h"

#include <fmt/format.h>

#include <set>

namespace feedhold::rules::mode_saved_too_late {
namespace {

class ModeSavedTooLate final : public FlowRule {
public:
  ModeSavedTooLate(ProgramId program, const FileContext &context)
      : view_(program, context), savings_(startedBy(context, program) == StartedBy::Caller ? savingsOf(program, context)
                                                                                           : std::vector<Saving>()) {}

  void before(NodeId node, const AbstractState &state) override {
    for (std::size_t i = 0; i < savings_.size(); ++i)
      if (view_.node(node).block == savings_[i].block &&
          (isHavocked(state) || state.codes[savings_[i].group].mayBeAtEntry()))
        inTime_.insert(i);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (std::size_t i = 0; i < savings_.size(); ++i) {
      const auto saving = reachedNode(facts, savings_[i].block);
      if (!saving || inTime_.contains(i))
        continue;
      const auto change = changeBefore(*saving, savings_[i].group, facts);
      if (change && isOnlySaving(savings_[i]))
        tell(savings_[i], *saving, *change, facts, context, reporter);
    }
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      if (const auto live = facts.isReached(node) ? liveMode(node) : std::nullopt)
        if (const auto change = changeBefore(node, live->second, facts))
          tellLive(*live->first, *change, context, reporter);
  }

private:
  /// The nearest code in the text that sets the mode and from which the saving is reached.
  std::optional<NodeId> changeBefore(NodeId saving, std::uint8_t group, const FlowFacts &facts) const {
    for (NodeId node = saving; node != facts.entry();) {
      node = NodeId(node.index() - 1);
      if (facts.isReached(node) && setsGroup(view_, node, group) &&
          findPath(facts, node, saving, [](NodeId) { return false; }))
        return node;
    }
    return std::nullopt;
  }
  /// `G#4003`, with the group.
  std::optional<std::pair<const Word *, std::uint8_t>> liveMode(NodeId node) const {
    const FileContext &context = view_.context();
    for (const Word *word : view_.wordsOf(node))
      if (word->address() == 'G' && word->form() == WordForm::Expression)
        if (const auto group = groupReadBy(word->expression(), context))
          return std::pair{word, *group};
    return std::nullopt;
  }
  void tellLive(const Word &word, NodeId change, const FileContext &context, const Reporter &reporter) const {
    reporter.report(
        {.message =
             fmt::format("{} programs the mode that is in force: it restores nothing", context.quoted(word.span())),
         .span = word.span(),
         .labels = {{view_.blockSpan(change), "set here"}},
         .notes = {"the variable is read when the block is executed, not at the head of the program",
                   "save the mode in a variable at the head of the program, before the first block that sets it"}});
  }
  /// A second saving restores a mode of the program itself.
  bool isOnlySaving(const Saving &saving) const {
    return std::ranges::count(savings_, saving.group, &Saving::group) == 1;
  }
  /// Behind the saving nothing changes the mode: what is restored is in force.
  bool hasNoEffect(const Saving &saving, NodeId from, const FlowFacts &facts) const {
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      if (facts.isReached(node) && restores(view_, node, saving.variable) &&
          findPath(facts, from, node, [&](NodeId other) {
            return setsGroup(view_, other, saving.group) ||
                   std::holds_alternative<CallProgram>(view_.node(other).instruction);
          }))
        return true;
    return false;
  }
  void tell(const Saving &saving, NodeId node, NodeId change, const FlowFacts &facts, const FileContext &context,
            const Reporter &reporter) const {
    reporter.report(
        {.message = fmt::format("{} does not save the mode of the caller: the program has already set its own",
                                context.quoted(saving.place)),
         .span = saving.place,
         .labels = {{view_.blockSpan(change), "set here"}},
         .flow = describePath(facts, *findPath(facts, change, node, [](NodeId) { return false; })),
         .notes = {fmt::format("`G#{}` restores the mode of this program; the caller continues in it", saving.variable),
                   "save the mode at the head of the program, before the first block that sets it"}},
        hasNoEffect(saving, node, facts) ? Severity::Warning : Severity::Info);
  }

  MotionView view_;
  std::vector<Saving> savings_;
  std::set<std::size_t> inTime_; // savings that may read the mode of the caller
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ModeSavedTooLate>(program, context);
}

} // namespace

extern const Rule modeSavedTooLate;
const Rule modeSavedTooLate{.info = {"mode-saved-too-late", Category::Motion, Severity::Warning,
                                     "Reports a called program that saves a mode of its caller after it has set the "
                                     "mode itself, or reads it only where it restores it."},
                            .hooks = {.watch = watch}};

} // namespace feedhold::rules::mode_saved_too_late
