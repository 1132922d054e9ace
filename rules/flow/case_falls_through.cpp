// case-falls-through: the blocks of N10 and N30 end with GOTO99, those of N20 run into N30.
#include "rules/flow/case_ladder.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::case_falls_through {
namespace {

/// From the label of a case to the label of the next one.
struct Body {
  BlockId first;
  BlockId last;                // with content
  std::optional<BlockId> exit; // where its GOTO at the end leads
  bool isEmpty;                // a label alone: it shares the next one's blocks
  bool goesOn;                 // into the next case
};

Body bodyOf(const FileContext &context, BlockId first, BlockId behind) {
  Body body{first, first, std::nullopt, true, false};
  for (BlockId block = first; block < behind; block = block.next()) {
    const auto words = context.tree.wordsOf(block);
    const bool isNumbered = std::ranges::any_of(words, [](const Word &word) { return word.address() != 'N'; });
    if (!isNumbered && context.tree.statementsOf(block).empty())
      continue;
    body.isEmpty = false;
    body.last = block;
  }
  const FlowAfter flow = flowAfter(context.tree, body.last, context.dialect);
  body.goesOn = !body.isEmpty && flow == FlowAfter::Next;
  for (const Jump &jump : context.model.jumpsIn(body.last, body.last.next()))
    if (flow == FlowAfter::Jumps && !jump.conditional)
      body.exit = jump.target;
  return body;
}

/// The bodies in order of the text; the last one, whose end is not known, is left out.
std::vector<Body> bodiesOf(const FileContext &context, const CaseLadder &ladder) {
  std::set<BlockId> targets;
  for (const CaseLine &line : ladder.cases) {
    if (!line.jump || !line.jump->target || *line.jump->target <= ladder.cases.back().block)
      return {};
    targets.insert(*line.jump->target);
  }
  std::vector<Body> bodies;
  for (auto each = targets.begin(); each != targets.end() && std::next(each) != targets.end(); ++each)
    bodies.push_back(bodyOf(context, *each, *std::next(each)));
  return bodies;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  for (const CaseLadder &ladder : caseLaddersOf(context, program)) {
    const std::vector<Body> bodies = bodiesOf(context, ladder);
    const auto odd = std::ranges::find_if(bodies, &Body::goesOn);
    if (odd == bodies.end() || std::ranges::count_if(bodies, &Body::goesOn) > 1)
      continue;
    std::vector<Body> leaving;
    std::ranges::copy_if(bodies, std::back_inserter(leaving), [](const Body &body) { return body.exit.has_value(); });
    const bool isHabit =
        leaving.size() > 1 && leaving.size() + 1 == bodies.size() &&
        std::ranges::all_of(leaving, [&](const Body &body) { return body.exit == leaving.front().exit; });
    if (!isHabit)
      continue;
    BlockId next = odd->last.next();
    while (!findWord(context.tree, next, 'N'))
      next = next.next();
    if (leaving.front().exit == next)
      continue;
    reporter.report(
        {.message = "this case runs on into the next one; the others leave by a GOTO",
         .span = context.tree.blocks[odd->last].span(),
         .labels = {{context.tree.blocks[next].span(), "the next case"},
                    {context.tree.blocks[leaving.front().last].span(), "another case leaves here"}},
         .notes = {"for its value the blocks of two cases are executed", "end it with the GOTO of the others"}});
  }
}

} // namespace

extern const Rule caseFallsThrough;
const Rule caseFallsThrough{
    .info = {"case-falls-through", Category::Flow, Severity::Warning,
             "Reports the blocks of one case of a list that run into those of the next, when all others leave by a "
             "`GOTO`."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::case_falls_through
