// g10-not-closed: `G10 L50` without `G11`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::g10_not_closed {
namespace {

/// Controls without `G11` take such blocks one by one.
bool hasEnd(const Dialect &dialect) {
  constexpr std::uint16_t kG11 = 110;
  const Code *code = findGCode(dialect, kG11);
  return code && code->role == CodeRole::DataSettingEnd;
}

bool opensData(const FileContext &context, BlockId block) {
  if (!findCode(context.tree, block, context.dialect, CodeRole::DataSetting))
    return false;
  const Word *kind = findWord(context.tree, block, 'L');
  return kind && (kind->integer() == 50u || kind->integer() == 52u);
}

bool isClosed(const FileContext &context, BlockId open) {
  const Program &program = context.model.programs[context.model.programOf(open)];
  for (BlockId block = open; block < program.last; block = block.next()) {
    if (findCode(context.tree, block, context.dialect, CodeRole::DataSettingEnd))
      return true;
    if (block != open && opensData(context, block))
      return false;
  }
  return false;
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!hasEnd(context.dialect) || !opensData(context, block) || isClosed(context, block))
    return;
  const Word *code = findCode(context.tree, block, context.dialect, CodeRole::DataSetting);
  const Word *kind = findWord(context.tree, block, 'L');
  reporter.report(
      {.message = fmt::format("no `G11` ends {}", context.quoted(cover(code->span(), kind->span()))),
       .span = cover(code->span(), kind->span()),
       .notes = {"the control reads the blocks that follow as parameter data, with N as the parameter number",
                 "write G11 after the last parameter"}});
}

} // namespace

extern const Rule g10NotClosed;
const Rule g10NotClosed{.info = {"g10-not-closed", Category::Structure, Severity::Warning,
                                 "Reports parameter input by `G10 L50` or `G10 L52` without the `G11` that ends it."},
                        .hooks = {.block = check}};

} // namespace feedhold::rules::g10_not_closed
