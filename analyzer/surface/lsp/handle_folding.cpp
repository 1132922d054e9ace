// What can be folded away: programs, loops, branches, runs of comments.
#include "language/model/block_facts.h"
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_json.h"

namespace feedhold::lsp {

namespace {

class Folds {
public:
  explicit Folds(const ProjectFile &file) : file_(file) {}

  Json build() {
    for (std::size_t i = 0; i < file_.model.programs.size(); ++i)
      add(spanOf(file_, ProgramId(i)), "region");
    for (const Loop &loop : file_.model.loops)
      if (loop.endBlock)
        add(cover(spanOfBlock(loop.doBlock), spanOfBlock(*loop.endBlock)), "region");
    for (const Construct &construct : file_.model.constructs)
      if (construct.closed && construct.kind != OWordKind::Sub)
        add(cover(spanOfPart(construct.parts.front()), spanOfPart(construct.parts.back())), "region");
    branches();
    comments();
    return std::move(folds_);
  }

private:
  Span spanOfBlock(BlockId block) const { return file_.tree.blocks[block].span(); }
  Span spanOfPart(OWordId part) const { return file_.tree.statements[file_.model.oWords[part].statement].span; }

  void add(Span span, std::string_view kind) {
    const std::uint32_t first = file_.source.lineOf(span.begin), last = file_.source.lineOf(span.end);
    if (first < last)
      folds_.push_back({{"startLine", first - 1}, {"endLine", last - 1}, {"kind", kind}});
  }
  /// IF .. THEN on a line of its own, up to its ENDIF.
  void branches() {
    std::vector<Span> open;
    std::optional<ProgramId> program;
    for (const Statement &statement : file_.tree.statements) {
      const ProgramId here = file_.model.programOf(file_.tree.blockAt(statement.span.begin));
      if (program != here)
        open.clear();
      program = here;
      const auto *head = std::get_if<If>(&statement.node);
      if (head && head->action == IfAction::Lines)
        open.push_back(statement.span);
      if (std::holds_alternative<EndIf>(statement.node) && !open.empty()) {
        add(cover(open.back(), statement.span), "region");
        open.pop_back();
      }
    }
  }
  void comments() {
    std::optional<Span> run;
    for (BlockId block(0); block.index() < file_.tree.blockCount(); block = block.next()) {
      const bool isComment = isEmpty(file_.tree, block) && !file_.tree.commentsOf(block).empty();
      if (isComment)
        run = run ? cover(*run, spanOfBlock(block)) : spanOfBlock(block);
      if (!isComment && run) {
        add(*run, "comment");
        run.reset();
      }
    }
    if (run)
      add(*run, "comment");
  }

  const ProjectFile &file_;
  Json folds_ = Json::array();
};

} // namespace

Json foldingRange(const View &view, const Json &) { return Folds(view.file()).build(); }

} // namespace feedhold::lsp
