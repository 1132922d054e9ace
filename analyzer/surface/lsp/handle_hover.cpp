// What the symbol at a place is, and what is known of it there.
#include "base/source/path_text.h"
#include "base/support/match.h"
#include "base/support/text.h"
#include "language/model/block_facts.h"
#include "meaning/semantics/modal_table.h"
#include "surface/lsp/facts_at_cursor.h"
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_json.h"
#include "surface/lsp/feature_meaning.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

std::string modeName(const ModalTable &modes, std::uint8_t group) {
  for (std::size_t kind = 0; kind < kModalKinds; ++kind)
    if (modes.groupOf(static_cast<ModalKind>(kind)) == group)
      return std::string(nameOf(static_cast<ModalKind>(kind)));
  return fmt::format("group {}", group);
}

class Hover {
public:
  Hover(const View &view, const SymbolAt &at) : view_(view), programs_(*view.programs), file_(view.file()), at_(at) {}

  std::string write() {
    match(
        at_.symbol,
        [&](const HeaderSymbol &it) {
          program({kDocument, it.program});
        },
        [&](const LabelSymbol &it) { label(it.label); },
        [&](const JumpSymbol &it) { jump(file_.model.jumps[it.jump]); },
        [&](const CallSymbol &it) { call(file_.model.calls[it.call]); },
        [&](const ArgumentSymbol &it) { argument(file_.model.calls[it.call], it.argument); },
        [&](const VariableSymbol &it) { variable(it.use); },
        [&](const LoopSymbol &it) { loop(file_.model.loops[it.loop]); }, [](const OWordSymbol &) {},
        [&](const CodeSymbol &it) { code(file_.tree.words[it.word]); },
        [&](const WordSymbol &it) { word(file_.tree.words[it.word]); },
        [&](const ClauseSymbol &it) {
          const ClauseKind kind = file_.contracts.clauses[it.clause].kind;
          line("**{}** {}", feedhold::nameOf(kind), helpOf(kind));
        });
    return std::move(text_);
  }

private:
  template <typename... Parts> void line(fmt::format_string<Parts...> form, Parts &&...parts) {
    text_ += (text_.empty() ? "" : "\n\n") + fmt::format(form, std::forward<Parts>(parts)...);
  }

  // ---- programs ----

  void program(ProgramRef ref) {
    const ProjectFile &in = programs_.file(ref.file);
    const std::string title = titleOf(in, ref.program);
    line("**{}**{}", nameOf(programs_, ref), title.empty() ? "" : " " + plain(title));
    if (ref.file != kDocument)
      line("in `{}`", pathText(in.path.filename()));
    const View whole = withFolder(view_); // `ref` is in the document, or the folder is there already
    if (const auto callers = whole.programs->set->callGraph().callers(ref); !callers.empty())
      line("called from {} {} in the project", callers.size(), callers.size() == 1 ? "place" : "places");
    std::string clauses;
    for (const Clause &clause : in.contracts.clauses)
      if (clause.program == ref.program)
        clauses += clause.text + "\n";
    if (!clauses.empty())
      line("```\n{}```", clauses);
  }
  void call(const Call &call) {
    if (call.kind != CallKind::OWord && at_.span == file_.tree.words[call.code].span())
      code(file_.tree.words[call.code]);
    const bool goes =
        call.kind != CallKind::MacroA && call.kind != CallKind::ModalCancel && call.kind != CallKind::Local;
    if (!goes)
      return;
    if (const auto callee = programs_.set->callGraph().callee(kDocument, call))
      program(*callee);
    else if (programs_.set->callGraph().candidates(kDocument, call).size() > 1)
      line("the project contains several programs {}", toString(call.callee));
    else if (!call.callee.empty())
      line("no file of the project contains {}", toString(call.callee));
    else if (call.programWord)
      line("the program number is computed");
  }
  void argument(const Call &call, const Argument &argument) {
    const Word &passed = file_.tree.words[argument.word];
    if (argument.variable == 0)
      return line("**{}** passes nothing", passed.address());
    line("**{}** sets `#{}` of the called program{}", passed.address(), argument.variable,
         argument.role == ArgumentRole::Overridden ? "; a later word overrides it" : "");
    const auto callee = programs_.set->callGraph().callee(kDocument, call);
    if (!callee)
      return;
    if (const std::string meaning = meaningOf(programs_, *callee, argument.variable); !meaning.empty())
      line("{}: {}", nameOf(programs_, *callee), plain(meaning));
    if (const std::string clause = clauseOf(programs_, *callee, argument.variable); !clause.empty())
      line("`{}`", clause);
  }

  // ---- jumps and loops ----

  void label(const LabelRef &label) {
    const View whole = withFolder(view_);
    std::string lines;
    for (const Use &use : usesOf(*whole.programs, label))
      if (use.role == UseRole::Reference)
        lines += fmt::format("{}{}", lines.empty() ? "" : ", ", placeOf(*whole.programs, use));
    line("**N{}** of {}", label.number, nameOf(programs_, label.program));
    line("{}", lines.empty() ? "no jump to this block" : "target of the jump in " + lines);
  }
  static std::string placeOf(const Project &programs, const Use &use) {
    const ProjectFile &in = programs.file(use.file);
    const std::uint32_t at = in.source.lineOf(use.span.begin);
    return use.file == kDocument ? fmt::format("line {}", at) : fmt::format("{}:{}", pathText(in.path.filename()), at);
  }
  void jump(const Jump &jump) {
    const auto number = targetNumber(jump);
    if (!number)
      return line("the jump target is computed and may be any sequence number of the program");
    std::string lines;
    for (const LabelRef &label : labelsOf(programs_, kDocument, jump))
      for (const Use &use : usesOf(programs_, label))
        if (use.role == UseRole::Definition)
          lines += fmt::format("{}{} of {}", lines.empty() ? "" : ", ", placeOf(programs_, use),
                               nameOf(programs_, label.program));
    if (lines.empty())
      line("N{} does not exist", *number);
    else
      line("jumps to **N{}** in {}", *number, lines);
    if (jump.target && jump.kind != JumpKind::ReturnTo && jump.kind != JumpKind::CallAt)
      line("```\n{}\n```", file_.source.utf8(file_.tree.blocks[*jump.target].span()));
  }
  void loop(const Loop &loop) {
    if (!loop.endBlock)
      return line("this loop has no END");
    line("loop from line {} to line {}", lineOf(file_, loop.doBlock), lineOf(file_, *loop.endBlock));
  }

  // ---- values ----

  void variable(const VariableUse &use) {
    const auto ref = variableOf(programs_, kDocument, use);
    if (!ref)
      return line("the variable number is computed or depends on the control");
    const std::string name = programs_.set->nameOfVariable(ref->number);
    const ProgramRef program{kDocument, file_.model.programOf(use.block)};
    const std::string meaning = meaningOf(programs_, program, ref->number);
    line("**{}**{} ({})", name, meaning.empty() ? "" : " " + plain(meaning), kindOf(programs_, ref->number));
    if (const std::string clause = clauseOf(programs_, program, ref->number); !clause.empty())
      line("`{}`", clause);
    const bool isLocal = ref->number <= kLocalVariables;
    before([&](const StateFacts &facts) {
      return textOf(facts.variables, name, facts.othersAreUnknown && !isLocal ? "unknown" : "as at start");
    });
  }
  static std::string textOf(const std::vector<ValueFact> &facts, const std::string &name, std::string otherwise) {
    const auto found =
        std::find_if(facts.begin(), facts.end(), [&](const ValueFact &fact) { return fact.name == name; });
    return found == facts.end() ? otherwise : feedhold::textOf(*found);
  }
  /// What is known before this line, for each chain of calls.
  template <typename Tell> void before(Tell tell) {
    const auto known = knownBefore(view_, at_.block);
    if (!known)
      return;
    if (known->contexts.empty())
      return line("this line is unreachable");
    std::vector<std::pair<std::string, std::string>> texts;
    for (const FactsOfContext &context : known->contexts)
      texts.emplace_back(context.caller, tell(context.facts));
    if (const std::string text = together(texts); !text.empty())
      line("before this line{}: {}", known->assumed.empty() ? "" : ", " + known->assumed, text);
  }

  // ---- words ----

  void code(const Word &word) {
    const std::string name = toUpper(file_.source.utf8(word.span()));
    if (word.form() == WordForm::Expression)
      return line("**{}**: the code number is computed", name);
    const Code *row = codeOf(word, programs_.dialect());
    const auto tenths = word.tenths();
    const CodeCall *calls = tenths ? findCodeCall(programs_.dialect(), word.address(), *tenths) : nullptr;
    if (calls)
      return line("**{}** calls O{} on this machine", name, calls->program);
    if (!row && (word.address() == 'M' || (tenths && isBuildersCode(programs_.dialect(), 'G', *tenths))))
      return line("**{}**: its function is defined by the machine builder", name);
    if (!row)
      return line("**{}**: {} has no such code", name, programs_.dialect().title);
    line("**{}** {} ({})", name, row->meaning, programs_.dialect().title);
    if (row->group == 0 || word.address() != 'G')
      return;
    const std::string mode = modeName(ModalTable(programs_.dialect()), row->group);
    line("modal group {}{}", row->group, mode.starts_with("group") ? "" : ": " + mode);
    before([&](const StateFacts &facts) {
      const auto found =
          std::find_if(facts.modes.begin(), facts.modes.end(), [&](const ModeFact &fact) { return fact.name == mode; });
      return found == facts.modes.end() ? std::string("as at start") : feedhold::textOf(*found);
    });
  }
  void word(const Word &word) {
    constexpr std::string_view kAxes = "XYZABCUVW";
    if (kAxes.find(word.address()) == std::string_view::npos)
      return;
    const std::string name(1, word.address());
    before([&](const StateFacts &facts) {
      const std::string text = textOf(facts.positions, name, "");
      return text.empty() ? text : fmt::format("**{}** {}", name, text);
    });
  }

  const View &view_;
  const Project &programs_;
  const ProjectFile &file_;
  const SymbolAt &at_;
  std::string text_;
};

} // namespace

Json hover(const View &view, const Json &params) {
  const auto symbol = symbolAt(view, params);
  if (!symbol)
    return nullptr;
  std::string text = Hover(view, *symbol).write();
  if (text.empty())
    return nullptr;
  return {{"contents", markdown(std::move(text))}, {"range", rangeOf(view, kDocument, symbol->span)}};
}

} // namespace feedhold::lsp
