// macro-a-operation: `G65 H02 P#100 Q#101 R#102`.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::rules::macro_a_operation {
namespace {

struct Operation {
  std::uint32_t code;
  std::string_view meaning;
};

// The operations of Macro A, as the maintenance manuals of the small controls list them.
constexpr std::array kOperations = {
    Operation{1, "#p = #q"},
    Operation{2, "#p = #q + #r"},
    Operation{3, "#p = #q - #r"},
    Operation{4, "#p = #q * #r"},
    Operation{5, "#p = #q / #r"},
    Operation{11, "#p = #q OR #r"},
    Operation{12, "#p = #q AND #r"},
    Operation{13, "#p = #q XOR #r"},
    Operation{21, "#p = SQRT[#q]"},
    Operation{22, "#p = ABS[#q]"},
    Operation{23, "#p = #q MOD #r"},
    Operation{24, "#p = BIN[#q]"},
    Operation{25, "#p = BCD[#q]"},
    Operation{26, "#p = #p * #q / #r"},
    Operation{27, "#p = SQRT[#q*#q+#r*#r]"},
    Operation{28, "#p = SQRT[#q*#q-#r*#r]"},
    Operation{31, "#p = #q * SIN[#r]"},
    Operation{32, "#p = #q * COS[#r]"},
    Operation{33, "#p = #q * TAN[#r]"},
    Operation{34, "#p = ATAN[#q]/[#r]"},
    Operation{80, "GOTO p"},
    Operation{81, "IF[#q EQ #r]GOTO p"},
    Operation{82, "IF[#q NE #r]GOTO p"},
    Operation{83, "IF[#q GT #r]GOTO p"},
    Operation{84, "IF[#q LT #r]GOTO p"},
    Operation{85, "IF[#q GE #r]GOTO p"},
    Operation{86, "IF[#q LE #r]GOTO p"},
    Operation{99, "#3000 = p"},
};

const Operation *find(const Word *code) {
  const auto number = code ? code->integer() : std::nullopt;
  for (const Operation &operation : kOperations)
    if (operation.code == number)
      return &operation;
  return nullptr;
}

/// One finding for a program: one that is written so is written so throughout.
void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const auto calls = context.model.callsOf(program);
  const auto first = std::ranges::find(calls, CallKind::MacroA, &Call::kind);
  if (first == calls.end())
    return;
  const Word *code = findWord(context.tree, first->block, 'H');
  const Operation *operation = find(code);
  const Span span =
      code ? cover(wordOf(context, first->code).span(), code->span()) : wordOf(context, first->code).span();
  reporter.report(
      {.message = fmt::format("{} is an operation of Macro A", context.quoted(span)),
       .span = span,
       .label = operation ? fmt::format("`{}`, where P, Q, R name p, q, r", operation->meaning) : "",
       .notes = {"Macro A operations are read but not analysed: they compute in whole increments by their own rules"}});
}

} // namespace

extern const Rule macroAOperation;
const Rule macroAOperation{.info = {"macro-a-operation", Category::Call, Severity::Info,
                                    "Reports a program written in Macro A, whose operations are `G65 H..` blocks."},
                           .hooks = {.program = check}};

} // namespace feedhold::rules::macro_a_operation
