// length-as-end-of-thread: `(THREAD Z-1.5 TO Z-15)`, and `G76 X33.376 Z-13.5 ..`: 13.5 is its length.
#include "rules/comments/remarks_of_block.h"
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace feedhold::rules::length_as_end_of_thread {
namespace {

constexpr double kSame = 1e-4;

/// `Z-1.5`, and no letter before it.
std::vector<double> endsIn(std::string_view remark) {
  std::vector<double> ends;
  for (std::size_t at = 0; at + 1 < remark.size(); ++at) {
    if (remark[at] != 'Z' || (at > 0 && isLetter(remark[at - 1])))
      continue;
    const std::size_t end = std::min(remark.find_first_not_of("-0123456789.", at + 1), remark.size());
    const std::string number(remark.substr(at + 1, end - at - 1));
    if (std::ranges::any_of(number, isDigit))
      ends.push_back(std::strtod(number.c_str(), nullptr));
  }
  return ends;
}

/// Of a remark with two places on Z.
struct Range {
  const Comment *remark;
  double start; // nearer to the face
  double end;
};

std::optional<Range> rangeIn(const Comment &comment, const FileContext &context) {
  const std::vector<double> ends = endsIn(toUpper(context.text(comment.span)));
  return ends.size() == 2 && ends[0] != ends[1]
             ? std::optional(Range{&comment, std::max(ends[0], ends[1]), std::min(ends[0], ends[1])})
             : std::nullopt;
}

class Reader {
public:
  Reader(ProgramId, const FileContext &context) : context_(context) {}

  void read(BlockId block, const Reporter &reporter) {
    // A remark is about the tool above it, or about the one that is called next.
    if (findWord(context_.tree, block, 'T') && std::exchange(hasTool_, true))
      range_.reset();
    for (const Comment &comment : context_.tree.commentsOf(block))
      if (const auto range = rangeIn(comment, context_)) {
        range_ = range;
        hasTool_ = findWord(context_.tree, block, 'T') != nullptr;
      }
    const Word *cycle =
        findAction(context_.tree, block, context_.dialect, {CodeAction::ThreadPasses, CodeAction::ThreadCycle});
    const Word *end = cycle ? findWord(context_.tree, block, 'Z') : nullptr;
    if (range_ && end && end->isNumber())
      judge(*end, reporter);
  }

private:
  void judge(const Word &end, const Reporter &reporter) {
    const double length = range_->start - range_->end;
    if (range_->start >= 0 || std::abs(end.number().toDouble() + length) > kSame ||
        std::abs(range_->start + length) < kSame || std::abs(range_->end + length) < kSame)
      return;
    reporter.report(
        {.message = fmt::format("{} is the length of the thread, not its end", context_.quoted(end.span())),
         .span = end.span(),
         .labels = {{range_->remark->span, "the remark"}},
         .notes = {fmt::format("by the remark the thread is cut from Z{:g} to Z{:g}: it ends {:g} too early",
                               range_->start, range_->end, -range_->start),
                   fmt::format("write `Z{:g}`, or correct the remark", range_->end)}});
    range_.reset();
  }

  const FileContext &context_;
  std::optional<Range> range_;
  bool hasTool_ = false; // since the remark
};

} // namespace

extern const Rule lengthAsEndOfThread;
const Rule lengthAsEndOfThread{.info = {"length-as-end-of-thread", Category::Comment, Severity::Warning,
                                        "Reports a threading cycle whose Z is the length of the thread in a remark, "
                                        "where the thread does not start at Z0."},
                               .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::length_as_end_of_thread
