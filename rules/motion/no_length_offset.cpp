// no-length-offset: M06, moves in Z, and no G43 in the whole program.
#include "rules/motion/folder_programs.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace feedhold::rules::no_length_offset {
namespace {

/// What the text of a program, and of those that it calls, does with tools.
struct Tools {
  const Word *change = nullptr; // of the program itself
  const Word *depth = nullptr;  // the first Z of the program itself behind it
  std::size_t changes = 0;      // of the program itself
  bool moves = false;           // some Z moves
  bool hasPlane = false;        // and some Y: a mill, whatever the dialect
  bool hasOffset = false;       // G43, or what may set the length some other way
  const Word *ofMove = nullptr; // G45 .. G48 with H, of the program itself
};

/// G45 to G48: H lengthens or shortens the moves of one block.
const Word *offsetOfMove(const SyntaxTree &tree, BlockId block, const Dialect &dialect) {
  if (findWord(tree, block, 'H'))
    for (const Word &word : tree.wordsOf(block))
      if (const Code *code = word.address() == 'G' ? codeOf(word, dialect) : nullptr)
        if (code->tenths >= 450 && code->tenths <= 480 && code->action == CodeAction::OtherCycle &&
            code->role == CodeRole::Plain)
          return &word;
  return nullptr;
}

bool setsLength(const Code &code) {
  constexpr std::array kSetting = {CodeAction::LengthPlus, CodeAction::LengthMinus, CodeAction::LengthGiven,
                                   CodeAction::Unmodelled, CodeAction::Anything};
  return code.role == CodeRole::DataSetting || std::ranges::find(kSetting, code.action) != kSetting.end();
}

class Reader {
public:
  Reader(const FileContext &context) : context_(context) {}

  Tools read(ProgramRef program) {
    seen_.clear();
    Tools tools;
    readProgram(program, tools, true);
    return tools;
  }

private:
  void readProgram(ProgramRef ref, Tools &tools, bool isOuter) {
    if (!seen_.insert(ref).second)
      return;
    const ProgramFile &file = context_.programs->file(ref.file);
    const Program &program = file.model->programs[ref.program];
    for (BlockId block = program.first; block < program.last; block = block.next())
      readBlock(file, block, tools, isOuter);
    for (const Call &call : file.model->callsOf(ref.program)) {
      if (call.kind == CallKind::ModalCancel)
        continue;
      const auto callee = context_.callGraph.callee(ref.file, call);
      if (callee)
        readProgram(*callee, tools, false);
      else if (call.kind == CallKind::Subprogram && call.programWord && call.callee.empty() &&
               file.model->programs.size() > 2)
        readOthers(ref, tools);
      else
        tools.hasOffset = true;
    }
  }

  /// `M98P[#1+9200]`: some program of the file.
  void readOthers(ProgramRef ref, Tools &tools) {
    for (std::size_t program = 0; program < context_.programs->file(ref.file).model->programs.size(); ++program)
      readProgram({ref.file, ProgramId(program)}, tools, false);
  }

  void readBlock(const ProgramFile &file, BlockId block, Tools &tools, bool isOuter) const {
    const Word *depth = nullptr;
    const Word *ofMove = offsetOfMove(*file.tree, block, *file.dialect);
    if (isOuter && !tools.ofMove)
      tools.ofMove = ofMove;
    bool isPosition = !file.tree->blocks[block].has(Block::kData);
    for (const Word &word : file.tree->wordsOf(block)) {
      if (word.address() == 'Z' && !word.has(Word::kArgument))
        depth = &word;
      else if (word.address() == 'Y')
        tools.hasPlane = true;
      else if (word.address() == 'H' && !ofMove)
        tools.hasOffset = true;
      if (!word.isCode())
        continue;
      const Code *code = codeOf(word, *file.dialect);
      if (!code) { // of the machine builder, or computed
        tools.hasOffset = tools.hasOffset || word.address() == 'G' || !word.isNumber();
        continue;
      }
      tools.hasOffset = tools.hasOffset || setsLength(*code);
      if (isOuter && code->action == CodeAction::ToolChange) {
        tools.change = tools.change ? tools.change : &word;
        ++tools.changes;
      }
      isPosition = isPosition && code->role != CodeRole::ReferenceReturn && code->role != CodeRole::MachinePosition;
    }
    if (!depth || !isPosition || (isOuter && !tools.change))
      return;
    tools.moves = true;
    if (isOuter && !tools.depth)
      tools.depth = depth;
  }

  const FileContext &context_;
  std::set<ProgramRef> seen_;
};

/// More programs of the folder that change tools have a length offset than have none.
bool isHabitOfFolder(const FileContext &context) {
  std::size_t with = 0;
  std::size_t without = 0;
  Reader reader(context);
  for (const FileId file : filesOfFolder(context))
    for (std::size_t program = 0; program < context.programs->file(file).model->programs.size(); ++program) {
      const Tools tools = reader.read({file, ProgramId(program)});
      if (tools.change && tools.moves)
        ++(tools.hasOffset ? with : without);
    }
  return with > without;
}

/// Two tools have lengths to tell apart, whatever the work offset says of Z; a numbered main program is for a machine
/// with a magazine, and no text of a hobby router.
bool needsOffset(const Tools &tools, ProgramId program, const FileContext &context) {
  return tools.changes > 1 ||
         (!context.model.programs[program].name.empty() && startedBy(context, program) == StartedBy::Operator);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling || context.dialect.behaviour.endRestoresModes)
    return;
  const Tools tools = Reader(context).read({context.file, facts.program});
  if (!tools.change || !tools.moves || !tools.hasPlane || tools.hasOffset)
    return;
  std::vector<Label> labels;
  if (tools.ofMove)
    labels.push_back({tools.ofMove->span(), "shifts the end of this one move by H, and sets no tool length"});
  if (tools.depth)
    labels.push_back({tools.depth->span(), "moves the tool"});
  reporter.report(
      {.message = "no `G43` comes after this tool change",
       .span = tools.change->span(),
       .labels = std::move(labels),
       .notes = {"Z moves with the length offset of the program before, or with none: the depth is wrong by "
                 "the length of the tool",
                 tools.ofMove ? fmt::format("write G43 in place of {}", context.quoted(tools.ofMove->span()))
                              : "write G43 and H in the first block that moves Z"}},
      needsOffset(tools, facts.program, context) || isHabitOfFolder(context) ? Severity::Warning : Severity::Info);
}

} // namespace

extern const Rule noLengthOffset;
const Rule noLengthOffset{.info = {"no-length-offset", Category::Motion, Severity::Warning,
                                   "Reports a program that changes tools, moves `Z` and never sets a tool length "
                                   "offset."},
                          .hooks = {.flow = check}};

} // namespace feedhold::rules::no_length_offset
