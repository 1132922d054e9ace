// call-ends-in-alarm: `G65P9100B2.`, and O9100 begins with `IF[#1EQ#0]GOTO90`.
#include "base/source/path_text.h"
#include "base/support/text.h"
#include "meaning/cfg/program_nodes.h"
#include "meaning/cfg/reached_programs.h"
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace feedhold::rules::call_ends_in_alarm {
namespace {

/// What a program can come to by its text, whatever its tests find, without an alarm of its own.
struct WaysThrough {
  bool return_ = false;
  bool endsRun = false;
  bool works = false; // an axis moves, or a variable is set that others see
};

bool worksAt(const ProgramFile &file, const Node &node) {
  if (std::holds_alternative<ExecuteWords>(node.instruction))
    return std::ranges::any_of(file.tree->wordsOf(node.block), [](const Word &word) {
      return std::string_view("XYZABCUVW").find(word.address()) != std::string_view::npos;
    });
  const auto uses = file.model->variablesIn(node.block, node.block.next());
  return std::ranges::any_of(
      uses, [&](const VariableUse &use) { return use.write && (!use.number || !isLocal(file, *use.number)); });
}

WaysThrough waysThrough(const ProgramFile &file, ProgramId program) {
  const NodeId entry = file.cfg.entryOf(program);
  std::set<NodeId> seen{entry};
  std::vector<NodeId> open{entry};
  WaysThrough found;
  while (!open.empty()) {
    const NodeId at = open.back();
    open.pop_back();
    const Node &node = file.cfg.nodes[at];
    const auto *end = std::get_if<EndProgram>(&node.instruction);
    if (end && end->end != ProgramEnd::EndOfFile)
      found.endsRun = true;
    if (end || std::holds_alternative<ReturnFromProgram>(node.instruction))
      found.return_ = true;
    if (ownAlarmAt(file, at))
      continue;
    found.works = found.works || worksAt(file, node);
    forEachSuccessor(file.cfg, *file.model, at, ProgramUse::Called, [&](NodeId next) {
      if (seen.insert(next).second)
        open.push_back(next);
    });
  }
  return found;
}

/// Some program that the call comes to may end the run.
bool mayEndRun(const ProgramSet &programs, ProgramRef callee) {
  ReachedPrograms reached;
  collectReached(programs, callee, reached);
  return std::ranges::any_of(reached.programs, [&](ProgramRef program) {
    return waysThrough(programs.file(program.file), program.program).endsRun;
  });
}

std::string nameOf(const ProgramFile &file, ProgramId program) {
  const ProgramName &name = file.model->programs[program].name;
  return name.empty() ? pathText(std::filesystem::path(file.source->path()).filename()) : toString(name);
}

/// The block that raises the alarm.
std::string textOf(const ProgramSet &programs, const AlarmInCall &alarm) {
  const ProgramFile &file = programs.file(alarm.raised.file);
  const BlockId block = file.cfg.nodes[alarm.raised.node].block;
  return std::string(trimmed(file.source->text(file.tree->blocks[block].span())));
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::set<NodeId> done;
  for (const AlarmInCall &alarm : facts.alarmsInCalls()) {
    const Node &node = facts.node(alarm.call);
    const auto *calling = std::get_if<CallProgram>(&node.instruction);
    // What comes back goes on in the next node.
    if (!calling || node.next == alarm.call || facts.isReached(node.next) || !done.insert(alarm.call).second)
      continue;
    const Call &call = context.model.calls[calling->call];
    const auto callee = context.callGraph.callee(context.file, call);
    if (!callee)
      continue;
    const ProgramFile &file = facts.programs.file(callee->file);
    const WaysThrough ways = waysThrough(file, callee->program);
    if (!ways.return_ || !ways.works || mayEndRun(facts.programs, *callee))
      continue;
    reporter.report({.message = fmt::format("{} stops with an alarm in this call: `{}`", nameOf(file, callee->program),
                                            textOf(facts.programs, alarm)),
                     .span = call.span,
                     .labels = {{alarm.place, "the alarm", alarm.raised.file}},
                     .flow = pathFromEntry(facts, alarm.call),
                     .notes = {"the call never comes back, whatever the values that are not known here",
                               "pass what the program checks for, in the range that it allows"}});
  }
}

} // namespace

extern const Rule callEndsInAlarm;
const Rule callEndsInAlarm{.info = {"call-ends-in-alarm", Category::Call, Severity::Warning,
                                    "Reports a call with which the called program always stops with an alarm."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules::call_ends_in_alarm
