// One walk over the tree for all rules: who wants to see what is sorted out before, so that a block that no rule asks
// for costs a few comparisons.
#include "findings/rule/run_rules.h"

#include "findings/rule/dead_blocks.h"
#include "findings/rule/placeholders.h"
#include "inference/absint/contract_entry.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <utility>

namespace feedhold {

namespace {

constexpr std::size_t kIssueKinds = 0
#define ISSUE(kind) +1
#include "language/syntax/issues.def"
    ;

constexpr std::size_t kContractIssueKinds = 0
#define CONTRACT_ISSUE(kind) +1
#include "language/contract/issues.def"
    ;

constexpr std::size_t kExpressionKinds = std::variant_size_v<decltype(Expression::node)>;

template <typename Hook> struct Listener {
  Hook hook;
  Reporter reporter;
};
template <typename Hook> using Listeners = std::vector<Listener<Hook>>;

constexpr std::size_t kFlowRuns = 2;
struct FlowListeners {
  Listeners<decltype(RuleHooks::flow)> flow;
  Listeners<decltype(RuleHooks::watch)> watch;
  bool empty() const { return flow.empty() && watch.empty(); }
};

struct HookLists {
  std::array<Listeners<decltype(RuleHooks::issue)>, kIssueKinds> issues;
  std::array<Listeners<decltype(RuleHooks::contract)>, kContractIssueKinds> contractIssues;
  std::array<Listeners<decltype(RuleHooks::word)>, 128> words; // by address
  Listeners<decltype(RuleHooks::file)> file;
  Listeners<decltype(RuleHooks::program)> program;
  Listeners<decltype(RuleHooks::block)> block;
  Listeners<decltype(RuleHooks::statement)> statement;
  std::array<Listeners<decltype(RuleHooks::expression)>, kExpressionKinds> expressions; // by alternative of the node
  Listeners<decltype(RuleHooks::jump)> jump;
  Listeners<decltype(RuleHooks::call)> call;
  Listeners<decltype(RuleHooks::variable)> variable;
  Listeners<decltype(RuleHooks::comment)> comment;
  std::array<FlowListeners, kFlowRuns> flow; // by FlowRuns
};

std::size_t slotOf(char address) { return static_cast<std::size_t>(address & 0x7f); }

template <typename Hook> void addIfAsked(Listeners<Hook> &list, Hook hook, const Reporter &reporter) {
  if (hook != nullptr)
    list.push_back({hook, reporter});
}

/// `sinks` has one place for each rule.
HookLists gather(std::span<const Rule *const> rules, std::span<RuleFindings> sinks) {
  HookLists lists;
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const Rule *rule = rules[i];
    const Reporter reporter(rule->info, sinks[i]);
    const RuleHooks &hooks = rule->hooks;
    for (const SyntaxIssueKind kind : hooks.issueKinds)
      addIfAsked(lists.issues[static_cast<std::size_t>(kind)], hooks.issue, reporter);
    for (const ContractIssueKind kind : hooks.contractKinds)
      addIfAsked(lists.contractIssues[static_cast<std::size_t>(kind)], hooks.contract, reporter);
    for (const char address : hooks.wordAddresses)
      addIfAsked(lists.words[slotOf(address)], hooks.word, reporter);
    addIfAsked(lists.file, hooks.file, reporter);
    addIfAsked(lists.program, hooks.program, reporter);
    addIfAsked(lists.block, hooks.block, reporter);
    addIfAsked(lists.statement, hooks.statement, reporter);
    for (std::size_t kind = 0; kind < kExpressionKinds; ++kind)
      if ((hooks.expressionNodes >> kind & 1) != 0)
        addIfAsked(lists.expressions[kind], hooks.expression, reporter);
    addIfAsked(lists.jump, hooks.jump, reporter);
    addIfAsked(lists.call, hooks.call, reporter);
    addIfAsked(lists.variable, hooks.variable, reporter);
    addIfAsked(lists.comment, hooks.comment, reporter);
    FlowListeners &flow = lists.flow[static_cast<std::size_t>(hooks.flowRuns)];
    addIfAsked(flow.flow, hooks.flow, reporter);
    addIfAsked(flow.watch, hooks.watch, reporter);
  }
  return lists;
}

template <typename Hook, typename... Arguments>
void tell(const Listeners<Hook> &listeners, const FileContext &context, const Arguments &...arguments) {
  for (const Listener<Hook> &listener : listeners)
    listener.hook(arguments..., context, listener.reporter);
}

/// The walk over the blocks.  Expressions carry no block of their own: they are stored in the order of the text, so a
/// second cursor follows the blocks.
class Walk {
public:
  Walk(const HookLists &lists, const FileContext &context) : lists_(lists), context_(context), tree_(context.tree) {}

  void run() {
    const std::size_t count = tree_.blockCount();
    for (std::size_t i = 0; i < count; ++i)
      visit(BlockId(i));
  }

private:
  void visit(BlockId id) {
    const Block &block = tree_.blocks[id];
    const Block &next = tree_.blocks[id.next()];
    if (block.firstComment != next.firstComment && !lists_.comment.empty())
      for (const Comment &comment : tree_.comments.slice(block.firstComment, next.firstComment))
        tell(lists_.comment, context_, comment, id);
    const bool isRead = (block.flags & (Block::kLeader | Block::kAfterEnd)) == 0;
    if (isRead) {
      tell(lists_.block, context_, id);
      visitWords(id, block, next);
      if (block.firstStatement != next.firstStatement && !lists_.statement.empty())
        for (const Statement &statement : tree_.statements.slice(block.firstStatement, next.firstStatement))
          tell(lists_.statement, context_, statement, id);
    }
    visitExpressions(id, block, isRead);
  }

  void visitWords(BlockId id, const Block &block, const Block &next) {
    for (const Word &word : tree_.words.slice(block.firstWord, next.firstWord))
      tell(lists_.words[slotOf(word.address())], context_, word, id);
  }

  void visitExpressions(BlockId id, const Block &block, bool isRead) {
    for (; expression_ < tree_.expressions.size(); ++expression_) {
      const ExpressionId expression(expression_);
      if (tree_.expressions[expression].span.begin > block.end)
        return;
      if (isRead)
        tell(lists_.expressions[tree_.expressions[expression].node.index()], context_, expression, id);
    }
  }

  const HookLists &lists_;
  const FileContext &context_;
  const SyntaxTree &tree_;
  std::size_t expression_ = 0;
};

void visitModel(const HookLists &lists, const FileContext &context) {
  const ProgramModel &model = context.model;
  for (std::size_t i = 0; i < model.programs.size(); ++i)
    tell(lists.program, context, ProgramId(i));
  for (std::size_t i = 0; i < model.calls.size(); ++i)
    tell(lists.call, context, CallId(i));
  for (const Jump &jump : model.jumps)
    tell(lists.jump, context, jump);
  if (!lists.variable.empty())
    for (const VariableUse &use : model.variables)
      tell(lists.variable, context, use);
}

/// A comment that is not closed hides what follows, which may be what makes blocks dead.
void visitIssues(const HookLists &lists, const FileContext &context) {
  NeverExecuted never(context);
  for (const SyntaxIssue &issue : context.tree.issues)
    if (issue.kind == SyntaxIssueKind::UnclosedComment || !never.contains(context.tree.blockAt(issue.span.begin)))
      tell(lists.issues[static_cast<std::size_t>(issue.kind)], context, issue);
}

/// The clauses of one text: the program or a file beside it.
void visitContracts(const HookLists &lists, const FileContext &context) {
  if (context.file.index() >= context.contracts.size())
    return;
  for (const ContractIssue &issue : context.contracts[context.file.index()]->issues)
    if (issue.source == context.contractSource)
      tell(lists.contractIssues[static_cast<std::size_t>(issue.kind)], context, issue);
}

/// One analysis of a program, with the contracts of its file or with nothing known; the rules of all lists look on.
void visitRuns(ProgramId program, std::span<const FlowListeners *const> lists, const FileContracts *contracts,
               const FileContext &context) {
  std::vector<std::pair<std::unique_ptr<FlowRule>, const Reporter *>> watching;
  std::vector<FlowWatch *> watches;
  for (const FlowListeners *list : lists)
    for (const auto &listener : list->watch) {
      watching.emplace_back(listener.hook(program, context), &listener.reporter);
      watches.push_back(watching.back().first.get());
    }
  const FlowFacts facts = collectFacts(*context.programs, context.file, program, watches, contracts);
  if (!facts.isComplete())
    return;
  for (const FlowListeners *list : lists)
    tell(list->flow, context, facts);
  for (const auto &[rule, reporter] : watching)
    rule->report(facts, context, *reporter);
}

/// One analysis for each program; two where its contract speaks of its entry.
void visitFlow(const HookLists &lists, FileContext context) {
  const FlowListeners &allowed = lists.flow[static_cast<std::size_t>(FlowRuns::Allowed)];
  const FlowListeners &all = lists.flow[static_cast<std::size_t>(FlowRuns::All)];
  if (context.programs == nullptr || (allowed.empty() && all.empty()))
    return;
  context.modes = std::make_shared<const ModalTable>(context.dialect);
  for (ProgramId program(0); program.index() < context.model.programs.size(); program = program.next()) {
    const Contract *contract = context.contractOf({context.file, program});
    if (!contract || !speaksOfEntry(*contract)) {
      visitRuns(program, std::array{&allowed, &all}, nullptr, context);
      continue;
    }
    visitRuns(program, std::array{&allowed}, context.contracts[context.file.index()], context);
    if (!all.empty())
      visitRuns(program, std::array{&all}, nullptr, context);
  }
}

} // namespace

bool comesBefore(const RawFinding &a, const RawFinding &b) {
  if (a.diagnostic.span != b.diagnostic.span)
    return a.diagnostic.span < b.diagnostic.span;
  return a.rule->name < b.rule->name;
}

namespace {

/// All findings in their order; a rule that found more than is kept says so at the last one.
std::vector<RawFinding> joined(std::vector<RuleFindings> sinks) {
  std::vector<RawFinding> found;
  for (RuleFindings &sink : sinks) {
    std::stable_sort(sink.kept.begin(), sink.kept.end(), comesBefore);
    if (sink.dropped > 0)
      sink.kept.back().diagnostic.notes.push_back("the rule has " + std::to_string(sink.dropped) +
                                                  " more findings in this file, which are not listed");
    std::move(sink.kept.begin(), sink.kept.end(), std::back_inserter(found));
  }
  std::stable_sort(found.begin(), found.end(), comesBefore);
  return found;
}

} // namespace

namespace {

constexpr std::string_view kPlaceholderRule = "placeholder";

/// A text with placeholders is no program: only that it is none is said of it.
std::vector<const Rule *> rulesFor(const FileContext &context, std::span<const Rule *const> rules) {
  std::vector<const Rule *> chosen(rules.begin(), rules.end());
  if (placeholderIn(context))
    std::erase_if(chosen, [](const Rule *rule) { return rule->info.name != kPlaceholderRule; });
  return chosen;
}

} // namespace

std::vector<RawFinding> runRules(std::span<const Rule *const> all, const FileContext &context) {
  const std::vector<const Rule *> rules = rulesFor(context, all);
  std::vector<RuleFindings> sinks(rules.size());
  const HookLists lists = gather(rules, sinks);
  visitIssues(lists, context);
  visitContracts(lists, context);
  tell(lists.file, context);
  Walk(lists, context).run();
  visitModel(lists, context);
  visitFlow(lists, context);
  return joined(std::move(sinks));
}

std::vector<RawFinding> runContractRules(std::span<const Rule *const> rules, const FileContext &context) {
  std::vector<RuleFindings> sinks(rules.size());
  visitContracts(gather(rules, sinks), context);
  return joined(std::move(sinks));
}

} // namespace feedhold
