// dump: the model as text, for golden cases.
#include "base/support/text.h"
#include "language/model/model.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

class Dumper {
public:
  Dumper(const ProgramModel &model, const SyntaxTree &tree, const SourceFile &source)
      : model_(model), tree_(tree), source_(source) {}

  std::string run() {
    for (std::size_t i = 0; i < model_.programs.size(); ++i)
      program(ProgramId(i));
    return std::move(out_);
  }

private:
  void line(std::string_view text) { out_.append("  ").append(text).append("\n"); }
  std::uint32_t at(BlockId block) const { return source_.lineOf(tree_.blocks[block].begin); }
  std::string text(Span span) const { return source_.utf8(span); }
  static std::string number(const std::optional<std::uint32_t> &value) {
    return value ? std::to_string(*value) : std::string("?");
  }

  void program(ProgramId id) {
    const Program &program = model_.programs[id];
    const std::string name = toString(program.name);
    out_ += fmt::format("program {} from line {}", name.empty() ? "without a name" : name, at(program.first));
    if (program.within)
      out_ += fmt::format(" to line {}", at(BlockId(program.last.index() - 1)));
    if (!program.folder.empty())
      out_ += fmt::format(" in {}", program.folder);
    if (program.isEncrypted)
      out_ += ", encrypted";
    out_ += '\n';
    for (const SequenceNumber &each : model_.sequenceNumbers)
      if (model_.programOf(each.block) == id)
        line(fmt::format("N{} line {}", each.number, at(each.block)));
    for (const Jump &each : model_.jumps)
      if (each.program == id)
        jump(each);
    for (const Loop &each : model_.loops)
      if (each.program == id)
        line(fmt::format("loop {} line {} to {}", number(each.number), at(each.doBlock),
                         each.endBlock ? fmt::format("line {}", at(*each.endBlock)) : "nowhere"));
    for (const LoneEnd &each : model_.loneEnds)
      if (each.program == id)
        line(fmt::format("end {} line {} without its do", number(each.number), at(each.block)));
    for (const Construct &each : model_.constructs)
      if (model_.oWords[each.parts.front()].program == id)
        construct(each);
    for (const OWordUse &each : model_.oWords)
      if (each.program == id)
        loneOrLeaving(each);
    for (const Call &each : model_.calls)
      if (each.caller == id)
        call(each);
    for (const VariableUse &each : model_.variables)
      if (model_.programOf(each.block) == id)
        line(fmt::format("{} {} line {}", each.write ? "write" : "read", text(tree_.expressions[each.expression].span),
                         at(each.block)));
  }

  std::string named(const OWordUse &use) const {
    const std::string label = use.label.empty() ? "o?" : toString({std::nullopt, use.label, true});
    return fmt::format("{} {}", label, toLower(spellingOf(use.kind)));
  }

  void construct(const Construct &construct) {
    std::string parts;
    for (const OWordId part : construct.parts)
      parts += fmt::format("{}{} line {}", parts.empty() ? "" : ", ", named(model_.oWords[part]),
                           at(model_.oWords[part].block));
    line(parts + (construct.closed ? "" : ", not closed"));
  }

  void loneOrLeaving(const OWordUse &use) {
    const bool leaves =
        use.kind == OWordKind::Break || use.kind == OWordKind::Continue || use.kind == OWordKind::Return;
    if (!use.construct && use.kind != OWordKind::Call)
      line(fmt::format("{} line {} without its partner", named(use), at(use.block)));
    else if (leaves)
      line(fmt::format("{} line {} of line {}", named(use), at(use.block),
                       at(model_.oWords[model_.constructs[*use.construct].parts.front()].block)));
  }

  void jump(const Jump &jump) {
    constexpr std::string_view kKinds[] = {"goto", "return-to", "local-call", "call-at", "contour-from", "contour-to"};
    line(fmt::format("{} {} line {} {}{}", kKinds[static_cast<std::size_t>(jump.kind)], text(jump.targetSpan),
                     at(jump.block),
                     jump.target     ? fmt::format("to line {}", at(*jump.target))
                     : jump.computed ? "computed"
                                     : "to nothing here",
                     jump.conditional ? " conditional" : ""));
  }

  void call(const Call &call) {
    constexpr std::string_view kKinds[] = {"macro-call", "modal-call",      "modal-call-each", "modal-cancel",
                                           "macro-a",    "subprogram-call", "local-call",      "external-call",
                                           "code-call",  "o-word-call"};
    constexpr std::string_view kRoles[] = {"", " overridden", " forbidden", " beyond-sets"};
    const std::string name = toString(call.callee);
    line(fmt::format("{} {} line {}{}", kKinds[static_cast<std::size_t>(call.kind)],
                     name.empty() ? "of no named program" : name, at(call.block),
                     call.repeats ? fmt::format(" repeats {}", *call.repeats) : ""));
    for (const Argument &argument : call.arguments)
      line(fmt::format("  {} -> {}{}", text(tree_.words[argument.word].span()),
                       argument.variable ? fmt::format("#{}", argument.variable) : "nothing",
                       kRoles[static_cast<std::size_t>(argument.role)]));
    for (std::size_t i = 0; i < call.values.size(); ++i)
      line(fmt::format("  {} -> #{}", text(tree_.expressions[call.values[i]].span), i + 1));
  }

  const ProgramModel &model_;
  const SyntaxTree &tree_;
  const SourceFile &source_;
  std::string out_;
};

} // namespace

std::string dump(const ProgramModel &model, const SyntaxTree &tree, const SourceFile &source) {
  return Dumper(model, tree, source).run();
}

} // namespace feedhold
