#include "proof/guards/guard_fix.h"

#include "base/support/match.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace feedhold::prove {

namespace {

constexpr std::uint32_t kFirstSequence = 9001; // where shops put their alarms
constexpr std::uint32_t kFirstAlarm = 101;

std::string without(std::string text, char unwanted) {
  std::erase(text, unwanted);
  return text;
}

class GuardFix {
public:
  GuardFix(const ProgramFile &file, ProgramId program, const Contract *contract)
      : tree_(*file.tree), source_(*file.source), model_(*file.model), dialect_(*file.dialect), program_(program),
        contract_(contract) {}

  std::optional<FixIt> of(const std::vector<GuardAtom> &atoms) {
    const auto first = firstBlock();
    const auto last = lastBlock();
    if (!raisesAlarm(dialect_, kAlarmVariable) || !first || !last)
      return std::nullopt;
    const bool isOpen = !isEnd(*last);
    const std::string newLine = source_.text().find("\r\n") == std::string_view::npos ? "\n" : "\r\n";
    std::string head, tail, title;
    for (const GuardAtom &atom : atoms) {
      const auto sequence = free(kFirstSequence, dialect_.limits.lastSequenceNumber, takenSequences());
      const auto alarm = free(kFirstAlarm, dialect_.limits.lastAlarmNumber, takenAlarms());
      if (!sequence || !alarm)
        return std::nullopt;
      usedSequences_.insert(*sequence);
      usedAlarms_.insert(*alarm);
      const std::string raise = fmt::format("#{}={}({})", kAlarmVariable, *alarm, message(atom));
      if (isOpen) {
        head += fmt::format("IF[{}]GOTO{}{}", without(atom.text, ' '), *sequence, newLine);
        head += fmt::format("{}{}N{}{}", raise, newLine, *sequence, newLine);
      } else {
        head += fmt::format("IF[{}]GOTO{}{}", atom.opposite, *sequence, newLine);
        tail += fmt::format("{}N{}{}", newLine, *sequence, raise);
      }
      title += fmt::format("{}`{}`", title.empty() ? "raise an alarm unless " : " and ", atom.text);
    }
    FixIt fix{FixSafety::NeedsReview, title, {{{begin(*first), begin(*first)}, head}}};
    if (!tail.empty())
      fix.edits.push_back({{tree_.blocks[*last].end, tree_.blocks[*last].end}, tail});
    return fix;
  }

private:
  std::uint32_t begin(BlockId block) const { return tree_.blocks[block].begin; }

  // ---- places ----

  bool isRead(BlockId id) const {
    const Block &block = tree_.blocks[id];
    return !block.has(Block::kPercent) && !block.has(Block::kLeader) && !block.has(Block::kAfterEnd);
  }
  bool isHeader(BlockId block) const {
    const auto words = tree_.wordsOf(block);
    return std::any_of(words.begin(), words.end(), [](const Word &word) { return word.address() == 'O'; });
  }
  bool doesSomething(BlockId block) const {
    return isRead(block) && (!tree_.wordsOf(block).empty() || !tree_.statementsOf(block).empty());
  }
  /// Absent when there is nothing between the O word and what the program does first.
  std::optional<BlockId> firstBlock() const {
    const Program &program = model_.programs[program_];
    for (BlockId block = program.first; block < program.last; block = block.next()) {
      if (!doesSomething(block))
        continue;
      if (!isHeader(block))
        return block;
      if (tree_.wordsOf(block).size() > 1 || !tree_.statementsOf(block).empty())
        return std::nullopt;
    }
    return std::nullopt;
  }
  std::optional<BlockId> lastBlock() const {
    const Program &program = model_.programs[program_];
    std::optional<BlockId> last;
    for (BlockId block = program.first; block < program.last; block = block.next())
      if (doesSomething(block))
        last = block;
    return last;
  }
  /// No run goes on behind it.
  bool isEnd(BlockId block) const {
    if (tree_.blocks[block].has(Block::kSkip) || tree_.blocks[block].has(Block::kSkipInside))
      return false;
    bool ends = false;
    for (const Statement &statement : tree_.statementsOf(block))
      match(
          statement.node, [&](const Goto &) { ends = true; },
          [&](const Assignment &assignment) {
            const auto variable = variableNumber(tree_, assignment.target);
            ends = ends || (variable && raisesAlarm(dialect_, *variable));
          },
          [](const auto &) {});
    for (const Statement &statement : tree_.statementsOf(block))
      if (statement.nested || std::holds_alternative<ConditionalWords>(statement.node))
        return false;
    for (const Word &word : tree_.wordsOf(block)) {
      const auto code = word.address() == 'M' && word.isCode() ? word.integer() : std::nullopt;
      ends = ends || (code && (*code == 2 || *code == 30 || *code == 99) && !word.has(Word::kAfterThen));
    }
    return ends;
  }

  // ---- numbers ----

  static std::optional<std::uint32_t> free(std::uint32_t first, std::uint32_t last,
                                           const std::set<std::uint32_t> &taken) {
    for (std::uint32_t number = first; number <= last; ++number)
      if (!taken.contains(number))
        return number;
    return std::nullopt;
  }
  std::set<std::uint32_t> takenSequences() const {
    std::set<std::uint32_t> taken = usedSequences_;
    for (const SequenceNumber &number : model_.sequenceNumbersOf(program_))
      taken.insert(number.number);
    for (const Jump &jump : model_.jumpsOf(program_))
      if (const auto target = targetNumber(jump))
        taken.insert(*target);
    return taken;
  }
  std::set<std::uint32_t> takenAlarms() const {
    std::set<std::uint32_t> taken = usedAlarms_;
    for (const Statement &statement : tree_.statements) {
      const auto *assignment = std::get_if<Assignment>(&statement.node);
      const auto variable = assignment ? variableNumber(tree_, assignment->target) : std::nullopt;
      const auto number =
          variable && raisesAlarm(dialect_, *variable) ? literalValue(tree_, assignment->value) : std::nullopt;
      if (const auto whole = number ? number->asInteger() : std::nullopt; whole && *whole >= 0)
        taken.insert(static_cast<std::uint32_t>(*whole));
    }
    return taken;
  }

  // ---- what the operator reads ----

  std::string message(const GuardAtom &atom) const {
    constexpr std::array<std::array<std::string_view, 3>, 6> kWords = {{{" GT ", " MUST BE ABOVE ", ""},
                                                                        {" GE ", " MUST BE ", " OR MORE"},
                                                                        {" LT ", " MUST BE BELOW ", ""},
                                                                        {" LE ", " MUST BE ", " OR LESS"},
                                                                        {" NE ", " MUST NOT BE ", ""},
                                                                        {" EQ ", " MUST BE ", ""}}};
    std::string text;
    for (const auto &[relation, before, behind] : kWords)
      if (const std::size_t at = atom.text.find(relation); at != std::string::npos)
        text = fmt::format("{}{}{}{}", called(atom.text.substr(0, at)), before,
                           called(atom.text.substr(at + relation.size())), behind);
    if (!atom.comparison)
      text = called(atom.text.substr(0, atom.text.find(' '))) + " IS MISSING";
    return text.size() <= dialect_.limits.alarmMessageLength ? text : "ARGUMENT OUT OF RANGE";
  }
  /// By the name in the contract.
  std::string called(const std::string &side) const {
    if (contract_)
      for (const auto *values : {&contract_->params, &contract_->globals})
        for (const EntryValue &value : *values)
          if (side == fmt::format("#{}", value.variable) && !value.name.empty())
            return value.name;
    return side;
  }

  const SyntaxTree &tree_;
  const SourceFile &source_;
  const ProgramModel &model_;
  const Dialect &dialect_;
  ProgramId program_;
  const Contract *contract_;
  std::set<std::uint32_t> usedSequences_;
  std::set<std::uint32_t> usedAlarms_;
};

} // namespace

std::optional<FixIt> guardFix(const ProgramFile &file, ProgramId program, const Contract *contract,
                              const std::vector<GuardAtom> &atoms) {
  return GuardFix(file, program, contract).of(atoms);
}

} // namespace feedhold::prove
