// length-offset-of-other-tool: `T2 M06`, then `G43 H1` or `G41 D1`, or no `G43` at all.
#include "rules/motion/folder_programs.h"
#include "rules/structure/structure_view.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace feedhold::rules::length_offset_of_other_tool {
namespace {

struct Offset {
  std::uint32_t number;
  const Word *word;
};
/// What is programmed between two tool changes.
struct Section {
  std::uint32_t tool;
  const Word *toolWord;
  std::vector<Offset> lengths;
  bool setsLength = false; // G43 without H, H without G43, or a code that may set a length
  bool movesZ = false;
  const Word *cut = nullptr;      // the code of the first cut before any length and any move in Z
  std::vector<Offset> radii = {}; // D with G41, G42
  bool radiusAgrees = false;      // D has the number of the tool
};

bool isLiteral(const Word &word, char address) {
  return word.address() == address && word.integer() && !word.has(Word::kArgument) && !word.has(Word::kComma);
}

bool hasAction(const FileContext &context, BlockId block, std::initializer_list<CodeAction> actions) {
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    const Code *code = codeOf(word, context.dialect);
    return code && std::ranges::find(actions, code->action) != actions.end();
  });
}

/// Which tool is in the spindle behind the block is not told by its text: a call, an M code of the machine builder, or
/// another way that leads here.
bool hidesTool(const FileContext &context, BlockId block, const std::set<BlockId> &targets) {
  const Block &its = context.tree.blocks[block];
  if (its.has(Block::kSkip) || its.has(Block::kSkipInside) ||
      (its.has(Block::kBroken) && mayHoldCode(context, block, "TMO")) || targets.contains(block) ||
      !context.model.callsIn(block, block.next()).empty())
    return true;
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    const bool isRead = word.isNumber() || !its.has(Block::kBroken);
    return word.isCode() && (word.has(Word::kAfterThen) || (isRead && !codeOf(word, context.dialect)));
  });
}

/// Another tool may be in the spindle behind the block than before it.
bool mayChange(const FileContext &context, BlockId block) {
  return hidesTool(context, block, {}) || hasAction(context, block, {CodeAction::ToolChange}) ||
         findWord(context.tree, block, 'T');
}

/// Where a jump from another tool leads.  A loop in which no tool is changed keeps the tool that it began with.
std::set<BlockId> targetsOfOtherTools(ProgramId program, const FileContext &context) {
  std::set<BlockId> others = context.model.jumpTargetsOf(program);
  const auto jumps = context.model.jumpsOf(program);
  if (others.empty() ||
      std::ranges::any_of(jumps, [](const Jump &jump) { return jump.kind != JumpKind::Goto || !jump.target; }))
    return others;
  const Program &its = context.model.programs[program];
  std::vector<std::size_t> changes{0}; // before each block
  for (BlockId block = its.first; block < its.last; block = block.next())
    changes.push_back(changes.back() + (mayChange(context, block) ? 1 : 0));
  const auto changesBefore = [&](BlockId block) { return changes[block.index() - its.first.index()]; };
  std::set<BlockId> own;
  for (const Jump &jump : jumps)
    own.insert(*jump.target);
  for (const Jump &jump : jumps)
    if (changesBefore(jump.block) != changesBefore(*jump.target))
      own.erase(*jump.target);
  std::erase_if(others, [&](BlockId target) { return own.contains(target); });
  return others;
}

/// Follows T, M06, G43 H and D through the text of one program.
class Reader {
public:
  Reader(ProgramId program, const FileContext &context)
      : context_(context), targets_(targetsOfOtherTools(program, context)) {}

  void read(BlockId block) {
    if (hidesTool(context_, block, targets_)) {
      isKnown_ = false;
      selected_ = nullptr;
    }
    const Word *length = nullptr;
    for (const Word &word : context_.tree.wordsOf(block)) {
      if (word.address() == 'T')
        selected_ = isLiteral(word, 'T') ? &word : nullptr;
      else if (isLiteral(word, 'H'))
        length = &word;
    }
    if (hasAction(context_, block, {CodeAction::ToolChange}))
      change(block);
    if (!isKnown_ || sections_.empty())
      return;
    if (length && hasAction(context_, block, {CodeAction::LengthPlus, CodeAction::LengthMinus}))
      sections_.back().lengths.push_back({*length->integer(), length});
    readLength(block);
    const bool compensates = hasAction(context_, block, {CodeAction::CompensationLeft, CodeAction::CompensationRight});
    for (const Word &word : context_.tree.wordsOf(block)) {
      if (!isLiteral(word, 'D'))
        continue;
      if (*word.integer() == sections_.back().tool)
        sections_.back().radiusAgrees = true;
      else if (compensates)
        sections_.back().radii.push_back({*word.integer(), &word});
    }
  }

  const std::vector<Section> &sections() const { return sections_; }

private:
  bool moves(BlockId block) const {
    return std::ranges::any_of(context_.tree.wordsOf(block),
                               [](const Word &word) { return word.address() == 'X' || word.address() == 'Y'; });
  }
  void readLength(BlockId block) {
    Section &section = sections_.back();
    section.setsLength = section.setsLength || findWord(context_.tree, block, 'H') ||
                         hasAction(context_, block,
                                   {CodeAction::LengthPlus, CodeAction::LengthMinus, CodeAction::LengthGiven,
                                    CodeAction::LengthOff, CodeAction::Unmodelled, CodeAction::Anything}) ||
                         findCode(context_.tree, block, context_.dialect, CodeRole::DataSetting);
    // A move in Z without a length is told by `approach-before-length-offset`.
    section.movesZ = section.movesZ || findWord(context_.tree, block, 'Z');
    if (!section.setsLength && !section.movesZ && !section.cut && moves(block))
      section.cut = findAction(context_.tree, block, context_.dialect,
                               {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
  }
  void change(BlockId block) {
    isKnown_ = selected_ != nullptr && !hidesTool(context_, block, targets_);
    if (isKnown_)
      sections_.push_back({.tool = *selected_->integer(), .toolWord = selected_, .lengths = {}});
    selected_ = nullptr;
  }

  const FileContext &context_;
  std::set<BlockId> targets_;
  const Word *selected_ = nullptr; // the last T before M06
  bool isKnown_ = false;           // the tool of the last section is in the spindle
  std::vector<Section> sections_;
};

bool agrees(const Section &section) {
  return std::ranges::find(section.lengths, section.tool, &Offset::number) != section.lengths.end();
}
/// Only H of other tools, and not H0.
bool differs(const Section &section) {
  return !section.lengths.empty() && !agrees(section) && section.lengths.front().number != 0;
}

/// Only H0, which is the offset of no tool.
bool hasNone(const Section &section) {
  return section.tool != 0 && !section.lengths.empty() &&
         std::ranges::all_of(section.lengths, [](const Offset &offset) { return offset.number == 0; });
}

void tellNone(const Section &section, const FileContext &context, const Reporter &reporter) {
  const Offset &offset = section.lengths.front();
  reporter.report(
      {.message = fmt::format("{} is no length offset, and {} has no other one", context.quoted(offset.word->span()),
                              context.quoted(section.toolWord->span())),
       .span = offset.word->span(),
       .labels = {{section.toolWord->span(), "the tool in the spindle"}},
       .notes = {fmt::format("tool {} moves as if its length were 0: it goes down into the part", section.tool),
                 fmt::format("write `H{}` if tool {} is meant", section.tool, section.tool)}});
}

/// It cuts where the one before it has its own length offset, and has none itself.
bool cutsWithOtherLength(const Section &before, const Section &section) {
  return agrees(before) && before.tool != section.tool && section.tool != 0 && section.cut && !section.setsLength;
}

void tellOtherLength(const Section &before, const Section &section, const FileContext &context,
                     const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("no `G43` comes between {} and the cut by {}", context.quoted(section.toolWord->span()),
                              context.quoted(section.cut->span())),
       .span = section.cut->span(),
       .labels = {{section.toolWord->span(), "the tool in the spindle"},
                  {before.lengths.front().word->span(), "the length offset of the tool before"}},
       .notes = {fmt::format("tool {} moves with the length of tool {}, or with none: it cuts too deep, or air",
                             section.tool, before.tool),
                 fmt::format("write `G43 H{}` in the first block that moves Z", section.tool)}});
}

/// A second offset of the same tool by a scheme of the shop: H12 or H52 of T2.
bool isSecondOffset(const Section &section, std::uint32_t length, const std::set<std::uint32_t> &tools,
                    const std::set<std::uint32_t> &paired) {
  if (tools.contains(length))
    return false;
  return paired.contains(section.tool) || (length > section.tool && (length - section.tool) % 10 == 0);
}

void tell(const Section &section, const FileContext &context, const Reporter &reporter, Severity severity) {
  const Offset &offset = section.lengths.front();
  reporter.report(
      {.message = fmt::format("{} is the length offset of another tool than {}", context.quoted(offset.word->span()),
                              context.quoted(section.toolWord->span())),
       .span = offset.word->span(),
       .labels = {{section.toolWord->span(), "the tool in the spindle"}},
       .notes = {fmt::format("tool {} moves with the length that is stored for tool {}: it cuts too deep, or air",
                             section.tool, offset.number),
                 fmt::format("write `H{}` if tool {} is meant", section.tool, section.tool)}},
      severity);
}

/// H has the number of the tool, and D that of another tool of the program.
void checkRadius(const Section &section, const std::set<std::uint32_t> &tools, const FileContext &context,
                 const Reporter &reporter) {
  const auto other = std::ranges::find_if(
      section.radii, [&](const Offset &offset) { return offset.number != 0 && tools.contains(offset.number); });
  if (section.radiusAgrees || !agrees(section) || other == section.radii.end())
    return;
  reporter.report(
      {.message = fmt::format("{} is the radius offset of another tool than {}", context.quoted(other->word->span()),
                              context.quoted(section.toolWord->span())),
       .span = other->word->span(),
       .labels = {{section.toolWord->span(), "the tool in the spindle"}},
       .notes = {fmt::format("tool {} is compensated by the radius of tool {}: the contour gets another size",
                             section.tool, other->number),
                 fmt::format("write `D{}` if tool {} is meant", section.tool, section.tool)}});
}

/// All tools have their own H, and one of them has a D: by the same count.
bool hasLoneRadius(const std::vector<Section> &sections) {
  const auto hasRadius = [](const Section &section) { return !section.radii.empty(); };
  return sections.size() > 1 && std::ranges::all_of(sections, agrees) &&
         std::ranges::count_if(sections, hasRadius) == 1;
}

/// A lathe, whatever the dialect: the offsets of turrets have numbers of their own.
bool turns(ProgramId program, const FileContext &context) {
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    if (hasAction(context, block, {CodeAction::PlaneZX}))
      return true;
  return context.dialect.machine == MachineKind::Turning;
}

std::vector<Section> sectionsOf(ProgramId program, const FileContext &context) {
  Reader reader(program, context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    reader.read(block);
  return reader.sections();
}

/// Some other program of the folder counts offsets otherwise.
bool hasOtherScheme(ProgramId own, const FileContext &context) {
  for (const FileId file : filesOfFolder(context)) {
    const FileContext its = contextOf(context.programs->file(file), context);
    for (ProgramId program(0); program.index() < its.model.programs.size(); program = program.next())
      if ((file != context.file || program != own) && std::ranges::any_of(sectionsOf(program, its), differs))
        return true;
  }
  return false;
}

constexpr std::uint32_t kMostOfSmallMagazine = 20; // above, H may count by a scheme of the shop

/// The only tool of the program has the small number of another one.
bool isLoneMismatch(const std::vector<Section> &sections, ProgramId program, const FileContext &context) {
  if (sections.size() != 1 || sections.front().lengths.size() != 1)
    return false;
  return sections.front().tool < kMostOfSmallMagazine &&
         sections.front().lengths.front().number < kMostOfSmallMagazine && !hasOtherScheme(program, context);
}

/// The text holds the letter and the number, and no digit more: `T02`, `H2`.
bool names(std::string_view text, char letter, std::uint32_t number) {
  for (std::size_t at = text.find(letter); at != std::string_view::npos; at = text.find(letter, at + 1)) {
    std::size_t end = at + 1;
    std::uint32_t read = 0;
    for (; end < text.size() && isDigit(text[end]) && end - at < 5; ++end)
      read = read * 10 + static_cast<std::uint32_t>(text[end] - '0');
    const bool isWord = at == 0 || !isLetter(text[at - 1]);
    if (isWord && end > at + 1 && read == number)
      return true;
  }
  return false;
}

/// A remark gives the tool its own number for its length: `(T02 - END MILL, H02)`.
bool isPairedByRemark(std::uint32_t tool, const FileContext &context) {
  return std::ranges::any_of(context.tree.comments, [&](const Comment &comment) {
    const std::string text = toUpper(context.text(comment.span));
    return names(text, 'T', tool) && names(text, 'H', tool);
  });
}

/// Where more tools have their own length offset than none, those without one are slips.
void checkCutsWithoutLength(const std::vector<Section> &sections, std::size_t paired, const FileContext &context,
                            const Reporter &reporter) {
  std::vector<std::pair<const Section *, const Section *>> slips;
  for (std::size_t at = 1; at < sections.size(); ++at)
    if (cutsWithOtherLength(sections[at - 1], sections[at]))
      slips.emplace_back(&sections[at - 1], &sections[at]);
  if (slips.size() > paired)
    return;
  for (const auto &[before, section] : slips)
    tellOtherLength(*before, *section, context, reporter);
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (turns(program, context))
    return;
  const std::vector<Section> sections = sectionsOf(program, context);
  std::set<std::uint32_t> tools;
  std::set<std::uint32_t> paired;
  std::set<std::uint32_t> odd;
  for (const Section &section : sections) {
    tools.insert(section.tool);
    if (agrees(section))
      paired.insert(section.tool);
    else if (differs(section))
      odd.insert(section.tool);
  }
  const bool countsRadii = std::ranges::any_of(sections, &Section::radiusAgrees) || hasLoneRadius(sections);
  const bool isLone = isLoneMismatch(sections, program, context); // without a habit to compare it with
  for (const Section &section : sections) {
    const bool isHabit = section.radiusAgrees || isLone || (!paired.empty() && odd.size() <= paired.size());
    if (differs(section) && isHabit && !isSecondOffset(section, section.lengths.front().number, tools, paired))
      tell(section, context, reporter,
           isLone && !section.radiusAgrees && !isPairedByRemark(section.tool, context) ? Severity::Info
                                                                                       : Severity::Warning);
    if (hasNone(section) && !paired.empty())
      tellNone(section, context, reporter);
    if (countsRadii)
      checkRadius(section, tools, context, reporter);
  }
  checkCutsWithoutLength(sections, paired.size(), context, reporter);
}

void asksForPrograms(const FlowFacts &, const FileContext &, const Reporter &) {}

} // namespace

extern const Rule lengthOffsetOfOtherTool;
const Rule lengthOffsetOfOtherTool{
    .info = {"length-offset-of-other-tool", Category::Motion, Severity::Warning,
             "Reports a `G43 H`, or a `G41 D`, with the number of another tool, or a cut without a `G43`, in a program "
             "that otherwise gives tool and offset one number."},
    .hooks = {.program = check, .flow = asksForPrograms}};

} // namespace feedhold::rules::length_offset_of_other_tool
