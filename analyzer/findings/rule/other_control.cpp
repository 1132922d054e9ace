// See the header.
#include "findings/rule/other_control.h"

namespace feedhold {
namespace {

constexpr std::size_t kForeignCodes = 2; // one is the builder's own on many machines
constexpr std::uint32_t kFirstSystem = 1000;

} // namespace

MissingVariables missingVariablesOf(const FileContext &context) {
  MissingVariables uses;
  for (const VariableUse &use : context.model.variables)
    if (use.number && !findVariable(context.dialect, *use.number))
      uses.emplace(*use.number, context.tree.expressions[use.expression].span);
  return uses;
}

MissingCodes missingCodesOf(const FileContext &context) {
  MissingCodes codes;
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i) {
    if (context.tree.blocks[BlockId(i)].has(Block::kAfterEnd))
      continue;
    for (const Word &word : context.tree.wordsOf(BlockId(i))) {
      const bool isCode = word.address() == 'G' && word.isNumber() && !word.has(Word::kArgument);
      const auto tenths = isCode ? word.tenths() : std::nullopt;
      if (isCode && !(tenths && hasGCode(context.dialect, *tenths)))
        codes.emplace(std::string(context.text(word.span())), word.span());
    }
  }
  return codes;
}

/// One code beside a slip or two says nothing.  `#42` alone is a slip on every control; a lone system variable may be
/// one of the control that has the codes.
bool isOfOtherControl(const MissingVariables &variables, const MissingCodes &codes) {
  const bool isForeign =
      variables.size() >= kForeignCodes || (!variables.empty() && variables.begin()->first >= kFirstSystem);
  return isForeign && (codes.size() >= kForeignCodes || (!codes.empty() && variables.size() >= kForeignVariables));
}

bool seemsForOtherControl(const FileContext &context) {
  const MissingVariables variables = missingVariablesOf(context);
  const MissingCodes codes = missingCodesOf(context);
  return isOfOtherControl(variables, codes) || variables.size() >= kForeignVariables || codes.size() >= kForeignCodes;
}

} // namespace feedhold
