// dump: contracts as text, for golden cases.
#include "base/support/match.h"
#include "language/contract/contract.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

/// Expressions in full brackets, so that the page shows how they were read.
class Writer {
public:
  Writer(const FileContracts &contracts, ContractSourceId source)
      : tree_(contracts.tree), source_(contracts.source(source)) {}

  std::string text(ExpressionId id) const {
    const Expression &expression = tree_.expressions[id];
    const auto asWritten = [&] { return source_.utf8(expression.span); };
    return match(
        expression.node, [](const NumberLiteral &node) { return node.value.toString(); },
        [&](const NumberedVariable &) { return asWritten(); }, [&](const IndirectVariable &) { return asWritten(); },
        [&](const NamedVariable &) { return asWritten(); },
        [&](const Negation &node) { return "-" + text(node.operand); },
        [&](const Identity &node) { return text(node.operand); },
        [&](const Bracketed &node) { return text(node.inner); },
        [&](const BinaryOperation &node) {
          return fmt::format("[{} {} {}]", text(node.left), source_.utf8(node.opSpan), text(node.right));
        },
        [&](const FunctionCall &) { return asWritten(); }, [](const BrokenExpression &) { return std::string("?"); });
  }
  std::string text(const Range &range) const {
    return fmt::format("{} .. {}", range.low ? text(*range.low) : "any", range.high ? text(*range.high) : "any");
  }
  std::string text(const std::vector<AxisValue> &values) const {
    std::string all;
    for (const AxisValue &each : values)
      all += fmt::format(" {} {}", each.axis, text(each.value));
    return all;
  }
  std::string text(const Box &box) const {
    std::string all;
    for (const AxisRange &side : box.sides)
      all += fmt::format(" {} {}", side.axis, text(side.range));
    return all;
  }
  std::string text(const AllowedValues &values) const {
    return match(
        values, [](const AnyNumber &) { return std::string("any number"); },
        [&](const Range &range) { return text(range); },
        [&](const ValueList &list) {
          std::string all = "in";
          for (const ExpressionId value : list.values)
            all += " " + text(value);
          return all;
        });
  }
  std::string shape(const Region &region) const {
    return match(
        region.shape, [&](const Box &box) { return "box" + text(box); },
        [&](const Cylinder &each) {
          return fmt::format("cylinder along {} at{} radius {} from {}", each.axis, text(each.centre),
                             text(each.radius), text(each.along));
        },
        [&](const Sphere &each) { return fmt::format("sphere at{} radius {}", text(each.centre), text(each.radius)); },
        [&](const Polygon &each) {
          std::string all = "polygon";
          for (const Polygon::Corner &corner : each.corners)
            all += fmt::format(" ({}, {})", text(corner.first), text(corner.second));
          return fmt::format("{} Z {}", all, text(each.height));
        },
        [&](const Where &each) { return "where " + text(each.condition); });
  }

private:
  const SyntaxTree &tree_;
  const SourceFile &source_;
};

std::string codeText(const ModalCode &code) {
  const Decimal number(code.tenths, 1);
  return fmt::format(" {}{}", code.address, number.toString());
}

class Dumper {
public:
  Dumper(const FileContracts &contracts, const ProgramModel &model, const SyntaxTree &tree)
      : contracts_(contracts), model_(model), tree_(tree) {}

  std::string run() {
    for (const Contract &each : contracts_.contracts)
      contract(each);
    for (const ContractIssue &each : contracts_.issues)
      issue(each);
    return std::move(out_);
  }

private:
  Writer writer(ClauseId clause) const { return {contracts_, contracts_.clauses[clause].source}; }
  void line(std::string_view text) { out_.append("  ").append(text).append("\n"); }

  void contract(const Contract &contract) {
    const std::string name = toString(model_.programs[contract.program].name);
    out_ += fmt::format("contract of {}{}\n", name.empty() ? "the program without a name" : name,
                        contract.isSound ? "" : ", with clauses that could not be used");
    entry(contract);
    geometry(contract);
    promises(contract);
    for (const AwaitedInput &each : contract.awaited)
      line(fmt::format("awaits {}", contracts_.clauses[each.clause].text));
    if (contract.cyclic)
      line("runs for ever");
  }

  void entry(const Contract &contract) {
    for (const auto &[kind, list] : {std::pair("param", &contract.params), std::pair("global", &contract.globals)})
      for (const EntryValue &each : *list)
        line(fmt::format("{} #{}{}{}: {}{}{}{}{}", kind, each.variable, each.name.empty() ? "" : " ", each.name,
                         writer(each.clause).text(each.values), each.unit == Unit::None ? "" : " ", nameOf(each.unit),
                         each.step ? " by " + each.step->toString() : "",
                         each.vacancy == Vacancy::Possible ? ", or vacant" : ""));
    for (const ContractCondition &each : contract.requirements)
      line("require " + writer(each.clause).text(each.condition));
    std::string codes;
    for (const ModalCode &code : contract.modal)
      codes += codeText(code);
    if (!codes.empty())
      line("in force on entry:" + codes);
    if (contract.start)
      line("starts at" + writer(contract.start->clause).text(contract.start->axes));
  }

  void geometry(const Contract &contract) {
    constexpr std::string_view kShapes[] = {"flat", "ball", "bull", "drill", "tip"};
    if (const auto &tool = contract.tool)
      line(fmt::format("tool {} radius {}{}{}", kShapes[static_cast<std::size_t>(tool->shape)],
                       writer(tool->clause).text(tool->radius),
                       tool->corner ? " corner " + writer(tool->clause).text(*tool->corner) : "",
                       tool->shape == ToolShape::Tip ? fmt::format(" direction {}", tool->direction) : ""));
    for (const RadiusOffset &each : contract.offsets) {
      const Writer writes = writer(each.clause);
      line(fmt::format("offset of {} radius {}", each.number ? "D " + writes.text(*each.number) : "every D",
                       each.radius.low == each.radius.high ? writes.text(*each.radius.low) : writes.text(each.radius)));
    }
    for (const LengthRange &each : contract.lengths) {
      const Writer writes = writer(each.clause);
      const Range &length = each.length;
      line(fmt::format("length of {} {}", each.number ? fmt::format("H{}", *each.number) : "every H",
                       length.low == length.high ? writes.text(*length.low) : writes.text(length)));
    }
    for (const auto &[kind, list] : {std::pair("keep in", &contract.keepIn), std::pair("keep out", &contract.keepOut)})
      for (const Region &each : *list)
        line(fmt::format("{} {}: {}", kind, each.name, writer(each.clause).shape(each)));
    if (const auto &clearance = contract.clearance)
      line(fmt::format("clearance {} {}", clearance->height.axis,
                       writer(clearance->clause).text(clearance->height.value)));
    if (contract.travel)
      line("travel" + writer(contract.travel->clause).text(contract.travel->box));
    if (contract.machine)
      line("machine" + writer(contract.machine->clause).text(contract.machine->box));
    if (contract.corner)
      line("corners rounded by " + contract.corner->most.toString());
    if (contract.fixed)
      line("fixed " + contract.fixed->axes);
    for (const WordLimit &each : contract.limits)
      line(fmt::format("limit {}: {}", each.address, writer(each.clause).text(each.range)));
  }

  void promises(const Contract &contract) {
    for (const Ensure &each : contract.ensures)
      line("ensure " + promise(each));
    if (contract.tolerance)
      line("tolerance " + contract.tolerance->most.toString());
    for (const Assigns &each : contract.assigns)
      line("assigns" + variables(each));
    if (contract.guarded)
      line(fmt::format("guarded{}{}", contract.guarded->exceptModal ? " whatever the modes" : "",
                       contract.guarded->exceptStart ? " from any place" : ""));
    for (const AlarmPromise &each : contract.alarms)
      line(fmt::format("alarm {} {} {}", each.number, each.claim == AlarmClaim::If ? "if" : "if and only if",
                       writer(each.clause).text(each.condition)));
    for (const auto &[kind, list] :
         {std::pair("invariant", &contract.invariants), std::pair("variant", &contract.variants)})
      for (const LoopHint &each : *list)
        line(fmt::format("{} at line {}: {}", kind,
                         contracts_.source(kProgramText).lineOf(tree_.blocks[each.block].begin),
                         writer(each.clause).text(each.expression)));
  }

  std::string promise(const Ensure &ensure) const {
    return match(
        ensure.promise, [&](ExpressionId condition) { return writer(ensure.clause).text(condition); },
        [](const ModalPreserved &kept) {
          return std::string("the modal state of entry") + (kept.except.empty() ? "" : " except " + kept.except);
        },
        [](const std::vector<ModalCode> &codes) {
          std::string all = "in force:";
          for (const ModalCode &code : codes)
            all += codeText(code);
          return all;
        });
  }

  static std::string variables(const Assigns &assigns) {
    std::string all = assigns.variables.empty() ? " nothing" : "";
    for (const auto &[first, last] : assigns.variables)
      all += first == last ? fmt::format(" #{}", first) : fmt::format(" #{} to #{}", first, last);
    return all;
  }

  void issue(const ContractIssue &issue) {
    const SourceFile &source = contracts_.source(issue.source);
    const Position at = source.position(issue.span.begin);
    out_ += fmt::format("issue {} {}{}:{} `{}`{}{}\n", nameOf(issue.kind),
                        issue.source == kProgramText ? "" : source.path() + ":", at.line, at.column,
                        source.utf8(issue.span), issue.detail.empty() ? "" : ": ", issue.detail);
  }

  const FileContracts &contracts_;
  const ProgramModel &model_;
  const SyntaxTree &tree_;
  std::string out_;
};

} // namespace

std::string dump(const FileContracts &contracts, const ProgramModel &model, const SyntaxTree &tree) {
  return Dumper(contracts, model, tree).run();
}

} // namespace feedhold
