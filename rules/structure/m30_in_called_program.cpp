// m30-in-called-program: the whole job ends where M99 was meant.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

namespace feedhold::rules::m30_in_called_program {
namespace {

/// A call from another program that has more to do behind it; M97 and a program that calls itself are no proof that
/// this one is a subprogram.
std::optional<CallGraph::Caller> foreignCaller(const FileContext &context, ProgramId program) {
  for (const auto &caller : context.callGraph.callers({context.file, program})) {
    const Call &call = context.callGraph.model(caller.file).calls[caller.call];
    const bool isItself = caller.file == context.file && call.caller == program;
    if (!isItself && !call.isLast && call.kind != CallKind::Local)
      return caller;
  }
  return std::nullopt;
}

/// A program may be made to be started alone as well, but not one in the file of its caller that never returns.
void reportEnd(const Word &end, const Program &program, const CallGraph::Caller &caller, const FileContext &context,
               const Reporter &reporter) {
  const Call &call = context.callGraph.model(caller.file).calls[caller.call];
  const bool isPartOfJob = caller.file == context.file && !program.returns;
  reporter.report({.message = fmt::format("{} in a called program ends the whole job", context.quoted(end.span())),
                   .span = end.span(),
                   .labels = {{call.span, "called here", caller.file}},
                   .notes = {"the blocks after the call are never executed: retracts, restored modes, counters",
                             call.kind == CallKind::OWord
                                 ? "a subroutine returns at its `endsub`"
                                 : "return with M99; where the job must stop, raise an alarm with `#3000=`"}},
                  isPartOfJob ? Severity::Warning : Severity::Info);
}

/// The ends to which the ways from a block lead.
class LocalEnds {
public:
  LocalEnds(ProgramId program, const FileContext &context) : program_(program), context_(context) {}

  /// The M02 or M30 with which all of them end; null: one may return, or it cannot be told.
  const Word *from(BlockId start) {
    std::vector<BlockId> open{start};
    const Word *end = nullptr;
    while (!open.empty()) {
      const BlockId block = open.back();
      open.pop_back();
      if (!seen_.insert(block).second)
        continue;
      if (block >= context_.model.programs[program_].last || isUnclear(block))
        return nullptr;
      const Word *own = findCode(context_.tree, block, context_.dialect, CodeRole::ProgramEnd);
      end = end ? end : own;
      for (const Jump &jump : context_.model.jumpsIn(block, block.next()))
        open.push_back(*jump.target);
      if (!leavesForGood(context_, block))
        open.push_back(block.next());
    }
    return end;
  }

private:
  /// A return, a jump that is not followed, a block that could not be read.
  bool isUnclear(BlockId block) const {
    const auto jumps = context_.model.jumpsIn(block, block.next());
    return findCode(context_.tree, block, context_.dialect, CodeRole::Return) != nullptr ||
           context_.tree.blocks[block].has(Block::kBroken) ||
           std::ranges::any_of(jumps, [](const Jump &jump) { return !jump.target; });
  }

  ProgramId program_;
  const FileContext &context_;
  std::set<BlockId> seen_;
};

/// A block with content behind the call, which no jump reaches without it: the call is not the way to the end.
bool goesOnBehind(const Jump &jump, ProgramId program, const FileContext &context) {
  BlockId block = jump.block.next();
  while (block < context.model.programs[program].last && !hasContent(context, block))
    block = block.next();
  const bool isEnd = leavesForGood(context, block);
  return block < context.model.programs[program].last && !isEnd &&
         !context.model.jumpTargetsOf(program).contains(block);
}

/// `M97 P5` of a subprogram that ends with M30 in the place of M99.
void checkLocal(ProgramId id, const FileContext &context, const Reporter &reporter) {
  std::vector<const Word *> told;
  for (const Jump &jump : context.model.jumpsOf(id)) {
    if (jump.kind != JumpKind::LocalCall || !jump.target || jump.conditional || !goesOnBehind(jump, id, context))
      continue;
    const Word *end = LocalEnds(id, context).from(*jump.target);
    if (!end || std::ranges::find(told, end) != told.end())
      continue;
    told.push_back(end);
    const Call *call = nullptr;
    for (const Call &each : context.model.callsIn(jump.block, jump.block.next()))
      call = &each;
    const Span place = call ? call->span : jump.span;
    reporter.report(
        {.message = fmt::format("{} ends the program in a subprogram that never returns", context.quoted(end->span())),
         .span = end->span(),
         .labels = {{place, "called here"}},
         .notes = {"the blocks after the call are never executed", "return with M99"}},
        Severity::Warning);
  }
}

/// Whether all that stands before a block of a subroutine is run through from its head, and none of it returns.
bool isAlwaysReached(BlockId block, const Program &program, const FileContext &context) {
  const auto oWords = context.model.oWordsIn(program.first, block);
  return context.model.jumpsIn(program.first, block).empty() && !context.tree.blocks[block].has(Block::kSkip) &&
         std::ranges::none_of(oWords, [](const OWordUse &use) {
           return use.kind == OWordKind::Return || use.kind == OWordKind::Break || use.kind == OWordKind::Continue;
         });
}

/// `o100 sub`, .., `M2`, `o100 endsub`: whoever calls it is never gone on with.
void checkSubroutine(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  if (!program.name.isSubroutine || isStructureBroken(context, id))
    return;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const Word *end = isRead(context.tree.blocks[block])
                          ? findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd)
                          : nullptr;
    const auto isAround = [&](const Construct &construct) {
      return construct.kind != OWordKind::Sub && construct.parts.size() > 1 &&
             context.model.oWords[construct.parts.front()].block < block &&
             block < context.model.oWords[construct.parts.back()].block;
    };
    if (!end || std::ranges::any_of(context.model.constructs, isAround))
      continue;
    if (isAlwaysReached(block, program, context))
      reporter.report({.message = fmt::format("{} in a subroutine ends the whole job: it never comes to its `endsub`",
                                              context.quoted(end->span())),
                       .span = end->span(),
                       .labels = {{program.header, "the subroutine"}},
                       .notes = {"whoever calls it is not gone on with: retracts, restored modes, a tool change",
                                 "delete it, or write it behind `endsub`"}},
                      Severity::Warning);
    return;
  }
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  checkLocal(id, context, reporter);
  const auto caller = foreignCaller(context, id);
  if (!caller)
    return checkSubroutine(id, context, reporter);
  const Program &program = context.model.programs[id];
  const BranchBlocks branches(context.model);
  std::optional<DeadBlocks> dead;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const Word *end = isRead(context.tree.blocks[block])
                          ? findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd)
                          : nullptr;
    // Under an `if` of o-words it is the way to stop the job, as `#3000=` elsewhere.
    if (!end || branches.contains(block))
      continue;
    if (!dead)
      dead.emplace(context, id);
    if (!dead->contains(block))
      reportEnd(*end, program, *caller, context, reporter);
  }
}

} // namespace

extern const Rule m30InCalledProgram;
const Rule m30InCalledProgram{.info = {"m30-in-called-program", Category::Structure, Severity::Info,
                                       "Reports `M02` or `M30` in a program that another program calls."},
                              .hooks = {.program = check}};

} // namespace feedhold::rules::m30_in_called_program
