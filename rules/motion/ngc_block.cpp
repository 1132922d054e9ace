// See the header.
#include "rules/motion/ngc_block.h"

#include <algorithm>
#include <bit>
#include <string_view>

namespace feedhold::rules {

namespace {
constexpr std::string_view kAxes = "XYZABCUVW@^";

bool isOfUser(const Word &word, const Code &code) {
  constexpr std::uint16_t kFirst = 1000; // M100
  return word.address() == 'M' && code.tenths >= kFirst;
}
/// G6.2 and G6.3, of which versions take other words.
bool isOfNewerVersions(char address, const Code &code) {
  return address == 'G' && (code.tenths == 62 || code.tenths == 63);
}
} // namespace

std::optional<NgcBlock> NgcBlock::of(const MotionView &view, NodeId node) {
  const FileContext &context = view.context();
  if (!context.dialect.behaviour.stopsAtStrayWords ||
      !std::holds_alternative<ExecuteWords>(view.node(node).instruction))
    return std::nullopt;
  const BlockId block = view.node(node).block;
  if (context.tree.blocks[block].has(Block::kBroken) || !context.model.callsIn(block, block.next()).empty())
    return std::nullopt;
  NgcBlock found;
  found.words_ = view.wordsOf(node);
  const auto group = view.modes().groupOf(ModalKind::Motion);
  for (const Word *word : found.words_) {
    if (word->has(Word::kComma) || word->has(Word::kAfterSkip) || word->form() == WordForm::Missing ||
        word->form() == WordForm::Broken)
      return std::nullopt;
    if (kAxes.find(word->address()) != std::string_view::npos)
      found.axis_ = found.axis_ ? found.axis_ : word;
    if (!word->isCode())
      continue;
    const Code *code = codeOf(*word, context.dialect);
    if (!code || isOfUser(*word, *code) || isOfNewerVersions(word->address(), *code))
      return std::nullopt;
    // `G80 G0 X5`: the movement holds.
    if (word->address() == 'G' && group && code->group == *group &&
        (!found.motion_ || code->action != CodeAction::CycleOff))
      found.motion_ = word;
  }
  return found;
}

const Word *NgcBlock::find(char address) const {
  const auto found = std::ranges::find(words_, address, [](const Word *word) { return word->address(); });
  return found == words_.end() ? nullptr : *found;
}

const Word *NgcBlock::code(char address, std::span<const std::uint16_t> tenths) const {
  for (const Word *word : words_)
    if (word->address() == address && word->tenths() && std::ranges::find(tenths, *word->tenths()) != tenths.end())
      return word;
  return nullptr;
}

bool NgcBlock::givesAxesAway() const { return code('G', {100, 280, 300, 431, 520, 920}) != nullptr; }

std::optional<std::vector<std::uint16_t>> motionsInForce(const MotionView &view, const AbstractState &state) {
  const auto group = view.modes().groupOf(ModalKind::Motion);
  const auto codes = view.inForce(state, ModalKind::Motion);
  if (!group || !codes || codes->mayBeAtEntry() || isHavocked(state))
    return std::nullopt;
  std::vector<std::uint16_t> tenths;
  for (std::uint64_t rest = codes->codes(); rest != 0; rest &= rest - 1) {
    const Code &code = *view.modes().group(*group).codes[static_cast<std::size_t>(std::countr_zero(rest))];
    if (isOfNewerVersions('G', code))
      return std::nullopt;
    tenths.push_back(code.tenths);
  }
  return tenths;
}

} // namespace feedhold::rules
