// O-words paired by their labels.  Labels of branches and loops are known inside their subroutine only, as
// LinuxCNC keeps them ("#" and the name of the subroutine become part of the label).
#include "language/model/internal.h"

#include <map>
#include <utility>

namespace feedhold {

namespace {

class OWordPairing {
public:
  OWordPairing(const ResolveContext &context, ProgramModel &model) : context_(context), model_(model) {}

  void run() {
    const SyntaxTree &tree = context_.tree;
    for (std::size_t i = 0; i < tree.blockCount(); ++i) {
      const BlockId block(i);
      if (tree.blocks[block].has(Block::kAfterEnd) || tree.blocks[block].has(Block::kLeader))
        continue;
      if (headerOf(context_, block)) {
        leaveSubroutine();
        open_.clear();
      }
      for (const Statement &statement : tree.statementsOf(block))
        if (const auto *oWord = std::get_if<OWord>(&statement.node))
          add(*oWord, block, tree.idOf(statement));
    }
  }

private:
  void add(const OWord &oWord, BlockId block, StatementId statement) {
    const OWordId id = model_.oWords.add(
        {oWord.kind, ProgramId(0), block, statement, labelText(oWord, context_.source), std::nullopt});
    OWordUse &use = model_.oWords[id];
    if (!use.label.empty())
      pair(id, use);
  }

  void pair(OWordId id, OWordUse &use) {
    switch (use.kind) {
    case OWordKind::Sub:
      if (!sub_)
        openAround_ = std::exchange(open_, {});
      open_.clear();
      sub_ = begin(id, use);
      return;
    case OWordKind::EndSub:
      if (isEarlyReturn(use)) {
        use.kind = OWordKind::Return;
        use.construct = sub_;
        return;
      }
      if (sub_ && labelOf(*sub_) == use.label)
        close(*sub_, id, use);
      leaveSubroutine();
      return;
    case OWordKind::Return: use.construct = sub_; return;
    case OWordKind::Call: return;
    case OWordKind::If:
    case OWordKind::Do:
    case OWordKind::Repeat: open_.insert_or_assign(use.label, begin(id, use)); return;
    case OWordKind::While:
      if (const auto loop = openOne(use.label); loop && model_.constructs[*loop].kind == OWordKind::Do)
        closeOpen(*loop, id, use);
      else
        open_.insert_or_assign(use.label, begin(id, use));
      return;
    case OWordKind::ElseIf:
    case OWordKind::Else:
      if (const auto branch = openOne(use.label); branch && model_.constructs[*branch].kind == OWordKind::If)
        join(*branch, id, use);
      return;
    case OWordKind::EndIf: end(OWordKind::If, id, use); return;
    case OWordKind::EndWhile: end(OWordKind::While, id, use); return;
    case OWordKind::EndRepeat: end(OWordKind::Repeat, id, use); return;
    case OWordKind::Break:
    case OWordKind::Continue:
      if (const auto loop = openOne(use.label); loop && model_.constructs[*loop].kind != OWordKind::If)
        use.construct = loop;
      return;
    }
  }

  /// `o1 if`, `o<a> endsub`, `o1 endif`, .. `o<a> endsub` in the file of a subroutine: rs274 leaves it at the first one
  /// that it executes, and looks for the end of the branch behind that.
  bool isEarlyReturn(const OWordUse &use) const {
    if (!sub_ || open_.empty() || labelOf(*sub_) != use.label || !isFileOfSubroutine())
      return false;
    const SyntaxTree &tree = context_.tree;
    for (std::size_t i = use.statement.index() + 1; i < tree.statements.size(); ++i)
      if (const auto *oWord = std::get_if<OWord>(&tree.statements[StatementId(i)].node)) {
        if (oWord->kind == OWordKind::Sub)
          return false;
        if (oWord->kind == OWordKind::EndSub && labelText(*oWord, context_.source) == use.label)
          return true;
      }
    return false;
  }
  /// Nothing else stands before its `sub`.
  bool isFileOfSubroutine() const { return model_.constructs[*sub_].parts.front().index() == 0; }

  /// A branch of the program may hold a subroutine: `o1 if`, `o<a> sub`, `o<a> endsub`, `o1 endif` (rs274 runs it).
  void leaveSubroutine() {
    open_ = std::exchange(openAround_, {});
    sub_.reset();
  }

  ConstructId begin(OWordId id, OWordUse &use) {
    const ConstructId construct = model_.constructs.add({use.kind, {id}, false});
    use.construct = construct;
    return construct;
  }
  void join(ConstructId construct, OWordId id, OWordUse &use) {
    model_.constructs[construct].parts.push_back(id);
    use.construct = construct;
  }
  void close(ConstructId construct, OWordId id, OWordUse &use) {
    join(construct, id, use);
    model_.constructs[construct].closed = true;
  }
  void closeOpen(ConstructId construct, OWordId id, OWordUse &use) {
    close(construct, id, use);
    open_.erase(use.label);
  }
  void end(OWordKind opener, OWordId id, OWordUse &use) {
    if (const auto construct = openOne(use.label); construct && model_.constructs[*construct].kind == opener)
      closeOpen(*construct, id, use);
  }

  std::optional<ConstructId> openOne(const std::string &label) const {
    const auto found = open_.find(label);
    return found == open_.end() ? std::nullopt : std::optional(found->second);
  }
  const std::string &labelOf(ConstructId construct) const {
    return model_.oWords[model_.constructs[construct].parts.front()].label;
  }

  const ResolveContext &context_;
  ProgramModel &model_;
  std::map<std::string, ConstructId> open_;       // of the subroutine, by label
  std::map<std::string, ConstructId> openAround_; // of the program around the subroutine
  std::optional<ConstructId> sub_;
};

} // namespace

void findOWords(const ResolveContext &context, ProgramModel &model) { OWordPairing(context, model).run(); }

} // namespace feedhold
