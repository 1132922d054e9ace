// wear-as-geometry: `#101=#100*0.0001 (TOOL WEAR)`, `G10 L12 P1 R#101`: L12 is the radius itself.
#include "rules/comments/remarks_of_block.h"
#include "rules/flow/flow_view.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <set>

namespace feedhold::rules::wear_as_geometry {
namespace {

constexpr std::uint32_t kLength = 10; // L of the geometry; that of the wear is the next one
constexpr std::uint32_t kRadius = 12;

/// The remarks beside a value, and beside what it is computed from.
class Origin {
public:
  Origin(ProgramId program, const FileContext &context) : context_(context), program_(program) {}

  void follow(ExpressionId value, int depth = 0) {
    constexpr int kDeepest = 4;
    for (const ExpressionId part : subexpressions(context_.tree, value)) {
      const auto number = variableNumber(context_.tree, part);
      if (!number)
        continue;
      readsControl_ = readsControl_ || roleOf(context_, *number) != VariableRole::Plain;
      if (depth < kDeepest && seen_.insert(*number).second)
        followVariable(*number, depth + 1);
    }
  }
  void add(BlockId block) {
    const std::string remark = remarksOf(context_, block);
    saysWear_ = saysWear_ || saysAny(remark, {"WEAR"});
    saysOther_ = saysOther_ || saysAny(remark, {"GEOM", "MEASURED"});
  }
  bool isWear() const { return saysWear_ && !saysOther_ && !readsControl_; }

private:
  void followVariable(std::uint32_t variable, int depth) {
    for (const VariableUse &use : context_.model.variablesOf(program_)) {
      if (!use.write || use.number != variable)
        continue;
      add(use.block);
      for (const Statement &statement : context_.tree.statementsOf(use.block))
        if (const auto *assignment = std::get_if<Assignment>(&statement.node);
            assignment && assignment->target == use.expression)
          follow(assignment->value, depth);
    }
  }

  const FileContext &context_;
  ProgramId program_;
  std::set<std::uint32_t> seen_;
  bool saysWear_ = false;
  bool saysOther_ = false;
  bool readsControl_ = false; // a measured or stored value of its own
};

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *table = findWord(context.tree, block, 'L');
  if (!table || context.dialect.grammar.oWords || context.dialect.machine != MachineKind::Milling ||
      !findCode(context.tree, block, context.dialect, CodeRole::DataSetting) ||
      findAction(context.tree, block, context.dialect, {CodeAction::Incremental}))
    return;
  const Word *value = findWord(context.tree, block, 'R');
  const auto kind = table->integer();
  if (!value || value->form() != WordForm::Expression || (kind != kLength && kind != kRadius))
    return;
  Origin origin(context.model.programOf(block), context);
  origin.add(block);
  origin.follow(value->expression());
  if (!origin.isWear())
    return;
  const std::string_view what = kind == kLength ? "length" : "radius or diameter";
  reporter.report(
      {.message = fmt::format("{} sets the {} of the tool itself, and the remarks speak of wear",
                              context.quoted(table->span()), what),
       .span = table->span(),
       .labels = {{value->span(), "the whole of it from here on"}},
       .notes = {fmt::format("the {} is overwritten with the wear: the tool cuts as if it had almost none", what),
                 fmt::format("write `L{}` for the wear", *kind + 1)}});
}

} // namespace

extern const Rule wearAsGeometry;
const Rule wearAsGeometry{.info = {"wear-as-geometry", Category::Motion, Severity::Warning,
                                   "Reports a `G10` that writes a wear to the table of the lengths or radii of tools."},
                          .hooks = {.block = check}};

} // namespace feedhold::rules::wear_as_geometry
