// other-offset-set: `G10 L2 P1 ..`, and then the part is cut under G55.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

namespace feedhold::rules::other_offset_set {
namespace {

constexpr std::uint32_t kFirstTenths = 540; // G54: P1
constexpr std::uint32_t kOffsets = 6;

/// The work offsets that the text of one program sets and selects.
struct Offsets {
  std::map<std::uint32_t, const Word *> set; // by P of G10 L2: 1 for G54
  std::map<std::uint32_t, const Word *> selected;
  bool isKnown = true; // every one is a literal, and none is set or selected unseen
};

std::optional<std::uint32_t> literalOf(BlockId block, char address, const FileContext &context) {
  const Word *word = findWord(context.tree, block, address);
  return word && word->isNumber() ? word->integer() : std::nullopt;
}

void readData(BlockId block, const Word &code, const FileContext &context, Offsets &offsets) {
  const auto kind = literalOf(block, 'L', context);
  if (kind && *kind != 2)
    return;
  const auto number = literalOf(block, 'P', context);
  if (!kind || !number || *number > kOffsets) {
    offsets.isKnown = false;
    return;
  }
  const Word *place = findWord(context.tree, block, 'P');
  if (*number != 0) // P0 is the external offset, which counts for all
    offsets.set.emplace(*number, place ? place : &code);
}

void readSelection(const Code &code, const Word &word, Offsets &offsets) {
  const std::uint32_t steps = code.tenths >= kFirstTenths ? (code.tenths - kFirstTenths) / 10u : kOffsets;
  if (steps >= kOffsets || code.tenths % 10 != 0)
    offsets.isKnown = false;
  else
    offsets.selected.emplace(steps + 1, &word);
}

void readBlock(BlockId block, const FileContext &context, Offsets &offsets) {
  if (!context.model.callsIn(block, block.next()).empty() || context.tree.blocks[block].has(Block::kBroken)) {
    offsets.isKnown = false;
    return;
  }
  for (const Word &word : context.tree.wordsOf(block)) {
    if (word.address() != 'G')
      continue;
    const Code *code = codeOf(word, context.dialect);
    if (!code || code->action == CodeAction::ExtendedWorkOffset)
      offsets.isKnown = false;
    else if (code->role == CodeRole::DataSetting)
      readData(block, word, context, offsets);
    else if (code->action == CodeAction::WorkOffset)
      readSelection(*code, word, offsets);
  }
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  Offsets offsets;
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last && offsets.isKnown; block = block.next())
    readBlock(block, context, offsets);
  if (!offsets.isKnown || offsets.set.empty() || offsets.selected.empty())
    return;
  const bool isUsed =
      std::ranges::any_of(offsets.set, [&](const auto &each) { return offsets.selected.contains(each.first); });
  if (isUsed)
    return;
  const auto &[number, place] = *offsets.set.begin();
  const Word &selected = *offsets.selected.begin()->second;
  reporter.report(
      {.message = fmt::format("{} sets the work offset of `G{}`, which this program never selects",
                              context.quoted(place->span()), kFirstTenths / 10 + number - 1),
       .span = place->span(),
       .labels = {{selected.span(), "the work offset in force"}},
       .notes = {
           fmt::format("the moves of this program do not see the new values: the part is cut at the old zero of {}",
                       context.quoted(selected.span())),
           fmt::format("write `P{}` for {}, or select `G{}`", offsets.selected.begin()->first,
                       context.quoted(selected.span()), kFirstTenths / 10 + number - 1)}});
}

} // namespace

extern const Rule otherOffsetSet;
const Rule otherOffsetSet{.info = {"other-offset-set", Category::Motion, Severity::Warning,
                                   "Reports a `G10 L2` for a work offset that the program never selects, while it "
                                   "selects another."},
                          .hooks = {.program = check}};

} // namespace feedhold::rules::other_offset_set
