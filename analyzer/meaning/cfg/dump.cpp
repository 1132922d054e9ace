// dump: the graph as text, for golden cases.
#include "base/support/match.h"
#include "meaning/cfg/cfg.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

class Dumper {
public:
  Dumper(const Cfg &cfg, const SyntaxTree &tree, const SourceFile &source, const ProgramModel &model)
      : cfg_(cfg), tree_(tree), source_(source), model_(model) {}

  std::string run() {
    std::size_t program = 0;
    for (std::size_t i = 0; i < cfg_.nodes.size(); ++i) {
      if (program < cfg_.entries.size() && cfg_.entries[program] == NodeId(i))
        head(ProgramId(program++));
      node(NodeId(i));
    }
    return std::move(out_);
  }

private:
  void head(ProgramId program) {
    const std::string name = toString(model_.programs[program].name);
    out_ += fmt::format("program {}\n", name.empty() ? "without a name" : name);
  }

  void node(NodeId id) {
    const Node &node = cfg_.nodes[id];
    const std::uint32_t line = source_.lineOf(tree_.blocks[node.block].begin);
    out_ += fmt::format("  {} line {}: {}", id.index(), line, textOf(node.instruction));
    if (node.next != id && node.next != id.next())
      out_ += fmt::format(" -> {}", node.next.index());
    out_ += '\n';
  }

  std::string text(Span span) const { return source_.utf8(span); }
  std::string text(ExpressionId id) const { return text(tree_.expressions[id].span); }
  std::string text(const std::optional<ExpressionId> &id) const { return id ? text(*id) : "either"; }
  std::string alarm(AlarmKind kind) const {
    constexpr std::string_view kMeanings[] = {
#define ALARM(kind, meaning) meaning,
#include "language/dialect/alarms.def"
    };
    return std::string(kMeanings[static_cast<std::size_t>(kind)]);
  }

  std::string assigned(const Assign &assign) const {
    const Statement &first = tree_.statements[assign.first];
    const Statement &last = tree_.statements[StatementId(assign.first.index() + assign.count - 1)];
    return "assign " + text(cover(first.span, last.span));
  }

  std::string textOf(const Instruction &instruction) const {
    constexpr std::string_view kChoices[] = {"words", "words with skipped", "words under condition"};
    constexpr std::string_view kEnds[] = {"end M02", "end M30", "end of file"};
    return match(
        instruction, [](const Pass &) { return std::string("pass"); },
        [](const BlockSkip &skip) { return fmt::format("skip {} to {}", skip.level, skip.skipped.index()); },
        [&](const ExecuteWords &words) { return std::string(kChoices[static_cast<std::size_t>(words.which)]); },
        [&](const Assign &assign) { return assigned(assign); },
        [&](const Test &test) { return fmt::format("test {} to {}", text(test.condition), test.taken.index()); },
        [&](const JumpTo &jump) { return "jump to " + text(jump.target); },
        [](const EnterLoop &loop) { return fmt::format("enter loop {}", loop.number); },
        [](const JumpIntoLoop &loop) { return fmt::format("jump into loop {}", loop.number); },
        [](const RequireLoop &loop) { return fmt::format("require loop {}", loop.number); },
        [&](const StartCount &count) {
          return fmt::format("count {} from {}", count.counter.index(), text(count.times));
        },
        [](const CountDown &count) {
          return fmt::format("count {} down to {}", count.counter.index(), count.taken.index());
        },
        [&](const CallProgram &call) { return "call " + text(model_.calls[call.call].span); },
        [&](const ReturnFromProgram &back) {
          return "return" + (back.target ? " to " + text(tree_.words[*back.target].span()) : "") +
                 (back.value ? " " + text(*back.value) : "");
        },
        [&](const PassedReturn &passed) { return "passed return" + (passed.value ? " " + text(*passed.value) : ""); },
        [&](const EndProgram &end) { return std::string(kEnds[static_cast<std::size_t>(end.end)]); },
        [&](const StopWithAlarm &stop) { return "alarm " + alarm(stop.alarm); },
        [](const Havoc &havoc) { return fmt::format("havoc {}", havoc.reason); },
        [](const HavocVariables &havoc) { return fmt::format("havoc variables {}", havoc.reason); });
  }

  const Cfg &cfg_;
  const SyntaxTree &tree_;
  const SourceFile &source_;
  const ProgramModel &model_;
  std::string out_;
};

} // namespace

std::string dump(const Cfg &cfg, const SyntaxTree &tree, const SourceFile &source, const ProgramModel &model) {
  return Dumper(cfg, tree, source, model).run();
}

} // namespace feedhold
