// unused-variable: a main program sets `#5` and nothing reads it; `#5=0.(OFFSET)` at its head is a setting of a
// template.
#include "rules/flow/seen_locals.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::unused_variable {
namespace {

/// `#5=0.(OFFSET)`: a block of nothing but one assignment and its remark.
const Comment *remarkOfSetting(const ProgramFile &file, BlockId block) {
  const auto statements = file.tree->statementsOf(block);
  const auto remarks = file.tree->commentsOf(block);
  const auto words = file.tree->wordsOf(block);
  const bool isSetting = statements.size() == 1 && std::holds_alternative<Assignment>(statements.front().node) &&
                         std::ranges::all_of(words, [](const Word &word) { return word.address() == 'N'; });
  return isSetting && remarks.size() == 1 ? &remarks.front() : nullptr;
}

/// The blocks that every run executes first: up to the first jump, loop or call.
BlockId endOfHead(const FlowFacts &facts) {
  const ProgramModel &model = *facts.file.model;
  BlockId end = model.programs[facts.program].last;
  if (const auto jumps = model.jumpsOf(facts.program); !jumps.empty())
    end = std::min(end, jumps.front().block);
  if (const auto loops = model.loopsOf(facts.program); !loops.empty())
    end = std::min(end, loops.front().doBlock);
  if (const auto calls = model.callsOf(facts.program); !calls.empty())
    end = std::min(end, calls.front().block);
  return end;
}

struct Setting {
  std::uint32_t variable;
  const VariableUse *use;
  const Comment *remark;
};

/// What a person is meant to fill in: assigned once, at the head, with a remark.
std::vector<Setting> settingsOf(const FlowFacts &facts) {
  const auto uses = facts.file.model->variablesOf(facts.program);
  const BlockId end = endOfHead(facts);
  std::vector<Setting> settings;
  for (const VariableUse &use : uses) {
    if (!use.write || !use.number || use.block >= end)
      continue;
    const Comment *remark = remarkOfSetting(facts.file, use.block);
    const auto writes =
        std::ranges::count_if(uses, [&](const VariableUse &each) { return each.write && each.number == use.number; });
    if (remark && writes == 1)
      settings.push_back({*use.number, &use, remark});
  }
  return settings;
}

bool isReadIn(const FlowFacts &facts, std::uint32_t variable) {
  return std::ranges::any_of(facts.file.model->variablesOf(facts.program),
                             [&](const VariableUse &use) { return !use.write && use.number == variable; });
}

/// Something that is called, or a code of the machine builder, may read any common variable.
bool callsUnseen(const FlowFacts &facts, const FileContext &context) {
  const auto isUnseen = [&](const Call &call) {
    return call.kind != CallKind::ModalCancel &&
           (!context.callGraph.callee(context.file, call) || context.callGraph.reachesEncrypted(context.file, call));
  };
  const auto isUnknown = [&](const Word &word) {
    const auto tenths = word.isCode() ? word.tenths() : std::nullopt;
    return tenths && mayDoAnything(context.dialect, word.address(), *tenths);
  };
  return std::ranges::any_of(context.model.calls, isUnseen) ||
         std::ranges::any_of(blocksOf(facts.file, facts.program), [&](BlockId block) {
           return std::ranges::any_of(context.tree.wordsOf(block), isUnknown);
         });
}

/// A common variable that the control forgets when it is switched off, and that no program of the run can read.  One
/// program alone shows nothing: others of its folder may read it.
bool isUnreadCommon(const FlowFacts &facts, const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable < kFirstNamedVariable ? findVariable(context.dialect, variable) : nullptr;
  if (!range || range->kind != VariableKind::Common || facts.programs.size() < 2 || callsUnseen(facts, context))
    return false;
  return !facts.programs.unnumberedUses().hasIndirect && facts.programs.usesOf(variable).reads == 0;
}

void reportSetting(const Setting &setting, const FileContext &context, const Reporter &reporter) {
  const Span span = context.tree.expressions[setting.use->expression].span;
  reporter.report({.message = fmt::format("the setting {} {} is never read", context.quoted(span),
                                          context.quoted(setting.remark->span)),
                   .span = span,
                   .notes = {"other settings at the head of the program are read; a change of this one has no effect",
                             "use it where its remark says, or delete it here and in the template"}});
}

/// Where no other setting is read, the head belongs to something else.
std::vector<Setting> unreadSettings(const FlowFacts &facts, const FileContext &context, bool areSeen) {
  const std::vector<Setting> all = settingsOf(facts);
  std::vector<Setting> unread;
  for (const Setting &setting : all)
    if (!isReadIn(facts, setting.variable) &&
        (isLocal(facts.file, setting.variable) ? areSeen : isUnreadCommon(facts, context, setting.variable)))
      unread.push_back(setting);
  const bool othersAreRead =
      std::ranges::any_of(all, [&](const Setting &setting) { return isReadIn(facts, setting.variable); });
  return othersAreRead ? unread : std::vector<Setting>();
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!isMainProgram(facts))
    return;
  const bool areSeen = seesLocals(facts);
  std::vector<std::uint32_t> done;
  for (const Setting &setting : unreadSettings(facts, context, areSeen)) {
    reportSetting(setting, context, reporter);
    done.push_back(setting.variable);
  }
  if (!areSeen)
    return;
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    if (!use.write || !use.number || !isLocal(facts.file, *use.number) ||
        std::ranges::find(done, *use.number) != done.end())
      continue;
    done.push_back(*use.number);
    if (isReadIn(facts, *use.number))
      continue;
    const Span span = context.tree.expressions[use.expression].span;
    reporter.report({.message = fmt::format("{} is set but never used", context.quoted(span)),
                     .span = span,
                     .notes = {"the value has no effect; a word or a call may have the wrong variable number"}});
  }
}

} // namespace

extern const Rule unusedVariable;
const Rule unusedVariable{.info = {"unused-variable",
                                   Category::Flow,
                                   Severity::Warning,
                                   "Reports a variable that a main program sets but nothing uses.",
                                   {},
                                   CauseScope::OneFolder},
                          .hooks = {.flow = check}};

} // namespace feedhold::rules::unused_variable
