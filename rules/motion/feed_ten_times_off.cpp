// feed-ten-times-off: `F.01` in a row of cuts with `F.1`.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace feedhold::rules::feed_ten_times_off {
namespace {

constexpr std::size_t kFewestAlike = 4; // besides the one that differs

bool isTenTimes(const Decimal &a, const Decimal &b) {
  constexpr double kSame = 1e-9;
  const double ratio = b.isZero() ? 0 : a.toDouble() / b.toDouble();
  return std::abs(ratio - 10) < kSame || std::abs(ratio - 0.1) < kSame;
}

/// Cuts along the same axes, by G01, G02 or G03, each with an F of its own.
using Row = std::vector<const Word *>;

class Reader {
public:
  explicit Reader(const FileContext &context) : context_(context) {}

  void read(BlockId block) {
    if (const Word *code = findAction(
            context_.tree, block, context_.dialect,
            {CodeAction::Rapid, CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}))
      motion_ = codeOf(*code, context_.dialect)->action;
    if (const Word *code = findAction(context_.tree, block, context_.dialect,
                                      {CodeAction::FeedPerMinute, CodeAction::FeedPerRevolution}))
      countFeedsBy(codeOf(*code, context_.dialect)->action);
    const Word *feed = findWord(context_.tree, block, 'F');
    const std::uint32_t axes = axesOf(block);
    if (feed && feed->isNumber() && axes != 0 && motion_ != CodeAction::Rapid)
      rows_.back()[{motion_, axes}].push_back(feed);
  }
  void beginTool() { rows_.emplace_back(); }
  void report(const Reporter &reporter) const {
    for (const auto &rows : rows_)
      for (const auto &[key, row] : rows)
        reportIn(row, reporter);
  }

private:
  void countFeedsBy(CodeAction mode) {
    if (std::exchange(mode_, mode) != mode)
      rows_.emplace_back();
  }
  std::uint32_t axesOf(BlockId block) const {
    std::uint32_t axes = 0;
    for (const Word &word : context_.tree.wordsOf(block))
      if (std::string_view("XYZUVW").find(word.address()) != std::string_view::npos)
        axes |= 1U << (word.address() - 'A');
    return axes;
  }
  /// The feed that stands on both sides of the one at `at`, next to it, or next but one where two feeds alternate, and
  /// is ten times or a tenth of it.
  static const Word *around(const Row &row, std::size_t at) {
    for (const std::size_t step : {std::size_t{1}, std::size_t{2}})
      if (at >= step && at + step < row.size() && row[at - step]->number() == row[at + step]->number() &&
          isTenTimes(row[at]->number(), row[at - step]->number()))
        return row[at - step];
    return nullptr;
  }
  static std::size_t countOf(const Row &row, const Decimal &feed) {
    return static_cast<std::size_t>(
        std::ranges::count_if(row, [&](const Word *each) { return each->number() == feed; }));
  }
  void reportIn(const Row &row, const Reporter &reporter) const {
    std::map<Decimal, std::vector<std::pair<const Word *, const Word *>>> found; // by the feed that differs
    for (std::size_t at = 0; at < row.size(); ++at)
      if (const Word *other = around(row, at); other && countOf(row, other->number()) >= kFewestAlike)
        found[row[at]->number()].emplace_back(row[at], other);
    for (const auto &[feed, places] : found)
      if (places.size() == 1)
        tell(*places.front().first, *places.front().second, reporter);
  }
  void tell(const Word &feed, const Word &other, const Reporter &reporter) const {
    const bool isMore = feed.number() > other.number();
    reporter.report({.message = fmt::format("{} is {} the feed in the cuts around it", context_.quoted(feed.span()),
                                            isMore ? "ten times" : "a tenth of"),
                     .span = feed.span(),
                     .labels = {{other.span(), "the feed of the cuts around it"}},
                     .notes = {isMore ? "the tool is overloaded in this cut" : "the tool rubs in this cut",
                               "check the decimal point and the zeros of F"}});
  }

  const FileContext &context_;
  CodeAction motion_ = CodeAction::Rapid;
  CodeAction mode_ = CodeAction::FeedPerMinute;
  std::vector<std::map<std::pair<CodeAction, std::uint32_t>, Row>> rows_{1}; // by tool and feed mode
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  Reader reader(context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    if (findAction(context.tree, block, context.dialect, {CodeAction::ToolChange}) ||
        (context.dialect.machine == MachineKind::Turning && findWord(context.tree, block, 'T')))
      reader.beginTool();
    reader.read(block);
  }
  reader.report(reporter);
}

} // namespace

extern const Rule feedTenTimesOff;
const Rule feedTenTimesOff{
    .info = {"feed-ten-times-off", Category::Motion, Severity::Warning,
             "Reports a feed that is ten times, or a tenth, of that in the like cuts around it."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::feed_ten_times_off
